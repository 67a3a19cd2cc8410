#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "server/context.h"
#include "server/http/message.h"
#include "server/jobs/job.h"

namespace wellspaced {

/// A response that waits for a job to be over, or for a time to pass, without occupying a thread.
class JobWait : public http::Pending {
 public:
  /// Without a time, only the job's end counts; with one, the wait also ends when the server begins to stop.
  JobWait(Context& context, std::string id, std::optional<int> wait_seconds);
  bool ready() override;

 protected:
  /// Errors: no_such_job.
  Job find() const;

  Context& context_;
  std::string id_;

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point look_again_;
  std::optional<std::uint64_t> seen_;  ///< Context::changes when the store was last asked
};

/// Errors: no_such_job.
Job find_job(Context& context, const std::string& id);

/// 202 with the job's status.
http::Response accepted_response(const Job& job);

}  // namespace wellspaced
