#include "server/http/router.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "server/http/target.h"

namespace wellspaced::http {
namespace {

Request request(const std::string& method, const std::string& path) {
  Target target = std::get<Target>(parse_target(path));
  Request result;
  result.method = method;
  result.path = target.path;
  result.segments = target.segments;
  result.id = "id-1";
  return result;
}

Response answer(const std::string& body) {
  Response response;
  response.body = body;
  return response;
}

std::string header(const Response& response, const std::string& name) {
  for (const auto& [key, value] : response.headers)
    if (key == name) return value;
  return {};
}

Router make_router() {
  return Router(
      {{"GET", "/", [](const Request&) { return answer("root"); }},
       {"GET", "/v1/jobs", [](const Request&) { return answer("list"); }},
       {"GET", "/v1/jobs/{id}", [](const Request& r) { return answer("get " + r.parameter("id")); }},
       {"DELETE", "/v1/jobs/{id}", [](const Request& r) { return answer("delete " + r.parameter("id")); }},
       {"GET", "/v1/{op}/{id}/raw",
        [](const Request& r) { return answer(r.parameter("op") + '+' + r.parameter("id")); }},
       {"POST", "/v1/generate", [](const Request&) { return answer("generated"); }}});
}

TEST(Router, FindsLiteralsAndParameters) {
  const Router router = make_router();
  EXPECT_EQ(router(request("GET", "/")).body, "root");
  EXPECT_EQ(router(request("GET", "/v1/jobs")).body, "list");
  EXPECT_EQ(router(request("DELETE", "/v1/jobs/7")).body, "delete 7");
  EXPECT_EQ(router(request("GET", "/v1/a/b/raw")).body, "a+b");
}

TEST(Router, AParameterMayHoldAnEncodedSlash) {
  EXPECT_EQ(make_router()(request("GET", "/v1/jobs/a%2Fb")).body, "get a/b");
}

TEST(Router, HeadIsAnsweredByTheGetRoute) {
  EXPECT_EQ(make_router()(request("HEAD", "/v1/jobs/7")).body, "get 7");
}

TEST(Router, TellsThePatternThatMatched) {
  EXPECT_EQ(make_router()(request("GET", "/v1/jobs/7")).route, "/v1/jobs/{id}");
  EXPECT_EQ(make_router()(request("POST", "/v1/jobs/7")).route, "/v1/jobs/{id}");
  EXPECT_EQ(make_router()(request("GET", "/nowhere")).route, "");
}

TEST(Router, UnknownPathsAre404) {
  for (const char* path : {"/v1", "/v1/jobs/", "/v1/jobs/7/x", "/V1/jobs", "//", "/v1//jobs"}) {
    const Response response = make_router()(request("GET", path));
    EXPECT_EQ(response.status, 404) << path;
    EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
    EXPECT_NE(response.body.find("\"request_id\":\"id-1\""), std::string::npos);
  }
}

TEST(Router, KnownPathsWithAnotherMethodAre405WithAllow) {
  const Response response = make_router()(request("POST", "/v1/jobs/7"));
  EXPECT_EQ(response.status, 405);
  EXPECT_EQ(header(response, "Allow"), "GET, HEAD, DELETE, OPTIONS");
  EXPECT_EQ(header(make_router()(request("GET", "/v1/generate")), "Allow"), "POST, OPTIONS");
}

TEST(Router, OptionsNamesTheMethods) {
  const Response response = make_router()(request("OPTIONS", "/v1/jobs/7"));
  EXPECT_EQ(response.status, 204);
  EXPECT_EQ(header(response, "Allow"), "GET, HEAD, DELETE, OPTIONS");
  EXPECT_TRUE(response.body.empty());
  EXPECT_EQ(header(make_router()(request("OPTIONS", "*")), "Allow"), "GET, HEAD, DELETE, POST, OPTIONS");
  EXPECT_EQ(make_router()(request("OPTIONS", "/nowhere")).status, 404);
}

TEST(Router, AParameterThatThePatternLacksIsAnError) {
  EXPECT_THROW(request("GET", "/").parameter("id"), std::logic_error);
}

TEST(Request, HeaderGivesTheFirstValueOfAnyCase) {
  Request r;
  r.headers.emplace("Accept", "a");
  r.headers.emplace("ACCEPT", "b");
  EXPECT_EQ(r.header("accept"), "a");
  EXPECT_EQ(r.header("accep"), "");
}

}  // namespace
}  // namespace wellspaced::http
