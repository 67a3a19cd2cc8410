#include "core/analyze/spectrum.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/generate/generate.h"
#include "core/generate/lattice.h"
#include "core/generate/poisson_disk.h"
#include "core/math.h"
#include "tests/support/oracle.h"

namespace wellspaced {
namespace {

using testing::random_points;

std::vector<PointSet> white_noise(double height, std::size_t n, int sets) {
  std::vector<PointSet> all;
  for (int s = 0; s < sets; ++s) all.push_back(random_points(1, height, n, static_cast<std::uint64_t>(s)));
  return all;
}

/// A periodogram whose value depends on |k| alone.
template <class Function>
Periodogram rings(double n, int k_max, const Function& f) {
  Periodogram p{k_max, n, 1, 1, {}};
  for (int kx = 0; kx <= k_max; ++kx)
    for (int ky = -k_max; ky <= k_max; ++ky) p.power.push_back(f(std::floor(std::hypot(kx, ky) + 0.5)));
  p.power[static_cast<std::size_t>(k_max)] = 0;
  return p;
}

TEST(Spectrum, OfWhiteNoiseIsOneInEveryDirection) {
  for (const double height : {1.0, 0.25}) {
    const double range = 90 / std::sqrt(1024 / height);
    const Spectrum s = spectrum(mean_periodogram(white_noise(height, 1024, 10), range, Control(2)), 10);
    EXPECT_EQ(s.n, 1024);
    ASSERT_EQ(s.power.size(), height == 1 ? 91u : 46u);
    for (std::size_t r = 5; r < s.power.size(); ++r) {
      const double members = pi * static_cast<double>(r) * 10;
      EXPECT_NEAR(s.power[r], 1, 5 / std::sqrt(members)) << r;
      EXPECT_NEAR(s.anisotropy_db[r], -10, 40 / std::sqrt(members / 10)) << r;
    }
    if (height == 1) {
      EXPECT_NEAR(mean_anisotropy_db(s).value(), -10, 0.3);
    }
  }
}

TEST(Spectrum, AgreesWithADirectSumOverRings) {
  const Periodogram p = periodogram(random_points(1, 1, 100, 7), 12, Control());
  const Spectrum s = spectrum(p);
  ASSERT_EQ(s.power.size(), 13u);
  for (int ring = 1; ring <= 12; ++ring) {
    std::vector<double> members;
    for (int kx = -12; kx <= 12; ++kx)
      for (int ky = -12; ky <= 12; ++ky)
        if ((kx > 0 || (kx == 0 && ky > 0)) && std::lround(std::hypot(kx, ky)) == ring)
          members.push_back(p.at(kx, ky));
    double mean = 0, variance = 0;
    for (const double m : members) mean += m / static_cast<double>(members.size());
    for (const double m : members)
      variance += (m - mean) * (m - mean) / static_cast<double>(members.size() - 1);
    EXPECT_NEAR(s.power[static_cast<std::size_t>(ring)], mean, 1e-12);
    EXPECT_NEAR(s.anisotropy_db[static_cast<std::size_t>(ring)], 10 * std::log10(variance / (mean * mean)),
                1e-9);
  }
}

TEST(Spectrum, OfAnIdealSetHasItsNyquistFrequencyAndNoOscillations) {
  const double root = 40;
  const Spectrum s = spectrum(rings(root * root, 260, [&](double r) { return r <= 0.8 * root ? 0.0 : 1.0; }));
  EXPECT_NEAR(effective_nyquist(s).value(), 0.8 / std::sqrt(0.9), 1 / root);
  EXPECT_EQ(oscillations(s).value(), 0);
}

TEST(Spectrum, MeasuresOscillationsByArea) {
  const double root = 20;
  const auto wave = [&](double r) { return r < root ? 0.0 : r < 2 * root ? 1.5 : r < 4 * root ? 0.8 : 1.0; };
  const double found = oscillations(spectrum(rings(root * root, 130, wave))).value();
  const double wanted = 10 * std::sqrt((0.25 * (4 - 1) + 0.04 * (16 - 4)) / (36 - 1));
  EXPECT_NEAR(found, wanted, 0.05);
}

TEST(Spectrum, OfMaximalPoissonDisksIsWhatTheFieldFound) {
  std::vector<PointSet> sets;
  Control control(2);
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    sets.push_back(poisson_disk_of_count(std::make_shared<Torus>(), 4000, rng, control));
    mean += oscillations(spectrum(periodogram(sets.back(), 400, control))).value() / 3;
  }
  EXPECT_NEAR(mean, 1.59, 0.1);
  const Periodogram all = mean_periodogram(sets, 6.3, control);
  EXPECT_NEAR(mean_anisotropy_db(spectrum(all, 3)).value(), 10 * std::log10(1 / 3.0), 0.15);
}

TEST(Spectrum, OfALatticeIsFarFromWhiteAndRound) {
  Control control;
  const PointSet lattice = square_lattice(std::make_shared<Torus>(), 400, control);
  const Spectrum s = spectrum(periodogram(lattice, 130, Control()));
  EXPECT_GT(oscillations(s).value(), 10);
  EXPECT_GT(s.anisotropy_db[20], 10);
  EXPECT_GT(effective_nyquist(s).value(), 0.9);
}

TEST(Spectrum, SaysNothingOfTheDirectionsOfRoundingErrors) {
  Control control;
  const Spectrum s =
      spectrum(periodogram(square_lattice(std::make_shared<Torus>(), 400, control), 50, Control()));
  for (std::size_t r = 1; r < 50; ++r) {
    const bool peak = r == 20 || r == 28 || r == 40 || r == 45;  // 20 times the roots of 1, 2, 4 and 5
    EXPECT_NE(std::isnan(s.anisotropy_db[r]), peak) << r;
  }
}

TEST(Spectrum, SaysNothingOfWhatItDoesNotReach) {
  const Spectrum s = spectrum(periodogram(random_points(1, 1, 1000, 1), 20, Control()));
  EXPECT_FALSE(oscillations(s));
  EXPECT_FALSE(mean_anisotropy_db(s));
  const Spectrum empty = spectrum(rings(100, 80, [](double) { return 0.0; }));
  EXPECT_FALSE(effective_nyquist(empty));
  EXPECT_FALSE(oscillations(empty));
  EXPECT_FALSE(mean_anisotropy_db(empty));
}

TEST(Spectrum, AveragesFrequencyByFrequency) {
  const std::vector<PointSet> sets = white_noise(1, 64, 3);
  const Periodogram mean = mean_periodogram(sets, 0.75, Control());
  EXPECT_EQ(mean.k_max, 6);
  EXPECT_EQ(mean.n, 64);
  std::vector<Periodogram> each;
  for (const PointSet& set : sets) each.push_back(periodogram(set, 6, Control()));
  for (std::size_t i = 0; i < mean.power.size(); ++i)
    EXPECT_NEAR(mean.power[i], (each[0].power[i] + each[1].power[i] + each[2].power[i]) / 3, 1e-12);
  EXPECT_EQ(mean_periodogram({sets.data(), 1}, 0.75, Control()).power, each[0].power);
}

}  // namespace
}  // namespace wellspaced
