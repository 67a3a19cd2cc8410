#include "server/handlers/jobs.h"

#include <charconv>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/document.h"
#include "proto/fields.h"
#include "proto/operations.h"
#include "proto/result.h"
#include "server/handlers/answer.h"
#include "server/handlers/drawing_place.h"
#include "server/handlers/waiting.h"
#include "server/http/range.h"
#include "server/jobs/job_id.h"

namespace wellspaced {
namespace {

constexpr int most_jobs_a_page = 500;

std::string read_operation(const std::string& name) {
  std::string known;
  for (const char* const operation : operation_names) {
    if (name == operation) return name;
    known += (known.empty() ? "" : ", ") + std::string(operation);
  }
  throw Error(ErrorCode::invalid_parameters, "unknown operation; there are: " + known, "/operation");
}

JobFilter read_filter(const http::Request& request) {
  JobFilter filter;
  for (const auto& [name, value] : request.query) {
    if (name == "status") {
      try {
        filter.status = job_status_from(value);
      } catch (const Error& error) {
        throw Error(error.code(), error.what(), "/status");
      }
    } else if (name == "operation") {
      filter.operation = read_operation(value);
    } else if (name == "cursor") {
      if (!is_job_id(value))
        throw Error(ErrorCode::invalid_parameters,
                    "not a cursor; take it from the Link header of the page before", "/cursor");
      filter.cursor = value;
    } else if (name == "limit") {
      const auto end = std::from_chars(value.data(), value.data() + value.size(), filter.limit);
      if (end.ec != std::errc() || end.ptr != value.data() + value.size() || filter.limit < 1 ||
          filter.limit > most_jobs_a_page)
        throw Error(ErrorCode::invalid_parameters, "limit must be a whole number from 1 to 500", "/limit");
    } else {
      throw Error(ErrorCode::invalid_parameters,
                  "unknown parameter; known here are: status, operation, limit, cursor", pointer_token(name));
    }
  }
  return filter;
}

std::string next_page(const JobFilter& filter, const std::string& cursor) {
  std::string target = "/v1/jobs?limit=" + std::to_string(filter.limit) + "&cursor=" + cursor;
  if (filter.status) target += std::string("&status=") + to_string(*filter.status);
  // Job ids and names of operations, so nothing here needs escaping.
  if (!filter.operation.empty()) target += "&operation=" + filter.operation;
  return target;
}

/// GET of a job with `Prefer: wait`.
class StatusWait final : public JobWait {
 public:
  using JobWait::JobWait;
  http::Response finish() override { return json_response(job_to_json(find())); }
};

std::string event_text(const std::string& type, std::int64_t sequence, const std::string& data) {
  std::string one_line = data;
  std::erase(one_line, '\n');
  return "event: " + type + "\nid: " + std::to_string(sequence) + "\ndata: " + one_line + "\n\n";
}

/// The events of one job from a sequence number on, until it is done.
class JobEvents final : public http::EventSource {
 public:
  JobEvents(Context& context, std::string id, std::int64_t after)
      : context_(context),
        id_(std::move(id)),
        sequence_(after),
        next_comment_(Clock::now() + comment_every) {}

  std::optional<std::string> poll() override {
    if (done_) return std::nullopt;
    const auto now = Clock::now();
    const std::uint64_t changes = context_.changes;
    std::string out;
    if (seen_ != changes || now >= look_again_) {
      seen_ = changes;
      look_again_ = now + std::chrono::seconds(2);
      for (const JobEvent& event : context_.store.events_after(id_, sequence_)) {
        out += event_text(event.type, event.sequence, event.json);
        sequence_ = event.sequence;
        done_ = done_ || event.type == "done";
      }
    }
    if (!out.empty()) next_comment_ = now + comment_every;
    if (out.empty() && now >= next_comment_) {
      out = ": still here\n\n";
      next_comment_ = now + comment_every;
    }
    return out;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds comment_every{15};

  Context& context_;
  std::string id_;
  std::int64_t sequence_;
  std::optional<std::uint64_t> seen_;
  Clock::time_point look_again_, next_comment_;
  bool done_ = false;
};

/// The sequence number after which a reconnecting client wants to go on; nothing for a new one.
std::optional<std::int64_t> last_event_id(const http::Request& request) {
  const std::string_view text = request.header("Last-Event-ID");
  std::int64_t sequence = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), sequence);
  if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size() || sequence < 0)
    return {};
  return sequence;
}

/// Fit for a tag: letters, digits and few others.
std::string tag_text(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '_';
  return text;
}

/// Kept results never change, so a job's id and the form name the bytes.
std::string entity_tag(const Job& job, const Wanted& wanted) {
  return "\"" + job.id + "-" + std::string(name_of(wanted.format)) +
         (wanted.picture.is_null() ? "" : "-" + tag_text(wanted.picture.dump())) + "-" +
         std::string(version()) + "\"";
}

