#include "proto/execute.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/analyze/bond_order.h"
#include "core/analyze/certificate.h"
#include "core/analyze/differential.h"
#include "core/analyze/discrepancy.h"
#include "core/analyze/distributions.h"
#include "core/analyze/pair_correlation.h"
#include "core/analyze/spacing.h"
#include "core/analyze/zone_plate.h"
#include "tests/support/proto_requests.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using testing::read;
using testing::run;

std::vector<std::string> keys(const nlohmann::ordered_json& object) {
  std::vector<std::string> out;
  for (const auto& [key, value] : object.items()) out.push_back(key);
  return out;
}

const char* const optimize_400 =
    R"({"points":{"generate":{"count":400,"seed":3}},"method":"opt-beta-local","beta":0.9,"max_sweeps":20})";

TEST(Execute, GenerateTellsWhatItMade) {
  const Result result = run("generate", R"({"count":500,"seed":7,"domain":{"width":2}})");
  EXPECT_EQ(result.operation, "generate");
  EXPECT_THAT(keys(result.summary), ElementsAre("n", "method", "parameters", "seed", "version", "domain"));
  EXPECT_EQ(result.summary["n"], result.points().size());
  EXPECT_EQ(result.summary["method"], "poisson-disk");
  EXPECT_EQ(result.summary["parameters"].dump(), R"({"count":500})");
  EXPECT_EQ(result.summary["seed"], 7u);
  EXPECT_EQ(result.summary["version"], std::string(version()));
  EXPECT_EQ(result.summary["domain"].dump(), R"({"type":"torus","width":2.0,"height":1.0})");
}

TEST(Execute, GeneratorsWithoutRandomnessTellNoSeed) {
  const Result result = run("generate", R"({"method":"square","count":100,"seed":7})");
  EXPECT_EQ(result.points().size(), 100u);
  EXPECT_FALSE(result.summary.contains("seed"));
}

TEST(Execute, EveryGeneratorMakesWhatItExpects) {
  for (const Generator& generator : generators()) {
    const Result result =
        run("generate", R"({"count":2000,"domain":{"width":2},"method":")" + generator.name + "\"}");
    EXPECT_EQ(result.points().size(), 2000u) << generator.name;
    EXPECT_EQ(result.summary["method"], generator.name);
  }
}

TEST(Execute, EnrichFillsHolesBeforeItOptimizes) {
  const std::string points = R"({"points":{"generate":{"method":"white-noise","count":300}})";
  const Result plain = run("optimize", points + R"(,"beta":0.9,"max_visits":1})");
  EXPECT_FALSE(plain.summary.contains("enriched"));
  EXPECT_EQ(run("optimize", points + R"(,"beta":0.9,"max_visits":1,"enrich":false})").summary, plain.summary);
  const Result result = run("optimize", points + R"(,"beta":0.9,"max_visits":1,"enrich":true})");
  const std::size_t inserted = result.summary["enriched"];
  EXPECT_GT(inserted, 30u);
  EXPECT_EQ(result.points().size(), 300 + inserted);
  EXPECT_EQ(result.summary["n"], 300 + inserted);
  EXPECT_FALSE(result.summary["parameters"].contains("enrich"));
  EXPECT_LE(result.summary["history"][0][2].get<double>(), std::sqrt(0.6966 / 300) * (1 + 1e-9));
  EXPECT_GT(plain.summary["history"][0][2].get<double>(), std::sqrt(0.6966 / 300));
}

TEST(Execute, EnrichLeavesMaximalSetsAlone) {
  for (const std::string method : {"poisson-disk", "delaunay-refinement", "square"}) {
    const std::string source = R"({"points":{"generate":{"count":256,"method":")" + method + R"("}})";
    const Result result = run("optimize", source + R"(,"method":"opt-beta","beta":0.9,"enrich":true})");
    EXPECT_EQ(result.summary["enriched"], 0) << method;
    EXPECT_EQ(result.points().size(), 256u) << method;
  }
}

