#include "server/handlers/waiting.h"

#include "core/error.h"
#include "server/handlers/answer.h"

namespace wellspaced {
namespace {

/// Another process may end the job, of which nobody here is told.
constexpr std::chrono::seconds look_anyway{2};

}  // namespace

JobWait::JobWait(Context& context, std::string id, std::optional<int> wait_seconds)
    : context_(context), id_(std::move(id)) {
  if (wait_seconds) deadline_ = Clock::now() + std::chrono::seconds(*wait_seconds);
}

bool JobWait::ready() {
  const auto now = Clock::now();
  // Who said how long to wait can do with less, and a stopping server should not keep them to the end.
  if (deadline_ && (now >= *deadline_ || context_.draining)) return true;
  const std::uint64_t changes = context_.changes;
  if (seen_ == changes && now < look_again_) return false;
  seen_ = changes;
  look_again_ = now + look_anyway;
  try {
    const auto job = context_.store.find(id_);
    return !job || is_terminal(job->status);
  } catch (const Error&) {
    return false;  // the store may come back; finish() would only pass its failure on
  }
}

Job JobWait::find() const { return find_job(context_, id_); }

Job find_job(Context& context, const std::string& id) {
  if (auto job = context.store.find(id)) return *std::move(job);
  throw Error(ErrorCode::no_such_job,
              "there is no job with this id; it may have expired, or the id is incomplete");
}

http::Response accepted_response(const Job& job) {
  http::Response response = json_response(job_to_json(job), 202);
  response.set("Location", "/v1/jobs/" + job.id)
      .set("Retry-After", "1")
      .set("Preference-Applied", "respond-async")
      .set("Wellspaced-Job", job.id)
      .set("Vary", "Prefer, Accept");
  return response;
}

}  // namespace wellspaced
