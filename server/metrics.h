#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "server/http/guard.h"
#include "server/jobs/job_store.h"
#include "server/jobs/worker_pool.h"

namespace wellspaced {

/// Counts what the service does, in the Prometheus text format. No ids in labels.
///
/// Thread safety: any thread.
class Metrics {
 public:
  void count_exchange(const http::Exchange& exchange);
  void count_submitted(const std::string& operation);
  void count_finished(const JobFinished& finished);
  void count_points(std::size_t generated);
  void count_rejected(const std::string& reason);

  /// Everything, with the queue's state as the store tells it now.
  std::string text(const JobCounts& queue) const;

 private:
  struct Histogram {
    std::vector<std::uint64_t> buckets;
    std::uint64_t count = 0;
    double sum = 0;
    void add(double seconds);
  };

  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> requests_, submitted_, finished_, rejected_;  // by label text
  std::map<std::string, Histogram> request_seconds_, run_seconds_;
  std::uint64_t points_ = 0;
};

}  // namespace wellspaced
