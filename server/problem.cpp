#include "server/problem.h"

#include <nlohmann/json.hpp>

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

struct Kind {
  int status;
  const char* type;
  const char* title;
  const char* retry_after_s = nullptr;
};

// No default: a new ErrorCode without a line here does not compile (-Wswitch).
Kind kind_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed_request:
      return {400, "malformed-request", "The request can't be read"};
    case ErrorCode::invalid_parameters:
      return {422, "invalid-parameters", "A parameter is not valid"};
    case ErrorCode::infeasible:
      return {422, "infeasible", "No point set has what is asked for"};
    case ErrorCode::degenerate_input:
      return {422, "degenerate-input", "The method can't work on this point set"};
    case ErrorCode::too_large:
      return {422, "too-large", "The work is above a limit of this server"};
    case ErrorCode::payload_too_large:
      return {413, "payload-too-large", "The body is too large"};
    case ErrorCode::unsupported_media_type:
      return {415, "unsupported-media-type", "The body's format is not supported"};
    case ErrorCode::not_acceptable:
      return {406, "not-acceptable", "None of the accepted formats is available"};
    case ErrorCode::not_found:
      return {404, "not-found", "There is nothing here"};
    case ErrorCode::no_such_job:
      return {404, "no-such-job", "There is no such job"};
    case ErrorCode::no_such_domain:
      return {404, "no-such-domain", "There is no such domain"};
    case ErrorCode::result_not_ready:
      return {404, "result-not-ready", "The job has no result yet", "1"};
    case ErrorCode::result_expired:
      return {410, "result-expired", "The result is no longer kept"};
    case ErrorCode::conflict:
      return {409, "conflict", "The resource's state forbids this"};
    case ErrorCode::too_large_for_sync:
      return {422, "too-large-for-sync", "The work takes too long for a synchronous answer"};
    case ErrorCode::too_many_jobs:
      return {429, "too-many-jobs", "Too many live jobs", "5"};
    case ErrorCode::overloaded:
      return {503, "overloaded", "The server is overloaded", "2"};
    case ErrorCode::draining:
      return {503, "draining", "The server is shutting down", "5"};
    case ErrorCode::storage_unavailable:
      return {503, "storage-unavailable", "The job store is not available", "5"};
    case ErrorCode::storage_full:
      return {507, "storage-full", "The job store is full"};
    case ErrorCode::deadline_exceeded:
      return {504, "deadline-exceeded", "The time limit has passed"};
    case ErrorCode::cancelled:
      return {409, "cancelled", "The work was cancelled"};
    case ErrorCode::worker_crashed:
      return {500, "worker-crashed", "The workers that ran this job crashed"};
    case ErrorCode::internal:
      return {500, "internal", "Something went wrong in the server"};
  }
  return {500, "internal", "Something went wrong in the server"};
}

constexpr Kind kHttpKinds[] = {
    {400, "malformed-request", "The request can't be read"},
    {401, "unauthorized", "A valid key is needed"},
    {403, "forbidden", "The key doesn't allow this"},
    {404, "not-found", "There is nothing here"},
    {405, "method-not-allowed", "The method is not allowed here"},
    {406, "not-acceptable", "None of the accepted formats is available"},
    {408, "request-timeout", "The request took too long to arrive"},
    {409, "conflict", "The resource's state forbids this"},
    {410, "result-expired", "The result is no longer kept"},
    {411, "length-required", "Content-Length is needed"},
    {413, "payload-too-large", "The body is too large"},
    {414, "target-too-long", "The request target is too long"},
    {415, "unsupported-media-type", "The body's format is not supported"},
    {416, "range-not-satisfiable", "The range lies outside of the content"},
    {417, "expectation-failed", "The expectation is not supported"},
    {422, "invalid-parameters", "A parameter is not valid"},
    {429, "rate-limited", "Too many requests", "1"},
    {431, "header-too-large", "The header block is too large"},
    {500, "internal", "Something went wrong in the server"},
    {501, "not-implemented", "The method is unknown"},
    {503, "overloaded", "The server is overloaded", "2"},
    {504, "deadline-exceeded", "The time limit has passed"},
    {505, "version-not-supported", "The HTTP version is not supported"},
    {507, "storage-full", "The job store is full"},
};

constexpr const char* kInternalDetail =
    "the server failed while working on this request; its log holds the reason under the request id";
constexpr std::string_view kTypePrefix = "/problems/";

Problem problem_of(const Kind& kind, std::string detail) {
  Problem problem;
  problem.status = kind.status;
  problem.type = kind.type;
  problem.title = kind.title;
  problem.detail = std::move(detail);
  if (kind.retry_after_s != nullptr) problem.headers.emplace_back("Retry-After", kind.retry_after_s);
  return problem;
}

std::string text_member(const ordered_json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

Problem to_problem(const Error& error) {
  const bool secret = error.code() == ErrorCode::internal;
  Problem problem = problem_of(kind_of(error.code()), secret ? kInternalDetail : error.what());
  if (!secret && !error.where().empty()) problem.errors.emplace_back(error.where(), error.what());
  return problem;
}

Problem http_problem(int status, std::string detail) {
  for (const Kind& kind : kHttpKinds)
    if (kind.status == status) return problem_of(kind, std::move(detail));
  return to_problem(Error(ErrorCode::internal, "no problem type for this status"));
}

std::string to_json(const Problem& problem, const std::string& request_id) {
  ordered_json json = {{"type", std::string(kTypePrefix) + problem.type},
                       {"title", problem.title},
                       {"status", problem.status},
                       {"detail", problem.detail}};
  if (!problem.errors.empty()) {
    ordered_json& errors = json["errors"] = ordered_json::array();
    for (const auto& [pointer, detail] : problem.errors)
      errors.push_back({{"pointer", pointer}, {"detail", detail}});
  }
  json["request_id"] = request_id;
  // Details may quote bytes of the request; replacing invalid UTF-8 keeps dump from throwing.
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Problem problem_from_json(const std::string& text) {
  Problem problem;
  const ordered_json json = ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) return problem;
  problem.type = text_member(json, "type");
  if (problem.type.starts_with(kTypePrefix)) problem.type.erase(0, kTypePrefix.size());
  problem.title = text_member(json, "title");
  problem.detail = text_member(json, "detail");
  if (const auto status = json.find("status"); status != json.end() && status->is_number_integer())
    problem.status = status->get<int>();
  if (const auto errors = json.find("errors"); errors != json.end() && errors->is_array())
    for (const ordered_json& entry : *errors)
      if (entry.is_object())
        problem.errors.emplace_back(text_member(entry, "pointer"), text_member(entry, "detail"));
  return problem;
}

http::Response to_response(const Problem& problem, const std::string& request_id) {
  http::Response response;
  response.status = problem.status;
  response.set("Content-Type", "application/problem+json").set("Cache-Control", "no-store");
  for (const auto& [name, value] : problem.headers) response.set(name, value);
  response.body = to_json(problem, request_id);
  return response;
}

}  // namespace wellspaced
