// What a surface mesh costs: wellspaced_mesh_bench [mesh.off | mesh.obj], or else a bumpy sphere of 20480
// faces. Takes Google Benchmark's flags too.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/domain/surface_mesh.h"
#include "tests/support/meshes.h"

namespace wellspaced::bench {
namespace {

using benchmark::State;

Triangles bumpy_sphere() {
  Triangles mesh = testing::refined_sphere(testing::icosahedron(), 5);
  for (Vec3& v : mesh.vertices)
    v = (1 + 0.1 * portable_cos_sin(1.5 * v.x).sin * portable_cos_sin(1.2 * v.y).cos) * v;
  return mesh;
}

/// Some samples, each with those of n random ones that are within two hexagonal spacings in space.
struct Samples {
  Samples(const SurfaceMesh& mesh, std::size_t n) : reach(2 * hexagonal_spacing(mesh, n)) {
    Rng rng(1);
    std::vector<Vec3> all;
    for (std::size_t k = 0; k < n; ++k) all.push_back(mesh.random_point(rng));
    for (std::size_t k = 0; k < std::min<std::size_t>(n, 200); ++k) {
      points.push_back(all[k]);
      auto& near = neighbors.emplace_back();
      for (std::uint32_t i = 0; i < n; ++i)
        if (i != k && norm(all[i] - all[k]) <= reach) near.push_back({all[i] - all[k], i});
      pairs += near.size();
    }
  }
  double reach;
  std::vector<Vec3> points;
  std::vector<std::vector<Neighbor>> neighbors;
  std::size_t pairs = 0;
};

void localize(State& state, const SurfaceMesh& mesh, std::size_t n) {
  const Samples samples(mesh, n);
  std::vector<Neighbor> neighbors;
  for (auto _ : state)
    for (std::size_t k = 0; k < samples.points.size(); ++k) {
      neighbors = samples.neighbors[k];
      mesh.localize(samples.points[k], samples.reach, neighbors);
      benchmark::DoNotOptimize(neighbors.data());
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.pairs));
  state.counters["faces_a_sample"] = static_cast<double>(mesh.mesh().facts().faces) / static_cast<double>(n);
}

void locate(State& state, const SurfaceMesh& mesh, std::size_t n) {
  const Samples samples(mesh, n);
  for (auto _ : state)
    for (const Vec3 p : samples.points) benchmark::DoNotOptimize(mesh.locate(p));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.points.size()));
}

void step(State& state, const SurfaceMesh& mesh, std::size_t n) {
  const Samples samples(mesh, n);
  for (auto _ : state)
    for (const Vec3 p : samples.points)
      benchmark::DoNotOptimize(mesh.step(p, {samples.reach / 4, samples.reach / 4}));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.points.size()));
}

void distance(State& state, const SurfaceMesh& mesh, std::size_t) {
  Rng rng(1);
  for (auto _ : state) {
    const Vec3 p = mesh.random_point(rng);
    benchmark::DoNotOptimize(mesh.distance(p, mesh.random_point(rng)));
  }
  state.SetItemsProcessed(state.iterations());
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const SurfaceMesh mesh{TriangleMesh(argc > 1 ? testing::read_triangles(argv[1]) : bumpy_sphere())};
  const auto add = [&](const std::string& name, auto work, std::size_t n) {
    benchmark::RegisterBenchmark(name.c_str(), [&mesh, work, n](State& state) { work(state, mesh, n); });
  };
  for (const std::size_t n : {200, 1000, 5000, 20000}) add("localize/" + std::to_string(n), localize, n);
  add("locate", locate, 5000);
  add("step/5000", step, 5000);
  add("distance/any", distance, 0);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace wellspaced::bench

int main(int argc, char** argv) { return wellspaced::bench::run(argc, argv); }
