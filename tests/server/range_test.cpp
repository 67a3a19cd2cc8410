#include "server/http/range.h"

#include <gtest/gtest.h>

namespace wellspaced::http {
namespace {

Request with(const std::vector<std::pair<std::string, std::string>>& headers,
             const std::string& method = "GET") {
  Request request;
  request.method = method;
  for (const auto& [name, value] : headers) request.headers.emplace(name, value);
  return request;
}

Response full() {
  Response response;
  response.set("ETag", "\"v1\"").set("Content-Type", "text/plain");
  response.body = "0123456789";
  return response;
}

std::string header(const Response& response, const std::string& name) {
  for (const auto& [key, value] : response.headers)
    if (key == name) return value;
  return {};
}

Response ranged(const std::string& range) { return apply_range(with({{"Range", range}}), full()); }

struct Part {
  const char *range, *body, *content_range;
};

TEST(Range, OneSatisfiableRangeIs206) {
  for (const Part& part :
       {Part{"bytes=0-0", "0", "bytes 0-0/10"}, Part{"bytes=2-4", "234", "bytes 2-4/10"},
        Part{"bytes=7-", "789", "bytes 7-9/10"}, Part{"bytes=-3", "789", "bytes 7-9/10"},
        Part{"bytes=-99", "0123456789", "bytes 0-9/10"}, Part{"Bytes=8-99", "89", "bytes 8-9/10"},
        Part{"bytes=0-99999999999999999999999", "0123456789", "bytes 0-9/10"}}) {
    const Response response = ranged(part.range);
    EXPECT_EQ(response.status, 206) << part.range;
    EXPECT_EQ(response.body, part.body) << part.range;
    EXPECT_EQ(header(response, "Content-Range"), part.content_range);
    EXPECT_EQ(header(response, "ETag"), "\"v1\"");
    EXPECT_EQ(header(response, "Accept-Ranges"), "bytes");
  }
}

TEST(Range, ARangeOutsideIs416WithTheSize) {
  for (const char* range : {"bytes=10-", "bytes=10-20", "bytes=-0", "bytes=99999999999999999999999-"}) {
    const Response response = ranged(range);
    EXPECT_EQ(response.status, 416) << range;
    EXPECT_EQ(header(response, "Content-Range"), "bytes */10");
    EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
  }
  Response empty = full();
  empty.body.clear();
  EXPECT_EQ(apply_range(with({{"Range", "bytes=0-"}}), std::move(empty)).status, 416);
}

TEST(Range, WhatIsNoSingleByteRangeIsIgnored) {
  for (const char* range : {"bytes=0-1,3-4", "bytes=-", "bytes=", "bytes", "lines=0-1", "bytes=4-2",
                            "bytes=a-b", "bytes=0x1-2", "bytes=+1-2", "bytes=1-2-3", "bytes=1 - 2", ""}) {
    const Response response = ranged(range);
    EXPECT_EQ(response.status, 200) << range;
    EXPECT_EQ(response.body, "0123456789") << range;
  }
  EXPECT_EQ(apply_range(with({{"Range", "bytes=0-1"}, {"Range", "bytes=2-3"}}), full()).status, 200);
}

TEST(Range, IfRangeNeedsTheSameStrongTag) {
  const auto status = [](const std::string& condition) {
    return apply_range(with({{"Range", "bytes=0-1"}, {"If-Range", condition}}), full()).status;
  };
  EXPECT_EQ(status("\"v1\""), 206);
  EXPECT_EQ(status("\"v2\""), 200);
  EXPECT_EQ(status("W/\"v1\""), 200);
  EXPECT_EQ(status("Wed, 21 Oct 2015 07:28:00 GMT"), 200);
  EXPECT_EQ(status(""), 200);
}

TEST(Range, OnlyACompleteGetIsCut) {
  const auto range = std::pair<std::string, std::string>{"Range", "bytes=0-1"};
  EXPECT_EQ(apply_range(with({range}, "POST"), full()).status, 200);
  EXPECT_EQ(apply_range(with({range}, "HEAD"), full()).body.size(), 10u);
  EXPECT_EQ(header(apply_range(with({range}, "HEAD"), full()), "Accept-Ranges"), "bytes");
  Response missing = full();
  missing.status = 404;
  EXPECT_EQ(apply_range(with({range}), std::move(missing)).status, 404);
}

TEST(Conditions, AKnownTagIs304WithoutABody) {
  for (const char* tags : {"\"v1\"", "W/\"v1\"", "\"a\", \"v1\"", "\"a\",W/\"v1\" , \"b\"", "*"}) {
    const Response response = apply_conditions(with({{"If-None-Match", tags}}), full());
    EXPECT_EQ(response.status, 304) << tags;
    EXPECT_TRUE(response.body.empty());
    EXPECT_EQ(header(response, "ETag"), "\"v1\"");
  }
}

TEST(Conditions, OtherTagsLeaveTheResponse) {
  for (const char* tags : {"\"v2\"", "v1", "\"v1", "\"a,\"v1", "", ","})
    EXPECT_EQ(apply_conditions(with({{"If-None-Match", tags}}), full()).status, 200) << tags;
  EXPECT_EQ(apply_conditions(with({}), full()).status, 200);
  EXPECT_EQ(apply_conditions(with({{"If-None-Match", "*"}}, "POST"), full()).status, 200);
}

TEST(Conditions, A304IsNotCut) {
  const Request request = with({{"If-None-Match", "\"v1\""}, {"Range", "bytes=0-1"}});
  EXPECT_EQ(apply_range(request, apply_conditions(request, full())).status, 304);
}

}  // namespace
}  // namespace wellspaced::http