TEST(Execute, OptimizeTellsWhatItReached) {
  const Result result = run("optimize", optimize_400);
  EXPECT_THAT(keys(result.summary),
              ElementsAre("n", "method", "parameters", "beta", "r_f", "r_f_free", "r_c", "rho", "beta_i_max",
                          "beta_i_mean", "sweeps", "beta_upper", "r_f_lower", "r_c_upper", "converged",
                          "history", "seed", "version", "domain"));
  const Spacing spacing = measure_spacing(result.points(), Control());
  EXPECT_EQ(result.summary["n"], result.points().size());
  EXPECT_EQ(result.summary["parameters"].dump(), R"({"beta":0.9,"max_sweeps":20})");
  EXPECT_EQ(result.summary["beta"], spacing.beta);
  EXPECT_EQ(result.summary["r_f"], spacing.r_f);
  EXPECT_EQ(result.summary["r_c"], spacing.r_c);
  const Certificate proof = certify(result.points(), Control()).value();
  EXPECT_EQ(result.summary["beta_upper"], proof.beta_upper);
  EXPECT_EQ(result.summary["r_f_lower"], proof.r_f_lower);
  EXPECT_EQ(result.summary["r_c_upper"], proof.r_c_upper);
  EXPECT_EQ(result.summary["converged"], proof.beta_upper <= 0.9);
  const auto& history = result.summary["history"];
  ASSERT_EQ(history.size(), result.summary["sweeps"].get<std::size_t>() + 1);
  double best = history[0][1];
  for (std::size_t k = 0; k < history.size(); ++k) {
    EXPECT_EQ(history[k][0], k);
    EXPECT_NEAR(history[k][1].get<double>(), history[k][2].get<double>() / history[k][3].get<double>(),
                1e-12);
    best = std::min(best, history[k][1].get<double>());
  }
  EXPECT_NEAR(spacing.beta, best, 1e-12);
}

TEST(Execute, TellsAChoiceByItsName) {
  const std::string request =
      R"({"points":{"generate":{"count":300}},"method":"opt-beta","beta":0.8,"randomness":)";
  const Result fast = run("optimize", request + R"("fast"})"),
               gentle = run("optimize", request + R"("gentle"})");
  EXPECT_EQ(fast.summary["parameters"].dump(), R"({"beta":0.8,"randomness":"fast"})");
  EXPECT_EQ(fast.summary["converged"], true);
  EXPECT_EQ(gentle.summary["converged"], true);
  EXPECT_NE(fast.points().coordinates, gentle.points().coordinates);
}

TEST(Execute, OptimizeSaysWhenItMissedItsTarget) {
  const Result result =
      run("optimize",
          R"({"points":{"generate":{"count":300}},"method":"opt-beta-local","beta":0.6,"max_sweeps":2})");
  EXPECT_EQ(result.summary["converged"], false);
  EXPECT_EQ(result.summary["sweeps"], 2);
  EXPECT_LT(result.summary["beta"].get<double>(), 1);
}

TEST(Execute, CountsATargetAsReachedOnlyWhenThatIsProven) {
  // A lattice's beta is 1 / sqrt(2) to within rounding, so no bound on it can be that low.
  const Result result = run("optimize", R"({"points":{"generate":{"method":"square","count":100}},"beta":)" +
                                            std::to_string(0.70710678118654746) + "}");
  EXPECT_GT(result.summary["beta_upper"].get<double>(), result.summary["beta"].get<double>());
  EXPECT_EQ(result.summary["converged"],
            result.summary["beta_upper"].get<double>() <= result.summary["parameters"]["beta"].get<double>());
}

TEST(Execute, AnalyzeProvesOnRequest) {
  const Result result =
      run("analyze", R"({"points":{"generate":{"count":200}},"measures":["certificate","spacing"]})");
  EXPECT_THAT(keys(result.summary["certificate"]), ElementsAre("beta_upper", "r_f_lower", "r_c_upper"));
  EXPECT_NEAR(result.summary["certificate"]["beta_upper"].get<double>(),
              result.summary["spacing"]["beta"].get<double>(), 1e-11);
}

TEST(Execute, AnalyzeTellsOneObjectAMeasure) {
  const Result result =
      run("analyze", R"({"points":{"generate":{"method":"square","count":100}},"measures":["spacing"]})");
  EXPECT_THAT(keys(result.summary), ElementsAre("n", "spacing", "version", "domain"));
  EXPECT_EQ(result.summary["n"], 100);
  EXPECT_NEAR(result.summary["spacing"]["beta"].get<double>(), 1 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result.summary["spacing"]["r_f"].get<double>(), 0.1, 1e-12);
}

