#include "server/app.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include "server/context.h"
#include "server/handlers/operations.h"
#include "server/http/guard.h"
#include "server/http/router.h"
#include "server/log.h"
#include "server/memory.h"
#include "server/routes.h"

namespace wellspaced {
namespace {

void log_exchange(const http::Exchange& e) {
  nlohmann::ordered_json fields = {
      {"request_id", e.id},   {"method", e.method},     {"target", e.target},      {"status", e.status},
      {"seconds", e.seconds}, {"bytes_in", e.bytes_in}, {"bytes_out", e.bytes_out}};
  if (!e.trace_parent.empty()) fields["traceparent"] = e.trace_parent;
  if (e.failure.empty()) return log_info("request", std::move(fields));
  fields["failure"] = e.failure;
  log_error("request", std::move(fields));
}

/// A folder that can't be made is the store's error to report.
std::unique_ptr<JobStore> open_store(const Config& config) {
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(config.store).parent_path(), ignored);
  return open_sqlite_store(config.store, config.jobs);
}

void log_job(const JobFinished& finished) {
  nlohmann::ordered_json fields = {{"job", finished.id},
                                   {"operation", finished.operation},
                                   {"status", to_string(finished.status)},
                                   {"seconds", finished.seconds}};
  if (!finished.trace.empty()) fields["traceparent"] = finished.trace;
  log_info("job", std::move(fields));
}

WorkerPoolOptions pool_options(const Config& config) {
  WorkerPoolOptions options;
  options.workers = config.workers;
  options.threads_per_job = config.threads;
  options.job_limit_ms = config.job_limit_seconds * 1000;
  // Estimates are upper bounds for ordinary point sets; degenerate ones may take longer.
  options.attached_workers = 1;
  options.attached_limit_ms = static_cast<std::int64_t>(2000 * config.limits.sync_seconds);
  options.lease_ms = config.jobs.lease_ms;
  return options;
}

/// These are answered however busy everything else is.
Config with_reserved_paths(Config config) {
  config.http.reserved_paths = {"/livez", "/readyz", "/version", "/metrics"};
  return config;
}

}  // namespace

class App::Impl {
 public:
  explicit Impl(Config config)
      : config_(with_reserved_paths(std::move(config))),
        store_(open_store(config_)),
        context_{config_, *store_, metrics_},
        router_(routes(context_)),
        guard_(
            config_.http, [this](const http::Request& request) { return router_(request); },
            [this](const http::Exchange& exchange) {
              metrics_.count_exchange(exchange);
              log_exchange(exchange);
              ++ended_;
            }) {
    guard_.listen();  // before the workers: nothing runs if the address can't be had
    pool_ = std::make_unique<WorkerPool>(
        *store_, pool_options(config_),
        [this](const Claim& claim, Control& control) { return run(claim, control); },
        [this](const JobFinished& finished) {
          metrics_.count_finished(finished);
          log_job(finished);
          ++ended_;
        },
        [this] {
          ++context_.changes;
          guard_.wake();
        });
    context_.pool = pool_.get();
    context_.wake = [this] { guard_.wake(); };
  }

  int port() const { return guard_.port(); }

  bool serve() {
    log_info("serving", {{"listen", config_.http.host + ":" + std::to_string(port())},
                         {"store", config_.store},
                         {"workers", config_.workers},
                         {"threads", config_.threads}});
    std::thread closer([this] { tidy_until_asked_to_close(); });
    guard_.serve();
    stop();
    closer.join();
    const bool clean = pool_->stop();
    log_info("stopped", {{"clean", clean}});
    return clean;
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    context_.draining = true;
    changed_.notify_all();
  }

 private:
  std::string run(const Claim& claim, Control& control) {
    try {
      return run_job(context_, claim, control);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      log_error("job failed", {{"job", claim.id}, {"attempt", claim.attempt}, {"what", error.what()}});
      throw;
    }
  }

  /// Until `stop`. For a while after that, the door stays open: balancers see readyz fail, and clients are
  /// told to come back.
  void tidy_until_asked_to_close() {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, tidy_every, [this] { return stopping_; })) {
      lock.unlock();
      tidy();
      lock.lock();
    }
    lock.unlock();
    log_info("draining", {{"seconds", config_.drain_seconds}});
    std::this_thread::sleep_for(std::chrono::duration<double>(config_.drain_seconds));
    context_.pictures.cancel();
    guard_.stop();
  }

  /// After work, which may have been large.
  void tidy() {
    constexpr std::size_t worth_it = 64u << 20;
    const std::uint64_t ended = ended_;
    if (ended == tidied_) return;
    tidied_ = ended;
    return_free_memory(worth_it);
  }

  static constexpr std::chrono::seconds tidy_every{2};

  const Config config_;
  std::atomic<std::uint64_t> ended_ = 0;  ///< jobs and answers
  std::uint64_t tidied_ = 0;              ///< ended_ when there was last tidied up
  Metrics metrics_;
  std::unique_ptr<JobStore> store_;
  Context context_;
  http::Router router_;
  http::Guard guard_;
  std::unique_ptr<WorkerPool> pool_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
};

App::App(Config config) : impl_(std::make_unique<Impl>(std::move(config))) {}
App::~App() = default;
int App::port() const { return impl_->port(); }
bool App::serve() { return impl_->serve(); }
void App::stop() { impl_->stop(); }

}  // namespace wellspaced
