#pragma once

#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace wellspaced::bench {

/// What a row is held against.
struct Bar {
  double at_most = 0;  ///< in the row's unit; 0: none
  std::string unit;    ///< "s" a run, or "us", "ns" an item
  double items = 1;    ///< a run has so many
};

/// A bar for one of a row's counters, in place of its time.
struct CounterBar {
  enum class Sense { at_most, at_least };

  std::string counter;
  Sense sense = Sense::at_most;
  double limit = 0;
};

/// Shows, once all has run, one line a benchmark: median with its spread, the bar, and the counters.
class Table final : public benchmark::BenchmarkReporter {
 public:
  Table(std::map<std::string, Bar> bars, std::map<std::string, CounterBar> counter_bars)
      : bars_(std::move(bars)), counter_bars_(std::move(counter_bars)) {}

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;
  int missed() const { return missed_; }

 private:
  struct Row {
    std::vector<double> seconds;
    std::map<std::string, double> counters;
    std::string failure;
  };
  void print(const std::string& name, const Row& row);
  void print_verdict(const std::string& what, double limit, bool held);

  std::map<std::string, Bar> bars_;
  std::map<std::string, CounterBar> counter_bars_;
  std::vector<std::string> order_;
  std::map<std::string, Row> rows_;
  int missed_ = 0;
};

}  // namespace wellspaced::bench
