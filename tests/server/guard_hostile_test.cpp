// What clients do that mean no good, or know no better. See service.md, section 4.
#include <atomic>

#include <gmock/gmock.h>

#include "server/http/guard.h"
#include "tests/server/raw_client.h"

namespace wellspaced::http {
namespace {

using test::echo;
using test::eventually;
using test::RawClient;
using test::RawResponse;
using test::Served;
using testing::HasSubstr;

GuardOptions impatient() {
  GuardOptions options;
  options.header_timeout_ms = 300;
  options.body_timeout_ms = 300;
  options.write_timeout_ms = 300;
  options.idle_timeout_ms = 300;
  options.body_limit_bytes = 1000;
  return options;
}

// Refused with a problem document and a close, without the handler ever running, and without a reset.
void expect_refusal(const std::string& bytes, int status) {
  std::atomic<int> handled = 0;
  GuardOptions options;
  options.body_limit_bytes = 1000;
  Served server(options, [&](const Request& request) {
    ++handled;
    return echo(request);
  });
  RawClient client(server.port());
  client.say(bytes);
  const RawResponse response = client.response();
  EXPECT_EQ(response.status, status) << bytes.substr(0, 100);
  EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
  EXPECT_EQ(response.header("Connection"), "close");
  EXPECT_THAT(response.body, HasSubstr("\"request_id\":\"" + response.header("X-Request-Id") + "\""));
  EXPECT_TRUE(client.closed_by_peer());
  EXPECT_EQ(handled, 0);
}

const std::string kPost = "POST / HTTP/1.1\r\nHost: x\r\n";

TEST(GuardRefuses, ChunkedBodies) {
  expect_refusal(kPost + "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n", 411);
}

TEST(GuardRefuses, SmuggledRequests) {
  expect_refusal(
      kPost + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /evil HTTP/1.1\r\n\r\n",
      400);
  expect_refusal(
      "GET / HTTP/1.1\r\nHost: x\r\nContent-Length: 40\r\n\r\nGET /evil HTTP/1.1\r\nHost: x\r\n\r\n", 400);
  expect_refusal(kPost + "Content-Length: 1\r\nContent-Length: 2\r\n\r\nab", 400);
}

TEST(GuardRefuses, HeaderFloods) {
  std::string flood = "GET / HTTP/1.1\r\nHost: x\r\n";
  for (int i = 0; i < 50'000; ++i) flood += "X-Flood: " + std::to_string(i) + "\r\n";
  expect_refusal(flood, 431);
}

TEST(GuardRefuses, EndlessTargets) { expect_refusal("GET /" + std::string(100'000, 'a'), 414); }
TEST(GuardRefuses, CompressedBodies) {
  expect_refusal(kPost + "Content-Encoding: gzip\r\nContent-Length: 3\r\n\r\nabc", 415);
}
TEST(GuardRefuses, OtherExpectations) {
  expect_refusal(kPost + "Expect: cake\r\nContent-Length: 3\r\n\r\n", 417);
}
TEST(GuardRefuses, OtherProtocols) {
  expect_refusal("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 505);
  expect_refusal(std::string("\x16\x03\x01\x02\x00\x01\x00", 7), 400);
  expect_refusal("GET / HTTP/1.1\n\n", 400);
}
TEST(GuardRefuses, EncodedNulInThePath) { expect_refusal("GET /%00 HTTP/1.1\r\nHost: x\r\n\r\n", 400); }
TEST(GuardRefuses, UnknownMethods) { expect_refusal("BREW / HTTP/1.1\r\nHost: x\r\n\r\n", 501); }

TEST(GuardRefuses, LargeBodiesBeforeReadingThem) {
  expect_refusal(kPost + "Content-Length: 1001\r\n\r\n", 413);
  expect_refusal(kPost + "Content-Length: 1001\r\nExpect: 100-continue\r\n\r\n", 413);
}

TEST(GuardRefuses, LargeBodiesWhoseSenderDoesNotListen) {
  // 8 MiB are more than the socket buffers hold: without a lingering close, a reset would eat the answer.
  expect_refusal(kPost + "Content-Length: 8388608\r\n\r\n" + std::string(8u << 20, 'x'), 413);
}

TEST(GuardRefuses, TheRestOfAPipelineAfterABadRequest) {
  std::atomic<int> handled = 0;
  Served server([&](const Request& request) {
    ++handled;
    return echo(request);
  });
  RawClient client(server.port());
  const std::string good = "GET / HTTP/1.1\r\nHost: x\r\n\r\n";
  client.say(good + "GET / HTTP/1.1\r\nHost : x\r\n\r\n" + good);
  EXPECT_EQ(client.response().status, 200);
  EXPECT_EQ(client.response().status, 400);
  EXPECT_TRUE(client.closed_by_peer());
  EXPECT_EQ(handled, 1);
}

TEST(GuardTimeout, ASlowHeaderIs408HoweverSteadilyItDrips) {
  Served server(impatient(), echo);
  RawClient client(server.port());
  client.say("GET / HTTP/1.1\r\nX: ");
  EXPECT_TRUE(eventually([&] {
    client.say("x");
    return client.has_news(std::chrono::milliseconds(5));
  }));
  EXPECT_EQ(client.response().status, 408);
}

TEST(GuardTimeout, AStalledBodyIs408) {
  Served server(impatient(), echo);
  RawClient client(server.port());
  client.say(kPost + "Content-Length: 10\r\n\r\nabc");
  EXPECT_EQ(client.response().status, 408);
  EXPECT_TRUE(client.closed_by_peer());
}

TEST(GuardTimeout, AnIdleConnectionIsClosedWithoutAWord) {
  Served server(impatient(), echo);
  RawClient fresh(server.port()), used(server.port());
  EXPECT_EQ(used.get("/").status, 200);
  EXPECT_TRUE(fresh.closed_by_peer());
  EXPECT_TRUE(used.closed_by_peer());
}

TEST(GuardTimeout, AReaderThatStandsStillIsDropped) {
  std::atomic<int> finished = 0;
  Served server(
      impatient(),
      [](const Request&) {
        Response response;
        response.body.assign(32u << 20, 'x');
        return response;
      },
      [&](const Exchange&) { ++finished; });
  RawClient client(server.port(), 4096);
  client.say("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(eventually([&] { return finished == 1; }));
  EXPECT_LT(client.response().body.size(), 32u << 20);
}

TEST(GuardTimeout, SlowHeadersKeepNobodyWaiting) {
  GuardOptions options;
  options.threads = 1;
  Served server(options, echo);
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 200; ++i) {
    slow.push_back(std::make_unique<RawClient>(server.port()));
    slow.back()->say(i % 2 == 0 ? "GET / HT" : kPost + "Content-Length: 100\r\n\r\nabc");
  }
  EXPECT_EQ(RawClient(server.port()).get("/").status, 200);
}

TEST(GuardLimit, ConnectionsAboveTheLimitGet503) {
  GuardOptions options;
  options.connection_limit = 4;
  Served server(options, echo);
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 4; ++i) {
    clients.push_back(std::make_unique<RawClient>(server.port()));
    EXPECT_EQ(clients.back()->get("/").status, 200);
  }
  RawClient extra(server.port());
  const RawResponse response = extra.get("/");
  EXPECT_EQ(response.status, 503);
  EXPECT_FALSE(response.header("Retry-After").empty());
  clients.pop_back();
  EXPECT_TRUE(eventually([&] { return RawClient(server.port()).get("/").status == 200; }));
}

TEST(GuardLimit, AClientThatVanishesInTheMiddleOfItsResponseHarmsNobody) {
  Served server([](const Request&) {
    Response response;
    response.body.assign(8u << 20, 'x');
    return response;
  });
  for (int i = 0; i < 20; ++i) {
    RawClient client(server.port(), 4096);
    client.say("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    client.hear("HTTP/1.1 200");
  }
  EXPECT_EQ(RawClient(server.port()).get("/").body.size(), 8u << 20);
}

}  // namespace
}  // namespace wellspaced::http