TEST(Execute, AnalyzeTellsTheSeedOfWhatItGenerated) {
  EXPECT_EQ(run("analyze", R"({"points":{"generate":{"count":100,"seed":5}}})").summary["seed"], 5u);
  EXPECT_FALSE(run("analyze", R"({"points":{"job":"known"}})").summary.contains("seed"));
}

TEST(Execute, KeepsTheWantedPicture) {
  EXPECT_EQ(run("generate", R"({"count":100,"picture":"delaunay"})").picture, "delaunay");
  EXPECT_TRUE(run("generate", R"({"count":100})").picture.is_null());
}

TEST(Execute, GivesTheSameBytesOnAnyNumberOfThreads) {
  const std::pair<const char*, std::string> requests[] = {
      {"generate", R"({"count":3000,"seed":1})"},
      {"optimize", optimize_400},
      {"analyze", R"({"points":{"generate":{"count":3000,"seed":1}}})"},
  };
  for (const auto& [operation, body] : requests) {
    const std::string one = store_result(run(operation, body, 1));
    EXPECT_TRUE(one == store_result(run(operation, body, 2))) << operation;
    EXPECT_TRUE(one == store_result(run(operation, body, 5))) << operation;
  }
}

TEST(Execute, SeesNoDifferenceBetweenGeneratedAndUploadedPoints) {
  const Result made = run("generate", R"({"count":300,"seed":2})");
  const std::string bytes = encode_result(made, Format::npy, "", {}, Control()).bytes;
  Control control;
  const Result uploaded =
      execute(testing::read_table("optimize", "application/x-npy", bytes,
                                  {{"method", "opt-beta-local"}, {"beta", "0.9"}, {"max_sweeps", "3"}}),
              control);
  const Result chained = run(
      "optimize",
      R"({"points":{"generate":{"count":300,"seed":2}},"method":"opt-beta-local","beta":0.9,"max_sweeps":3})");
  EXPECT_EQ(uploaded.points().coordinates, chained.points().coordinates);
}

TEST(Execute, PointsToWhatItCouldNotWorkOn) {
  // Poisson-disk sampling leaves room for one or two points only, which is known only after the work.
  try {
    run("analyze", R"({"points":{"generate":{"radius":0.7}}})");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(ErrorCode::degenerate_input));
    EXPECT_EQ(error.where(), "/points/generate/radius");
    EXPECT_THAT(error.what(), ::testing::HasSubstr("at least 3"));
  }
}

/// Remembers what it was told.
class Witness final : public Control {
 public:
  std::vector<Progress> seen;

 private:
  void on_progress(const Progress& progress) override { seen.push_back(progress); }
};

TEST(Execute, ReportsProgressThatNeverFallsAndEndsAtOne) {
  for (const char* operation : {"optimize", "analyze"}) {
    Witness witness;
    execute(read(operation, R"({"points":{"generate":{"count":2000}}})"), witness);
    ASSERT_FALSE(witness.seen.empty()) << operation;
    for (std::size_t k = 1; k < witness.seen.size(); ++k)
      EXPECT_LE(witness.seen[k - 1].fraction, witness.seen[k].fraction) << operation;
    EXPECT_EQ(witness.seen.back().fraction, 1) << operation;
  }
}

TEST(Execute, StopsWhenItIsCancelled) {
  for (const char* operation : {"optimize", "analyze"}) {
    Control control;
    control.cancel();
    try {
      execute(read(operation, R"({"points":{"generate":{"count":2000}}})"), control);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(ErrorCode::cancelled));
    }
  }
}

