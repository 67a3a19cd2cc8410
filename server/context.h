#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "core/control.h"
#include "server/config.h"
#include "server/domain_cache.h"
#include "server/jobs/job_store.h"
#include "server/jobs/worker_pool.h"
#include "server/metrics.h"

namespace wellspaced {

/// What the handlers share; App owns it all.
struct Context {
  const Config& config;
  JobStore& store;
  Metrics& metrics;
  WorkerPool* pool = nullptr;              ///< set before the first request
  Control pictures{};                      ///< that are being drawn: over when the server stops
  std::atomic<unsigned> drawing = 0;       ///< how many are being drawn, see DrawingPlace
  std::function<void()> wake{};            ///< asks waiting responses whether they are ready
  std::atomic<bool> draining = false;      ///< no new work is taken
  std::atomic<std::uint64_t> changes = 0;  ///< grows whenever some job's state or events may have changed
  DomainCache domains{store};
};

}  // namespace wellspaced
