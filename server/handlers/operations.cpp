#include "server/handlers/operations.h"

#include <set>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "proto/execute.h"
#include "proto/picture.h"
#include "server/handlers/answer.h"
#include "server/handlers/drawing_place.h"
#include "server/handlers/waiting.h"
#include "server/problem.h"

namespace wellspaced {
namespace {

using nlohmann::json;

/// All but the format, which only concerns the answer.
Query request_query(const http::Request& request) {
  Query query;
  for (const auto& parameter : request.query)
    if (parameter.first != "format") query.push_back(parameter);
  return query;
}

/// What the store has; notes what was asked for, if somebody wants to know.
struct Needs {
  std::string job;
  std::set<std::string> domains;
};

References references_of(Context& context, const std::string& owner, Needs* needs = nullptr) {
  References references;
  references.domain = [&context, owner, needs](const std::string& id) {
    if (needs != nullptr) needs->domains.insert(id);
    return context.domains.get(owner, id);
  };
  references.job_points = [&context, needs, find = references.domain](const std::string& id) {
    if (needs != nullptr) needs->job = id;
    return only_points(load_result(context.store.result(id), find));
  };
  return references;
}

void require_sync(const Request& request, const Limits& limits) {
  const double seconds = expected_cost(request).seconds;
  if (seconds <= limits.sync_seconds) return;
  throw Error(ErrorCode::too_large_for_sync,
              "this may take about " + std::to_string(static_cast<int>(seconds)) + " s, more than the " +
                  std::to_string(static_cast<int>(limits.sync_seconds)) +
                  " s that a synchronous answer may; send the header Prefer: respond-async and fetch the "
                  "result later",
              size_field(request));
}

JobSpec make_spec(const std::string& operation, const http::Request& request, const Query& query,
                  const Needs& needs, bool attached) {
  JobSpec spec;
  spec.operation = operation;
  spec.content_type = request.header("Content-Type");
  spec.query = json(query).dump();
  spec.owner = owner_of(request);
  spec.needs = needs.job;
  spec.domains.assign(needs.domains.begin(), needs.domains.end());
  spec.request = request.body;
  spec.trace = request.header("traceparent");
  spec.attached = attached;
  return spec;
}

/// The answer once the job is over, or 202 when the client's patience is.
class JobAnswer final : public JobWait {
 public:
  JobAnswer(Context& context, std::string id, std::string request_id, Wanted wanted,
            std::optional<int> wait_seconds, bool attached)
      : JobWait(context, std::move(id), wait_seconds),
        request_id_(std::move(request_id)),
        wanted_(std::move(wanted)),
        attached_(attached) {}

  /// A picture also waits for its place; the answer of a server that stops needs none.
  bool ready() override {
    if (!JobWait::ready()) return false;
    if (!is_picture(wanted_.format) || place_ || context_.draining) return true;
    place_ = DrawingPlace::take(context_);
    return place_ != nullptr;
  }

  http::Response finish() override {
    const Job job = find();
    if (!is_terminal(job.status)) return accepted_response(job);
    http::Response response = result_response(context_, job, wanted_, request_id_);
    return std::move(response.set("Cache-Control", "no-store").set("Vary", "Prefer, Accept"));
  }

  void abandon() override {
    if (attached_) context_.pool->cancel(id_);
  }

 private:
  std::string request_id_;
  Wanted wanted_;
  bool attached_;
  std::unique_ptr<DrawingPlace> place_;
};

}  // namespace

http::Response post_operation(Context& context, const std::string& operation,
                              const http::Request& http_request) {
  if (context.draining)
    throw Error(ErrorCode::draining,
                "the server is stopping and takes no new work; send the request again in a moment");
  try {
    Wanted wanted = read_wanted(http_request, operation);
    const Preference preference = read_preference(http_request);
    const Query query = request_query(http_request);
    const RawRequest raw =
        raw_request(operation, http_request.header("Content-Type"), http_request.body, query);
    Needs needs;
    const Request request =
        read_request(raw, context.config.limits, references_of(context, owner_of(http_request), &needs));
    wanted.picture = nullptr;  // the request holds it
    if (is_picture(wanted.format)) {
      PictureCall call = read_picture(request.picture, "/picture");
      call.format = wanted.format;
      require_drawable(request, call, context.config.limits);
    }
    if (!preference.respond_async) require_sync(request, context.config.limits);

    const bool attached = !preference.respond_async;
    const Job job = context.store.submit(make_spec(operation, http_request, query, needs, attached));
    context.metrics.count_submitted(operation);
    context.pool->notify();
    if (preference.respond_async && !preference.wait_seconds) return accepted_response(job);
    http::Response response;
    response.pending =
        std::make_unique<JobAnswer>(context, job.id, http_request.id, std::move(wanted),
                                    attached ? std::nullopt : preference.wait_seconds, attached);
    return response;
  } catch (const Error& error) {
    context.metrics.count_rejected(to_problem(error).type);
    throw;
  }
}

std::string run_job(Context& context, const Claim& claim, Control& control) {
  const Query query = json::parse(claim.spec.query).get<Query>();
  const RawRequest raw =
      raw_request(claim.spec.operation, claim.spec.content_type, claim.spec.request, query);
  const Result result =
      execute(read_request(raw, context.config.limits, references_of(context, claim.spec.owner)), control);
  context.metrics.count_points(makes_points(result.operation) ? result.points().size() : 0);
  return store_result(result);
}

}  // namespace wellspaced