TEST(Execute, AveragesOverSets) {
  const std::string points = R"({"points":{"generate":{"count":300,"seed":5}})";
  const Result both = run("analyze", points + R"(,"seeds":2,"measures":["spacing","certificate"]})");
  ASSERT_EQ(both.groups.size(), 1u);
  ASSERT_EQ(both.groups[0].sets.size(), 2u);
  EXPECT_EQ(both.summary["sets"], 2);
  EXPECT_EQ(both.summary["n"], 300);
  EXPECT_EQ(both.summary["seed"], 5);
  const Result first = run("analyze", points + R"(,"measures":["spacing","certificate"]})");
  const Result second = run("analyze", R"({"points":{"generate":{"count":300,"seed":6}},
      "measures":["spacing","certificate"]})");
  EXPECT_FALSE(first.summary.contains("sets"));
  EXPECT_EQ(both.summary["spacing"]["by_set"][0], first.summary["spacing"]);
  EXPECT_EQ(both.summary["spacing"]["by_set"][1], second.summary["spacing"]);
  EXPECT_DOUBLE_EQ(
      both.summary["spacing"]["rho"],
      (first.summary["spacing"]["rho"].get<double>() + second.summary["spacing"]["rho"].get<double>()) / 2);
  EXPECT_EQ(both.summary["spacing"]["valence"]["6"],
            first.summary["spacing"]["valence"]["6"].get<int>() +
                second.summary["spacing"]["valence"]["6"].get<int>());
  EXPECT_EQ(both.summary["certificate"]["beta_upper"],
            std::max(first.summary["certificate"]["beta_upper"].get<double>(),
                     second.summary["certificate"]["beta_upper"].get<double>()));
}

TEST(Execute, ComparesGroupsEachOnItsOwn) {
  const Result result = run("analyze", R"({"compare":[
      {"label":"random","points":{"generate":{"method":"white-noise","count":50}}},
      {"label":"even","points":{"optimize":{"points":{"generate":{"count":100,"seed":3}},"beta":0.8}}}]})");
  EXPECT_THAT(keys(result.summary), ElementsAre("compare", "version"));
  const auto& compared = result.summary["compare"];
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_THAT(keys(compared[0]), ElementsAre("label", "n", "spacing", "seed", "domain"));
  EXPECT_THAT(keys(compared[1]), ElementsAre("label", "n", "spacing", "optimized", "seed", "domain"));
  const Result optimized = run("optimize", R"({"points":{"generate":{"count":100,"seed":3}},"beta":0.8})");
  EXPECT_EQ(result.groups[1].sets[0].coordinates, optimized.points().coordinates);
  EXPECT_EQ(compared[1]["optimized"][0]["history"], optimized.summary["history"]);
  EXPECT_EQ(compared[1]["spacing"]["beta"], optimized.summary["beta"]);
  EXPECT_EQ(result.groups[0].label, "random");
}

TEST(Execute, OptimizersWorkOneAfterTheOther) {
  const std::string first = R"({"points":{"generate":{"count":100}},"method":"push-pull","max_sweeps":2})";
  const Result pushed = run("optimize", first);
  const Result both =
      run("optimize", R"({"points":{"optimize":)" + first + R"(},"method":"distmesh","max_sweeps":3})");
  EXPECT_EQ(both.summary["history"][0][1], pushed.summary["beta"]);
}

TEST(Execute, MeasuresSpectra) {
  const std::string lattice = R"({"points":{"generate":{"method":"square","count":400}},"measures":[)";
  const auto spectrum =
      run("analyze", lattice + R"({"measure":"spectrum","range":2.5}]})").summary["spectrum"];
  ASSERT_EQ(spectrum["power"].size(), 51u);
  EXPECT_EQ(spectrum["frequency"][20], 1.0);
  EXPECT_GT(spectrum["power"][20].get<double>(), 10);
  EXPECT_NEAR(spectrum["power"][10].get<double>(), 0, 1e-9);
  EXPECT_TRUE(spectrum["oscillations"].is_null());
  const auto power =
      run("analyze", lattice + R"({"measure":"periodogram","range":1}]})").summary["periodogram"]["power"];
  ASSERT_EQ(power.size(), 21u);
  ASSERT_EQ(power[0].size(), 41u);
  EXPECT_NEAR(power[20][40].get<double>(), 400, 1e-6);
  EXPECT_NEAR(power[20][39].get<double>(), 0, 1e-6);
  const auto averaged = run("analyze", R"({"points":{"generate":{"method":"white-noise","count":500}},
      "seeds":8,"measures":["spectrum"]})")
                            .summary["spectrum"];
  EXPECT_NEAR(averaged["anisotropy_expected_db"].get<double>(), -9.03, 0.01);
  EXPECT_NEAR(averaged["anisotropy_mean_db"].get<double>(), -9.03, 0.6);
  EXPECT_NEAR(averaged["power"][40].get<double>(), 1, 0.2);
}

