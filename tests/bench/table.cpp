#include "tests/bench/table.h"

#include <algorithm>
#include <cstdio>

namespace wellspaced::bench {
namespace {

double scale_of(const std::string& unit) { return unit == "us" ? 1e6 : unit == "ns" ? 1e9 : 1; }

/// Google Benchmark puts what it was told after the name: "/iterations:1/repeats:5/process_time".
std::string plain_name(const std::string& name) {
  std::size_t end = name.size();
  for (const char* suffix : {"/iterations:", "/repeats:", "/process_time", "/real_time"})
    end = std::min(end, name.find(suffix));
  return name.substr(0, end);
}

}  // namespace

void Table::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type == Run::RT_Aggregate) continue;
    const std::string name = plain_name(run.benchmark_name());
    if (rows_.find(name) == rows_.end()) order_.push_back(name);
    Row& row = rows_[name];
    if (run.error_occurred) {
      row.failure = run.error_message;
      continue;
    }
    const bool wall = run.benchmark_name().find("/real_time") != std::string::npos;
    row.seconds.push_back((wall ? run.real_accumulated_time : run.cpu_accumulated_time) /
                          static_cast<double>(run.iterations));
    for (const auto& [counter, value] : run.counters) row.counters[counter] = value;
  }
}

void Table::print(const std::string& name, const Row& row) {
  const Bar bar = bars_.count(name) != 0 ? bars_.at(name) : Bar{0, "s", 1};
  if (!row.failure.empty() || row.seconds.empty()) {
    ++missed_;
    std::printf("%-34s FAILED: %s\n", name.c_str(), row.failure.c_str());
    return;
  }
  std::vector<double> figures;
  for (const double s : row.seconds) figures.push_back(s * scale_of(bar.unit) / bar.items);
  std::sort(figures.begin(), figures.end());
  const double median = figures[figures.size() / 2];
  std::printf("%-34s %10.4g %-2s  [%.4g, %.4g]", name.c_str(), median, bar.unit.c_str(), figures.front(),
              figures.back());
  if (bar.at_most > 0) print_verdict("bar", bar.at_most, median <= bar.at_most);
  if (const auto found = counter_bars_.find(name); found != counter_bars_.end()) {
    const auto& [counter, sense, limit] = found->second;
    const double value = row.counters.at(counter);
    const bool at_most = sense == CounterBar::Sense::at_most;
    print_verdict(counter + (at_most ? " at most" : " at least"), limit,
                  at_most ? value <= limit : value >= limit);
  }
  for (const auto& [counter, value] : row.counters) std::printf("  %s %.5g", counter.c_str(), value);
  std::printf("\n");
}

void Table::print_verdict(const std::string& what, double limit, bool held) {
  missed_ += held ? 0 : 1;
  std::printf("  %s %.4g: %s", what.c_str(), limit, held ? "held" : "MISSED");
}

void Table::Finalize() {
  std::printf("%-34s %10s     [least, most] of the repetitions\n", "work", "median");
  for (const std::string& name : order_) print(name, rows_.at(name));
}

}  // namespace wellspaced::bench