http::Response kept_result(Context& context, const Job& job, const Wanted& wanted,
                           const http::Request& request) {
  http::Response response = result_response(context, job, wanted, request.id);
  if (response.status != 200) return response;
  response.set("ETag", entity_tag(job, wanted)).set("Cache-Control", "private").set("Vary", "Accept");
  return http::apply_range(request, http::apply_conditions(request, std::move(response)));
}

/// The picture of a kept result, once there is a place to draw it.
class PictureAnswer final : public http::Pending {
 public:
  PictureAnswer(Context& context, Job job, Wanted wanted, http::Request request)
      : context_(context), job_(std::move(job)), wanted_(std::move(wanted)), request_(std::move(request)) {}

  bool ready() override {
    if (!place_) place_ = DrawingPlace::take(context_);
    return place_ != nullptr || context_.draining;
  }
  http::Response finish() override { return kept_result(context_, job_, wanted_, request_); }

 private:
  Context& context_;
  Job job_;
  Wanted wanted_;
  http::Request request_;
  std::unique_ptr<DrawingPlace> place_;
};

bool read_purge(const http::Request& request) {
  for (const auto& [name, value] : request.query)
    if (name != "purge")
      throw Error(ErrorCode::invalid_parameters, "unknown parameter; known here is: purge",
                  pointer_token(name));
  const std::string purge = query_value(request, "purge");
  if (purge.empty() || purge == "false") return false;
  if (purge == "true") return true;
  throw Error(ErrorCode::invalid_parameters, "purge must be true or false", "/purge");
}

}  // namespace

http::Response list_jobs(Context& context, const http::Request& request) {
  const JobFilter filter = read_filter(request);
  const std::vector<Job> jobs = context.store.list(filter);
  std::string text = "{\"jobs\":[";
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    std::string job = job_to_json(jobs[k]);
    job.pop_back();
    text += (k == 0 ? "" : ",") + job;
  }
  http::Response response = json_response(text + "]}\n");
  if (static_cast<int>(jobs.size()) == filter.limit)
    response.set("Link", "<" + next_page(filter, jobs.back().id) + ">; rel=\"next\"");
  return response;
}

http::Response get_job(Context& context, const http::Request& request) {
  const Job job = find_job(context, request.parameter("id"));
  const Preference preference = read_preference(request);
  if (!preference.wait_seconds || is_terminal(job.status)) return json_response(job_to_json(job));
  http::Response response;
  response.pending = std::make_unique<StatusWait>(context, job.id, preference.wait_seconds);
  return response;
}

http::Response get_result(Context& context, const http::Request& request) {
  const Job job = find_job(context, request.parameter("id"));
  if (!is_terminal(job.status))
    throw Error(ErrorCode::result_not_ready, "the job is " + std::string(to_string(job.status)) +
                                                 "; ask again later, or wait with GET /v1/jobs/" + job.id +
                                                 " and Prefer: wait=20");
  for (const auto& [name, value] : request.query)
    if (name != "format" && !is_picture_parameter(name))
      throw Error(ErrorCode::invalid_parameters,
                  "unknown parameter; known here are: format, picture, picture.NAME", pointer_token(name));
  Wanted wanted = read_wanted(request, job.operation);
  if (!is_picture(wanted.format)) return kept_result(context, job, wanted, request);
  if (const auto place = DrawingPlace::take(context)) return kept_result(context, job, wanted, request);
  http::Response response;
  response.pending = std::make_unique<PictureAnswer>(context, job, std::move(wanted), request);
  return response;
}

http::Response get_events(Context& context, const http::Request& request) {
  const Job job = find_job(context, request.parameter("id"));
  const auto events = context.store.events_after(job.id, 0);
  const std::int64_t newest = events.empty() ? 0 : events.back().sequence;
  const auto last_seen = last_event_id(request);
  http::Response response;
  if (last_seen && is_terminal(job.status) && *last_seen >= newest) {
    response.status = 204;
    return response;
  }
  response.body = "retry: 2000\n\n";
  std::int64_t after = last_seen.value_or(newest);
  if (!last_seen) {
    std::string state = job_to_json(job);
    // A finished job's last event is still to be sent, so that every stream ends with `done`.
    if (is_terminal(job.status) && newest > 0) after = newest - 1;
    response.body += event_text("status", after, state);
  }
  response.events = std::make_unique<JobEvents>(context, job.id, after);
  return response;
}

http::Response delete_job(Context& context, const http::Request& request) {
  const std::string& id = request.parameter("id");
  const bool purge = read_purge(request);
  switch (context.pool->cancel(id)) {
    case CancelOutcome::requested:
      return json_response(job_to_json(find_job(context, id)));
    case CancelOutcome::already_over:
      if (!purge) throw Error(ErrorCode::conflict, "the job is over; to delete its result, say ?purge=true");
      context.store.purge(id);
      break;
    case CancelOutcome::unknown:
      find_job(context, id);
  }
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace wellspaced
