#include "core/analyze/periodogram.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "core/analyze/periodogram_fft.h"
#include "core/analyze/periodogram_kernel.h"
#include "core/generate/lattice.h"
#include "core/math.h"
#include "tests/support/oracle.h"
#include "tests/support/vector_widths.h"

namespace wellspaced {
namespace {

using testing::expect_error;
using testing::random_points;

double exact(const PointSet& points, int kx, int ky) {
  const Vec3 sides = points.domain->box().size;
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double turns = kx * (points[i].x / sides.x) + ky * (points[i].y / sides.y);
    sum += std::polar(1.0, -2 * pi * (turns - std::floor(turns)));
  }
  return std::norm(sum) / static_cast<double>(points.size());
}

void expect_power(double found, double wanted, const std::string& what) {
  EXPECT_NEAR(found, wanted, 1e-9 * std::max(1.0, wanted)) << what;
}

void expect_exact(const PointSet& points, int k_max) {
  const Periodogram p = periodogram(points, k_max, Control());
  ASSERT_EQ(p.power.size(), static_cast<std::size_t>((k_max + 1) * (2 * k_max + 1)));
  EXPECT_EQ(p.n, static_cast<double>(points.size()));
  for (int kx = -k_max; kx <= k_max; ++kx)
    for (int ky = -k_max; ky <= k_max; ++ky)
      expect_power(p.at(kx, ky), kx == 0 && ky == 0 ? 0 : exact(points, kx, ky),
                   std::to_string(kx) + ", " + std::to_string(ky));
}

TEST(Periodogram, IsTheSquareOfExactSums) {
  for (const int k_max : {1, 2, 7, 8, 31, 40}) {
    SCOPED_TRACE(k_max);
    expect_exact(random_points(1, 1, 150, 1), k_max);
  }
  expect_exact(random_points(3, 0.2, 60, 2), 12);
  expect_exact(random_points(1e6, 1e5, 60, 3), 12);
}

TEST(Periodogram, OfOnePointIsOneEverywhere) {
  for (const double place : {0.0, 0.25, 0.5, 1 - 0x1p-53}) {
    const PointSet point{std::make_shared<Torus>(), {place, 1 - 0x1p-53 - place}};
    const Periodogram p = periodogram(point, 5, Control());
    for (int kx = -5; kx <= 5; ++kx)
      for (int ky = -5; ky <= 5; ++ky) {
        if (kx != 0 || ky != 0) {
          expect_power(p.at(kx, ky), 1, std::to_string(place));
        }
      }
  }
}

TEST(Periodogram, OfASquareLatticeIsPeaksAndZeros) {
  Control control;
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 400, control);
  const Periodogram p = periodogram(lattice, 50, Control());
  for (int kx = -50; kx <= 50; ++kx)
    for (int ky = -50; ky <= 50; ++ky) {
      const bool peak = kx % 20 == 0 && ky % 20 == 0 && (kx != 0 || ky != 0);
      expect_power(p.at(kx, ky), peak ? 400 : 0, std::to_string(kx) + ", " + std::to_string(ky));
    }
}

TEST(Periodogram, TellsNothingOfWhereTheTorusBegins) {
  const PointSet points = random_points(1, 1, 500, 4);
  PointSet moved = points;
  for (std::size_t i = 0; i < points.size(); ++i) moved.set(i, points.domain->step(points[i], {0.4, 0.77}));
  const Periodogram a = periodogram(points, 30, Control()), b = periodogram(moved, 30, Control());
  for (std::size_t i = 0; i < a.power.size(); ++i) expect_power(b.power[i], a.power[i], std::to_string(i));
}

/// The toolkit's files: whole frequencies from -79 to 79, kx faster than ky, 0 at the zero frequency.
void expect_file(const std::string& folder, const std::string& spectra, const std::string& name) {
  SCOPED_TRACE(name);
  PointSet points{std::make_shared<Torus>(), {}};
  std::ifstream point_file(folder + name + ".dat"), spectrum_file(spectra + name + "_spectrum.dat");
  for (double x, y; point_file >> x >> y;) points.push_back({x, y, 0});
  ASSERT_GT(points.size(), 1000u);
  const Periodogram p = periodogram(points, 79, Control());
  for (int ky = -79; ky <= 79; ++ky)
    for (int kx = -79; kx <= 79; ++kx) {
      double wanted = std::nan("");
      spectrum_file >> wanted;
      expect_power(p.at(kx, ky), wanted, std::to_string(kx) + ", " + std::to_string(ky));
    }
}

TEST(Periodogram, OfAnotherSamplersSetIsWhatAnotherProgramFound) {
  const std::string folder = std::string(WELLSPACED_TEST_DATA) + "/points/";
  expect_file(folder, folder, "utk_AAPatterns");
}

