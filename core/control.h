#pragma once

#include <atomic>
#include <chrono>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"

namespace wellspaced {

/// What a long computation tells of itself. NaN: not known (yet).
struct Progress {
  double fraction = 0;  ///< of the work that is certain to be the most, in [0, 1]; never falls
  int sweep = 0;
  double beta = std::numeric_limits<double>::quiet_NaN();  ///< global ratio after `sweep`
  double r_c = std::numeric_limits<double>::quiet_NaN();
  double r_f = std::numeric_limits<double>::quiet_NaN();
};

/// Passed to everything that takes time: cancellation and deadline in, progress out, and how many threads may
/// be used (which never changes a result).
///
/// Thread safety: `cancel`, `cancelled` and `check` from any thread; `report` from one thread at a time.
class Control {
 public:
  using Clock = std::chrono::steady_clock;

  /// A control with a parent is over when its parent is.
  explicit Control(unsigned threads = 1, const Control* parent = nullptr)
      : threads_(threads == 0 ? 1 : threads), parent_(parent) {}
  virtual ~Control() = default;
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  unsigned threads() const { return threads_; }
  void cancel() { cancelled_ = true; }
  bool cancelled() const {
    return cancelled_ || (flag_ != nullptr && *flag_) || (parent_ != nullptr && parent_->cancelled());
  }
  /// Is cancelled, too, once the flag is true. Requires: it outlives this; nobody checks yet.
  void watch(const std::atomic<bool>& flag) { flag_ = &flag; }
  /// `message` is for the person whose work it ends: what happened, and the way out.
  void set_deadline(Clock::time_point deadline, std::string message = "the time limit for a job has passed") {
    deadline_ = deadline;
    deadline_message_ = std::move(message);
  }

  /// Call at least every few milliseconds of work.
  /// Errors: cancelled, deadline_exceeded.
  void check() const {
    if (cancelled_ || (flag_ != nullptr && *flag_))
      throw Error(ErrorCode::cancelled, "the computation was cancelled");
    if (parent_ != nullptr) parent_->check();
    if (Clock::now() > deadline_) throw Error(ErrorCode::deadline_exceeded, deadline_message_);
  }

  /// Passes progress on; a fraction lower than the last one is lifted to it.
  void report(Progress progress) {
    last_fraction_ = progress.fraction > last_fraction_ ? progress.fraction : last_fraction_;
    progress.fraction = last_fraction_;
    on_progress(progress);
  }

 protected:
  virtual void on_progress(const Progress&) {}

 private:
  unsigned threads_;
  const Control* parent_;
  std::atomic<bool> cancelled_ = false;
  const std::atomic<bool>* flag_ = nullptr;
  Clock::time_point deadline_ = Clock::time_point::max();
  std::string deadline_message_;
  double last_fraction_ = 0;
};

}  // namespace wellspaced
