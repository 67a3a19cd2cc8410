#include "server/problem.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace wellspaced {
namespace {

using nlohmann::json;

std::string header(const std::vector<std::pair<std::string, std::string>>& headers, const std::string& name) {
  for (const auto& [key, value] : headers)
    if (key == name) return value;
  return {};
}

struct Row {
  ErrorCode code;
  int status;
  const char* type;
  bool retry;
};

const Row kRows[] = {
    {ErrorCode::malformed_request, 400, "malformed-request", false},
    {ErrorCode::invalid_parameters, 422, "invalid-parameters", false},
    {ErrorCode::infeasible, 422, "infeasible", false},
    {ErrorCode::degenerate_input, 422, "degenerate-input", false},
    {ErrorCode::too_large, 422, "too-large", false},
    {ErrorCode::payload_too_large, 413, "payload-too-large", false},
    {ErrorCode::unsupported_media_type, 415, "unsupported-media-type", false},
    {ErrorCode::not_acceptable, 406, "not-acceptable", false},
    {ErrorCode::not_found, 404, "not-found", false},
    {ErrorCode::no_such_job, 404, "no-such-job", false},
    {ErrorCode::result_not_ready, 404, "result-not-ready", true},
    {ErrorCode::result_expired, 410, "result-expired", false},
    {ErrorCode::conflict, 409, "conflict", false},
    {ErrorCode::too_large_for_sync, 422, "too-large-for-sync", false},
    {ErrorCode::too_many_jobs, 429, "too-many-jobs", true},
    {ErrorCode::overloaded, 503, "overloaded", true},
    {ErrorCode::draining, 503, "draining", true},
    {ErrorCode::storage_unavailable, 503, "storage-unavailable", true},
    {ErrorCode::storage_full, 507, "storage-full", false},
    {ErrorCode::deadline_exceeded, 504, "deadline-exceeded", false},
    {ErrorCode::cancelled, 409, "cancelled", false},
    {ErrorCode::worker_crashed, 500, "worker-crashed", false},
    {ErrorCode::internal, 500, "internal", false},
};

TEST(Problem, EveryErrorCodeHasItsStatusAndType) {
  for (const Row& row : kRows) {
    const Problem problem = to_problem(Error(row.code, "the detail"));
    EXPECT_EQ(problem.status, row.status) << row.type;
    EXPECT_EQ(problem.type, row.type);
    EXPECT_FALSE(problem.title.empty()) << row.type;
    EXPECT_EQ(!header(problem.headers, "Retry-After").empty(), row.retry) << row.type;
  }
}

TEST(Problem, ResultNotReadyAsksForAnotherTryInASecond) {
  EXPECT_EQ(header(to_problem(Error(ErrorCode::result_not_ready, "")).headers, "Retry-After"), "1");
}

TEST(Problem, NamesTheOffendingField) {
  const Problem problem = to_problem(Error(ErrorCode::invalid_parameters, "beta must be above 0", "/beta"));
  EXPECT_EQ(problem.detail, "beta must be above 0");
  const std::vector<std::pair<std::string, std::string>> expected = {{"/beta", "beta must be above 0"}};
  EXPECT_EQ(problem.errors, expected);
}

TEST(Problem, InternalErrorsKeepTheirReasonToThemselves) {
  const Problem problem = to_problem(Error(ErrorCode::internal, "secret /etc/path", "/secret"));
  EXPECT_EQ(to_json(problem, "id").find("secret"), std::string::npos);
}

TEST(Problem, DocumentHasTheMembersOfRfc9457) {
  const json document =
      json::parse(to_json(to_problem(Error(ErrorCode::infeasible, "too low", "/beta")), "id-7"));
  const json expected = {{"type", "/problems/infeasible"},
                         {"title", "No point set has what is asked for"},
                         {"status", 422},
                         {"detail", "too low"},
                         {"errors", {{{"pointer", "/beta"}, {"detail", "too low"}}}},
                         {"request_id", "id-7"}};
  EXPECT_EQ(document, expected);
  EXPECT_FALSE(json::parse(to_json(http_problem(404, ""), "")).contains("errors"));
}

TEST(Problem, InvalidUtf8IsReplaced) {
  const std::string text = to_json(http_problem(400, "bad \xff byte"), "id");
  EXPECT_EQ(json::parse(text)["detail"], "bad \xef\xbf\xbd byte");
}

TEST(Problem, StatusDecidesTypeAndTitle) {
  for (const int status : {400, 401, 403, 404, 405, 406, 408, 409, 410, 411, 413, 414,
                           415, 416, 417, 422, 429, 431, 500, 501, 503, 504, 505, 507}) {
    const Problem problem = http_problem(status, "why");
    EXPECT_EQ(problem.status, status);
    EXPECT_EQ(problem.detail, "why");
    EXPECT_EQ(problem.type == "internal", status == 500) << status;
  }
}

TEST(Problem, SurvivesAJob) {
  const Problem before = to_problem(Error(ErrorCode::infeasible, "too low", "/beta"));
  const Problem after = problem_from_json(to_json(before, "id"));
  EXPECT_EQ(after.status, before.status);
  EXPECT_EQ(after.type, before.type);
  EXPECT_EQ(after.title, before.title);
  EXPECT_EQ(after.detail, before.detail);
  EXPECT_EQ(after.errors, before.errors);
}

TEST(Problem, WhatIsMissingOrBrokenKeepsItsDefault) {
  for (const char* text : {"", "{", "[]", "{}", R"({"status":"x","type":7,"errors":{"a":1}})"}) {
    const Problem problem = problem_from_json(text);
    EXPECT_EQ(problem.status, 500) << text;
    EXPECT_TRUE(problem.type.empty()) << text;
    EXPECT_TRUE(problem.errors.empty()) << text;
  }
}

TEST(Problem, ResponseIsNeverCachedAndBringsItsHeaders) {
  const http::Response response = to_response(to_problem(Error(ErrorCode::overloaded, "full")), "id");
  EXPECT_EQ(response.status, 503);
  EXPECT_EQ(header(response.headers, "Content-Type"), "application/problem+json");
  EXPECT_EQ(header(response.headers, "Cache-Control"), "no-store");
  EXPECT_FALSE(header(response.headers, "Retry-After").empty());
}

}  // namespace
}  // namespace wellspaced
