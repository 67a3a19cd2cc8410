#pragma once

#include <memory>

#include "server/config.h"

namespace wellspaced {

/// The whole service, wired: store, workers, metrics, routes, guard.
///
/// Thread safety: `stop` from any thread, any number of times; the rest from one.
class App {
 public:
  /// Requires: complete(config), require_store(config). Errors: storage_unavailable; internal if the address
  /// can't be had.
  explicit App(Config config);
  ~App();

  int port() const;

  /// Until `stop`. Then readyz and new work get 503 for drain_seconds, requests under way are answered,
  /// running jobs go back to the queue. False if a computation didn't listen: the process should then end
  /// without destroying this.
  bool serve();
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wellspaced