/// Two sets as an array, and what a measure says of both, with parameters if any are given.
nlohmann::ordered_json measured(const std::string& call) {
  return run("analyze",
             R"({"points":{"generate":{"count":300,"seed":1}},"seeds":2,"measures":[)" + call + "]}")
      .summary;
}

std::vector<PointSet> two_sets() {
  std::vector<PointSet> sets;
  for (const char* seed : {"1", "2"})
    sets.push_back(run("generate", R"({"count":300,"seed":)" + std::string(seed) + "}").points());
  return sets;
}

double mean_of(const std::function<double(const PointSet&)>& measure) {
  double sum = 0;
  for (const PointSet& set : two_sets()) sum += measure(set) / 2;
  return sum;
}

TEST(Execute, AveragesDiscrepancyAndBondOrder) {
  const auto d = measured(R"("discrepancy")")["discrepancy"];
  EXPECT_NEAR(d["star"], mean_of([](const PointSet& p) { return discrepancy(p, Control()).star; }), 1e-15);
  EXPECT_NEAR(d["l2_periodic"],
              mean_of([](const PointSet& p) { return discrepancy(p, Control()).l2_periodic; }), 1e-15);
  const auto b = measured(R"("bond-order")")["bond-order"];
  EXPECT_NEAR(b["psi6_local"], mean_of([](const PointSet& p) { return bond_order(p, Control()).psi6_local; }),
              1e-15);
  EXPECT_NEAR(b["psi6_edges"], mean_of([](const PointSet& p) { return bond_order(p, Control()).psi6_edges; }),
              1e-15);
}

TEST(Execute, PoolsDistributions) {
  const auto d = measured(R"("distributions")")["distributions"];
  std::vector<Distributions> all;
  for (const PointSet& set : two_sets()) all.push_back(distributions(set, Control()));
  const Distributions pooled = pool(std::span<const Distributions>(all));
  EXPECT_EQ(d["beta_i"]["counts"], pooled.beta_i.counts);
  EXPECT_EQ(d["valence"]["low"], pooled.valence.low);
  EXPECT_EQ(d["angle_deg"]["mean"], pooled.angle_deg.mean);
  std::uint64_t total = d["nearest"]["above"];
  for (const auto& count : d["nearest"]["counts"]) total += count.get<std::uint64_t>();
  EXPECT_EQ(total, 600u);
}

TEST(Execute, AveragesPairCorrelationAndDifferentials) {
  const auto g = measured(R"({"measure":"pair-correlation","reach":3,"bins":30})")["pair-correlation"];
  ASSERT_EQ(g["g"].size(), 30u);
  EXPECT_NEAR(g["r"][29], 2.95, 1e-12);
  EXPECT_NEAR(g["g"][9], mean_of([](const PointSet& p) {
                return pair_correlation(p, {3, 30}, Control()).g[9];
              }),
              1e-12);
  EXPECT_NEAR(g["peak"]["r"], 0.85, 0.11);
  const auto d = measured(R"({"measure":"differential","reach":3,"pixels":61})")["differential"];
  EXPECT_EQ(d["reach"], 3.0);
  EXPECT_EQ(d["r"].size(), d["density"].size());
  const std::vector<double> radii(300, 1.0);
  EXPECT_NEAR(d["density"][25], mean_of([&](const PointSet& p) {
                return differential_domain(p, radii, {3, 61, 0.05}, Control()).mean[25];
              }),
              1e-12);
}

TEST(Execute, TakesASizingFunction) {
  const std::string points = R"({"points":{"generate":{"count":300,"seed":1}},"measures":["differential"])";
  const Result plain = run("analyze", points + "}");
  const Result same = run("analyze", points + R"(,"sizing":{"type":"constant","radius":0.3}})");
  const Result linear =
      run("analyze", points + R"(,"sizing":{"type":"linear","axis":"y","from":0.2,"to":0.1}})");
  EXPECT_FALSE(plain.summary.contains("sizing"));
  EXPECT_EQ(same.summary["differential"], plain.summary["differential"]);
  EXPECT_NE(linear.summary["differential"], plain.summary["differential"]);
  EXPECT_NEAR(linear.summary["sizing"]["lipschitz"], 0.1, 1e-15);
  EXPECT_EQ(linear.groups[0].sets[0].sizing->at({0.5, 0.5, 0}), 0.15000000000000002);
}