TEST(Periodogram, OfTheSharedSetsIsWhatAnotherProgramFound) {
  const char* shared = std::getenv("WELLSPACED_DATA_DIR");
  if (shared == nullptr) GTEST_SKIP() << "WELLSPACED_DATA_DIR is not set";
  const std::string folder = std::string(shared) + "/points/";
  for (const char* name : {"utk_AAPatterns", "utk_DartThrowing", "utk_Fattal", "utk_RegularGrid"})
    expect_file(folder, folder, name);
}

TEST(Periodogram, IsTheSameOnAnyNumberOfThreadsAndAnyVectorWidth) {
  const PointSet points = random_points(1, 1, 3000, 5);
  const std::vector<double> one = periodogram(points, 90, Control(1)).power;
  for (const unsigned threads : {2u, 3u, 8u})
    EXPECT_EQ(periodogram(points, 90, Control(threads)).power, one) << threads;
  testing::on_every_vector_width(
      [&](const std::string& name) { EXPECT_EQ(periodogram(points, 90, Control(2)).power, one) << name; });
}

TEST(Periodogram, TellsItsMemory) {
  EXPECT_GT(periodogram_bytes(1'000'000, 2500), 450'000'000u);
  EXPECT_LT(periodogram_bytes(1'000'000, 2500), 600'000'000u);
  EXPECT_LT(periodogram_bytes(10'000, 250), 10'000'000u);
  EXPECT_GT(periodogram_bytes(10, largest_k_max), std::uint64_t{1} << 35);
}

TEST(Periodogram, RefusesWhatCannotBe) {
  const PointSet points = random_points(1, 1, 10, 6);
  const auto of = [](const PointSet& set, int k_max) {
    return [&set, k_max] { periodogram(set, k_max, Control()); };
  };
  expect_error(of(points, 0), ErrorCode::invalid_parameters, "/k_max");
  expect_error(of(points, largest_k_max + 1), ErrorCode::invalid_parameters, "/k_max");
  expect_error(of({std::make_shared<Torus>(), {}}, 5), ErrorCode::degenerate_input, "");
  Control cancelled;
  cancelled.cancel();
  expect_error([&] { periodogram(points, 5, cancelled); }, ErrorCode::cancelled, "");
}

TEST(FourierTransform, IsTheSumOverAllElements) {
  constexpr std::size_t lanes = FourierTransform::side_by_side, stride = FourierTransform::stride;
  Rng rng(9);
  for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 8u, 12u, 15u, 32u, 45u, 100u, 480u}) {
    SCOPED_TRACE(n);
    std::vector<double> elements(n * stride), scratch(n * stride);
    for (double& e : elements) e = rng.uniform() - 0.5;
    const std::vector<double> input = elements;
    const double* found = FourierTransform(n).run(elements.data(), scratch.data());
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        std::complex<double> sum = 0;
        for (std::size_t j = 0; j < n; ++j)
          sum += std::complex(input[j * stride + lane], input[j * stride + lanes + lane]) *
                 std::polar(1.0, -2 * pi * static_cast<double>(j * k % n) / static_cast<double>(n));
        EXPECT_NEAR(found[k * stride + lane], sum.real(), 1e-13);
        EXPECT_NEAR(found[k * stride + lanes + lane], sum.imag(), 1e-13);
      }
  }
}

TEST(FourierTransform, TakesProductsOfTwoThreeAndFive) {
  for (const std::size_t n : {1u, 2u, 30u, 10240u}) EXPECT_TRUE(FourierTransform::takes(n)) << n;
  for (const std::size_t n : {0u, 7u, 22u, 10241u}) EXPECT_FALSE(FourierTransform::takes(n)) << n;
}

TEST(SpreadingKernel, IsKaisersAndBesselsWindow) {
  const SpreadingKernel kernel;
  const double half = SpreadingKernel::reach / 2.0, b = pi * std::sqrt(0.5625 * 4 * half * half - 0.8);
  for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const SpreadingKernel::Values values = kernel.at(t);
    for (int j = 0; j < SpreadingKernel::reach; ++j) {
      const double z = (j + t - half) / half;
      EXPECT_NEAR(values[static_cast<std::size_t>(j)],
                  std::cyl_bessel_i(0, b * std::sqrt(std::max(0.0, 1 - z * z))) / std::cyl_bessel_i(0, b),
                  1e-14);
    }
  }
}

TEST(SpreadingKernel, HasTheTransformOfItsValues) {
  const SpreadingKernel kernel;
  for (const double periods : {0.0, 0.01, 0.1, 0.25}) {
    double sum = 0;  // the midpoint rule, which is exact but for aliasing
    for (int m = 0; m < 64; ++m) {
      const double t = (m + 0.5) / 64;
      const SpreadingKernel::Values values = kernel.at(t);
      for (int j = 0; j < SpreadingKernel::reach; ++j)
        sum += values[static_cast<std::size_t>(j)] *
               std::cos(2 * pi * periods * (j + t - SpreadingKernel::reach / 2.0)) / 64;
    }
    EXPECT_NEAR(kernel.transform(periods), sum, 1e-12) << periods;
  }
}

}  // namespace
}  // namespace wellspaced
