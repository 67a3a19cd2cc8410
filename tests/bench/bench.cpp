// Time and memory of what users wait for, beside what CGAL alone takes for the same points in the same run.
// wellspaced_bench [--short | --long] and Google Benchmark's own flags, such as --benchmark_filter.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/analyze/certificate.h"
#include "core/analyze/periodogram.h"
#include "core/analyze/spacing.h"
#include "core/analyze/spectrum.h"
#include "core/domain/torus.h"
#include "core/generate/generate.h"
#include "core/generate/poisson_disk.h"
#include "core/optimize/cvt.h"
#include "core/optimize/opt_beta.h"
#include "core/optimize/opt_beta_local.h"
#include "core/optimize/push_pull.h"
#include "core/voronoi/cell_finder.h"
#include "core/voronoi/star_mesh.h"
#include "tests/bench/cgal_baseline.h"
#include "tests/bench/table.h"
#include "tests/bench/workload.h"

namespace wellspaced::bench {
namespace {

using benchmark::State;
using Work = std::function<void(State&, Control&)>;

struct Row {
  std::string name;
  std::uint64_t count;  ///< of the points it works on, made before its time starts; 0: none
  Bar bar;
  Work work;
  int repetitions = 5;
  unsigned threads = 1;
  std::optional<CounterBar> counter_bar = {};
};

constexpr std::uint64_t ten_thousand = 10'000, hundred_thousand = 100'000, million = 1'000'000,
                        ten_million = 10'000'000;

double seconds_since(Control::Clock::time_point begin) {
  return std::chrono::duration<double>(Control::Clock::now() - begin).count();
}

std::string words(std::uint64_t count) {
  return count >= million ? std::to_string(count / million) + "M" : std::to_string(count / 1000) + "k";
}

double not_six_valent(const PointSet& points, const Control& control) {
  Spacing spacing = measure_spacing(points, control);
  return 100 - 100 * static_cast<double>(spacing.valence[6]) / static_cast<double>(spacing.n);
}

Row optimizing(std::uint64_t count, double beta, double bar, unsigned threads = 1,
               OptBetaOptions::Randomness randomness = OptBetaOptions::Randomness::fast) {
  const bool gentle = randomness == OptBetaOptions::Randomness::gentle;
  char target[16];
  std::snprintf(target, sizeof target, "%.3f", beta);
  const std::string name = std::string("opt-beta/") + words(count) + "/to " + target +
                           (gentle ? "/gentle" : "") +
                           (threads > 1 ? "/" + std::to_string(threads) + " threads" : "");
  const auto work = [=](State& state, Control& control) {
    const OptimizeResult result = opt_beta(mps(count), {beta, randomness, {}}, control);
    state.PauseTiming();
    state.counters["beta_upper"] = certify(result.points, control).value().beta_upper;
    state.counters["not 6-valent %"] = not_six_valent(result.points, control);
    state.counters["sweeps"] = result.sweeps;
    state.counters["visits a point"] = result.visits;
    if (result.converged != true) state.SkipWithError("the target was not reached");
    state.ResumeTiming();
  };
  return {name, count, {bar, "s", 1}, work, count >= million ? 1 : 5, threads};
}

/// How low it gets in so many visits a point, half a minute's worth.
Row lowest() {
  const auto work = [](State& state, Control& control) {
    const OptimizeResult result =
        opt_beta(mps(ten_thousand), {.65, OptBetaOptions::Randomness::gentle, 23000}, control);
    state.PauseTiming();
    state.counters["beta_upper"] = certify(result.points, control).value().beta_upper;
    state.ResumeTiming();
  };
  return {"opt-beta/10k/lowest",
          ten_thousand,
          {30, "s", 1},
          work,
          1,
          1,
          CounterBar{"beta_upper", CounterBar::Sense::at_most, .667}};
}

Row speedup(std::uint64_t count, double beta) {
  const auto work = [=](State& state, Control&) {
    const auto seconds = [&](unsigned threads) {
      Control control(threads);
      const auto begin = Control::Clock::now();
      benchmark::DoNotOptimize(opt_beta(mps(count), {beta, OptBetaOptions::Randomness::fast, {}}, control));
      return seconds_since(begin);
    };
    const double one = seconds(1);
    state.counters["speedup"] = one / seconds(2);
  };
  return {"opt-beta/" + words(count) + "/2 threads over one",     count, {0, "s", 1}, work, 1, 1,
          CounterBar{"speedup", CounterBar::Sense::at_least, 1.7}};
}

/// Time a point over that of 10,000 points.
Row per_point(std::uint64_t count, double beta) {
  const auto work = [=](State& state, Control& control) {
    const auto seconds_a_point = [&](std::uint64_t n) {
      const PointSet& input = mps(n);
      const auto begin = Control::Clock::now();
      benchmark::DoNotOptimize(opt_beta(input, {beta, OptBetaOptions::Randomness::fast, {}}, control));
      return seconds_since(begin) / static_cast<double>(n);
    };
    std::vector<double> small(9);
    for (double& s : small) s = seconds_a_point(ten_thousand);
    std::nth_element(small.begin(), small.begin() + 4, small.end());
    state.counters["over 10k"] = seconds_a_point(count) / small[4];
  };
  return {"opt-beta/" + words(count) + "/a point, over 10k",      count, {0, "s", 1}, work, 1, 1,
          CounterBar{"over 10k", CounterBar::Sense::at_most, 1.5}};
}

/// How long cancel takes, at so many moments of all that a user may ask for.
Row cancelling(std::uint64_t count) {
  constexpr int moments = 12;
  const auto everything = [=](const Control& parent) {
    Control control(2, &parent);
    Rng rng(1);
    const PointSet input =
        poisson_disk(std::make_shared<Torus>(), {poisson_disk_radius(1, count)}, rng, control);
    const PointSet points = opt_beta(input, {.85, OptBetaOptions::Randomness::fast, {}}, control).points;
    benchmark::DoNotOptimize(certify(points, control));
    benchmark::DoNotOptimize(measure_local_spacing(points, control));
  };
  const auto work = [=](State& state, Control&) {
    const auto begin = Control::Clock::now();
    everything(Control());
    const double whole = seconds_since(begin);
    double longest = 0;
    for (int k = 0; k < moments; ++k) {
      Control control;
      auto over = std::async(std::launch::async, [&] {
        try {
          everything(control);
        } catch (const Error&) {
        }
        return Control::Clock::now();
      });
      over.wait_for(std::chrono::duration<double>(whole * (k + .5) / moments));
      const auto cancelled = Control::Clock::now();
      control.cancel();
      longest = std::max(longest, std::chrono::duration<double>(over.get() - cancelled).count());
    }
    state.counters["longest wait s"] = longest;
  };
  return {"cancel/" + words(count),
          0,
          {0, "s", 1},
          work,
          1,
          1,
          CounterBar{"longest wait s", CounterBar::Sense::at_most, .1}};
}

Row sampling(std::uint64_t count, double bar, unsigned threads = 1) {
  const auto work = [=](State& state, Control& control) {
    Rng rng(1);
    const PointSet points =
        poisson_disk(std::make_shared<Torus>(), {poisson_disk_radius(1, count)}, rng, control);
    state.counters["n"] = static_cast<double>(points.size());
  };
  return {"poisson-disk/" + words(count) + (threads > 1 ? "/2 threads" : ""),
          0,
          {bar, "s", 1},
          work,
          count >= million ? 3 : 9,
          threads};
}

Row candidate_cells() {
  const PointSet& points = mps(ten_thousand);
  const auto work = [&points](State&, Control& control) {
    const double spacing = hexagonal_spacing(1, points.size());
    const NeighborGrid grid(points, spacing);
    CellFinder finder(points, grid, 2.5 * spacing, control);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      finder.load(i);
      for (int k = 0; k < 22; ++k)
        benchmark::DoNotOptimize(finder.radii_at({0.001 * spacing * k, -0.002 * spacing * k}));
    }
  };
  return {
      "kernel/candidate cell", ten_thousand, {100, "ns", 22.0 * static_cast<double>(points.size())}, work};
}

Row stars() {
  const PointSet& points = mps(ten_thousand);
  const auto work = [mesh = StarMesh(points, Control())](State&, Control& control) {
    benchmark::DoNotOptimize(mesh.measure(control));
  };
  return {"kernel/star", ten_thousand, {8, "ns", static_cast<double>(points.size())}, work, 9};
}

Row local_sweep() {
  const auto work = [](State&, Control& control) {
    benchmark::DoNotOptimize(opt_beta_local(mps(ten_thousand), {0.6, 3, {}}, control));
  };
  return {"opt-beta-local/10k/sweep", ten_thousand, {3, "us", 3.0 * ten_thousand}, work};
}

Row lloyd() {
  constexpr int sweeps = 20;
  const auto work = [](State&, Control& control) {
    benchmark::DoNotOptimize(cvt(mps(ten_thousand), {CvtOptions::Variant::lloyd, sweeps, 0}, control));
  };
  return {"cvt/10k/Lloyd iteration", ten_thousand, {0.3, "us", sweeps * 1.0 * ten_thousand}, work};
}

Row pushing() {
  const auto work = [](State& state, Control& control) {
    const OptimizeResult result = push_pull(mps(ten_thousand), {.87, .65, {}, 1000}, control);
    state.counters["beta"] = measure_spacing(result.points, control).beta;
    state.counters["visits a point"] = result.visits;
  };
  return {"push-pull/10k/rho .87, coverage .65", ten_thousand, {0.11, "s", 1}, work};
}

template <class Function>
Row of_set(const std::string& name, std::uint64_t count, double bar, Function function) {
  const auto work = [=](State&, Control& control) {
    benchmark::DoNotOptimize(function(mps(count), control));
  };
  return {name + "/" + words(count), count, {bar, "s", 1}, work, count >= million ? 3 : 9};
}

Row analysis(std::uint64_t count, double bar) {
  return of_set("spacing with all beta_i", count, bar,
                [](const PointSet& p, const Control& c) { return measure_local_spacing(p, c).global.beta; });
}
Row proof(std::uint64_t count, double bar) {
  return of_set("certificate", count, bar,
                [](const PointSet& p, const Control& c) { return certify(p, c).value().beta_upper; });
}
Row cgal(std::uint64_t count) {
  return of_set("CGAL/Delaunay, not periodic", count, 0,
                [](const PointSet& p, const Control&) { return cgal_delaunay(p); });
}
Row cgal_cells(std::uint64_t count) {
  return of_set("CGAL/Lloyd iteration, torus", count, 0,
                [](const PointSet& p, const Control&) { return cgal_lloyd(p); });
}

Row spectrum_of_points(std::uint64_t count, double bar) {
  return of_set("periodogram to 2.5 sqrt n", count, bar, [](const PointSet& p, const Control& c) {
    return spectrum(periodogram(p, static_cast<int>(2.5 * std::sqrt(static_cast<double>(p.size()))), c))
        .power[1];
  });
}

/// What gentle leaves of randomness, from so many sets of 10,000 points.
Row randomness(double beta, int sets, const CounterBar& bar) {
  const auto work = [=](State& state, Control& control) {
    constexpr double range = 6.4;
    std::vector<PointSet> results;
    double swing = 0, five_or_seven = 0;
    for (int s = 1; s <= sets; ++s) {
      const PointSet& input = mps(ten_thousand, static_cast<std::uint64_t>(s));
      results.push_back(opt_beta(input, {beta, OptBetaOptions::Randomness::gentle, {}}, control).points);
      const Periodogram one = mean_periodogram({&results.back(), 1}, range, control);
      swing += oscillations(spectrum(one)).value() / sets;
      Spacing spacing = measure_spacing(results.back(), control);
      five_or_seven += 100 * static_cast<double>(spacing.valence[5] + spacing.valence[7]) /
                       static_cast<double>(spacing.n) / sets;
    }
    const Spectrum mean = spectrum(mean_periodogram(results, range, control), sets);
    state.counters["oscillations"] = swing;
    state.counters["5- and 7-valent %"] = five_or_seven;
    state.counters["Nyquist"] = effective_nyquist(mean).value();
    state.counters["off isotropy dB"] = std::fabs(mean_anisotropy_db(mean).value() + 10 * std::log10(sets));
  };
  char name[64];
  std::snprintf(name, sizeof name, "gentle/10k/to %.3f/%d sets", beta, sets);
  return {name, ten_thousand, {0, "s", 1}, work, 1, 1, bar};
}

std::vector<Row> short_rows() {
  using enum OptBetaOptions::Randomness;
  using enum CounterBar::Sense;
  return {candidate_cells(),
          stars(),
          local_sweep(),
          sampling(ten_thousand, .006),
          optimizing(ten_thousand, .788, .012),
          optimizing(ten_thousand, .747, .02),
          optimizing(ten_thousand, .70, .035),
          optimizing(ten_thousand, .69, .06),
          optimizing(ten_thousand, .788, .036, 1, gentle),
          optimizing(ten_thousand, .747, .06, 1, gentle),
          optimizing(ten_thousand, .70, .07, 1, gentle),
          randomness(.788, 5, {"oscillations", at_most, 2.3}),
          randomness(.747, 5, {"oscillations", at_most, 2.65}),
          randomness(.716, 5, {"oscillations", at_most, 2.85}),
          randomness(.75, 5, {"5- and 7-valent %", at_least, 38}),
          randomness(.75, 10, {"off isotropy dB", at_most, .4}),
          spectrum_of_points(ten_thousand, .5),
          pushing(),
          lloyd(),
          analysis(ten_thousand, 0),
          proof(ten_thousand, 0),
          cgal(ten_thousand),
          cgal_cells(ten_thousand)};
}

std::vector<Row> more_rows() {
  return {optimizing(ten_thousand, .667, 30),
          optimizing(ten_thousand, .66, 0),
          optimizing(hundred_thousand, .747, .2),
          sampling(million, .7),
          sampling(million, .4, 2),
          optimizing(million, .75, 2.2),
          speedup(million, .75),
          optimizing(million, .70, 3.5),
          optimizing(million, .70, 0, 1, OptBetaOptions::Randomness::gentle),
          spectrum_of_points(million, 20),
          analysis(million, .2),
          proof(million, 1),
          cgal(million)};
}

std::vector<Row> long_rows() {
  return {lowest(), optimizing(ten_million, .75, 0), per_point(ten_million, .75), cancelling(ten_million)};
}

void add(const Row& row) {
  const auto run = [row](State& state) {
    struct Quiet final : Control {
      using Control::Control;
    } control(row.threads);
    forget_peak();
    if (row.count > 0) mps(row.count);
    for (auto iteration : state) row.work(state, control);
    state.counters["peak MiB"] = peak_mib();
  };
  auto* bench =
      benchmark::RegisterBenchmark(row.name.c_str(), run)->Iterations(1)->Repetitions(row.repetitions);
  if (row.threads > 1)
    bench->UseRealTime();
  else
    bench->MeasureProcessCPUTime();
}

bool take_flag(int& argc, char** argv, const char* flag) {
  char** end =
      std::remove_if(argv + 1, argv + argc, [&](const char* a) { return std::strcmp(a, flag) == 0; });
  const bool found = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return found;
}

int main(int argc, char** argv) {
  const bool brief = take_flag(argc, argv, "--short"), everything = take_flag(argc, argv, "--long");
  std::vector<Row> rows = short_rows();
  const auto append = [&](std::vector<Row> more) { rows.insert(rows.end(), more.begin(), more.end()); };
  if (!brief) append(more_rows());
  if (everything) append(long_rows());
  std::map<std::string, Bar> bars;
  std::map<std::string, CounterBar> counter_bars;
  for (const Row& row : rows) {
    bars[row.name] = row.bar;
    if (row.counter_bar) counter_bars[row.name] = *row.counter_bar;
    add(row);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Table table(bars, counter_bars);
  benchmark::RunSpecifiedBenchmarks(&table);
  return 0;
}

}  // namespace
}  // namespace wellspaced::bench

int main(int argc, char** argv) { return wellspaced::bench::main(argc, argv); }