TEST(Execute, MeasuresEachPoint) {
  const auto local = measured(R"("local")")["local"]["by_set"];
  ASSERT_EQ(local.size(), 2u);
  const std::vector<PointSet> sets = two_sets();
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(local[s]["beta_i"], measure_local_spacing(sets[s], Control()).beta_i);
    EXPECT_EQ(local[s]["psi6"], bond_order(sets[s], Control()).psi6);
    double area = 0, neighbors = 0, smallest = 180;
    for (std::size_t i = 0; i < 300; ++i) {
      area += local[s]["area"][i].get<double>();
      neighbors += local[s]["valence"][i].get<double>();
      smallest = std::min(smallest, local[s]["angle"][i].get<double>());
    }
    EXPECT_NEAR(area, 300, 1e-9);
    EXPECT_EQ(neighbors, 1800);
    EXPECT_NEAR(smallest, measure_spacing(sets[s], Control()).angle_min_deg, 1e-9);
  }
}

TEST(Execute, MeasuresAliasingByTheZonePlate) {
  const auto z = measured(R"({"measure":"zone-plate","sigma":0.6,"columns":20})")["zone-plate"];
  EXPECT_EQ(z["columns"], 20);
  EXPECT_EQ(z["rows"], 20);
  EXPECT_NEAR(z["k"], 0.5 * std::sqrt(300), 1e-9);
  const ZonePlateOptions options{20, 0.5, 0.6};
  EXPECT_NEAR(z["rmse"], mean_of([&](const PointSet& p) { return zone_plate(p, options, Control()).rmse; }),
              1e-15);
}

TEST(Execute, SaysWhichParameterOfAMeasureIsBad) {
  const auto refused = [](const std::string& call, const char* where) {
    try {
      measured(R"("spacing",)" + call);
      ADD_FAILURE() << call;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << error.what();
      EXPECT_EQ(error.where(), where);
    }
  };
  refused(R"({"measure":"differential","pixels":100})", "/measures/1/pixels");
  refused(R"({"measure":"differential","sigma":3})", "/measures/1/sigma");
  refused(R"({"measure":"pair-correlation","bins":0})", "/measures/1/bins");
}

/// A set by another sampler, and the spectrum that another program found: through the whole contract.
TEST(Execute, FindsThePeriodogramThatAnotherProgramFound) {
  const std::string folder = std::string(WELLSPACED_TEST_DATA) + "/points/";
  std::ifstream points(folder + "utk_AAPatterns.dat"), spectrum(folder + "utk_AAPatterns_spectrum.dat");
  std::string csv, x, y;
  while (points >> x >> y) csv += x + "," + y + "\n";
  Control control(2);
  const double range = 79.0 / 32;  // of 1024 points
  const Request request =
      testing::read_table("analyze", "text/csv", csv,
                          {{"measures", "periodogram"}, {"periodogram.range", std::to_string(range)}});
  const auto found = execute(request, control).summary["periodogram"];
  ASSERT_EQ(found["k_max"], 79);
  for (int ky = -79; ky <= 79; ++ky)
    for (int kx = -79; kx <= 79; ++kx) {
      double wanted = NAN;
      spectrum >> wanted;
      const int a = kx < 0 ? -kx : kx, b = kx < 0 ? -ky : ky;
      const double power = found["power"][static_cast<std::size_t>(a)][static_cast<std::size_t>(b + 79)];
      EXPECT_NEAR(power, wanted, 1e-9 * std::max(1.0, wanted)) << kx << ", " << ky;
    }
}

TEST(Execute, TellsAtRunTimeWhatOnlyTheWorkShows) {
  const auto by_radius = [](const std::string& rest) { run("analyze", R"({"points":{"generate":)" + rest); };
  try {
    by_radius(R"({"radius":0.03}},"seeds":5})");
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters);
    EXPECT_EQ(error.where(), "/points");
    EXPECT_THAT(error.what(), ::testing::HasSubstr("generate by count"));
  }
  try {
    by_radius(R"({"radius":0.7}}})");
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::degenerate_input);
    EXPECT_EQ(error.where(), "/points/generate/radius");
  }
}

}  // namespace
}  // namespace wellspaced
