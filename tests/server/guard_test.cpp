// What a well-behaved client sees. Hostile ones are in guard_hostile_test.cpp, streams in
// guard_stream_test.cpp, responses that wait in guard_pending_test.cpp.
#include "server/http/guard.h"

#include <atomic>
#include <filesystem>
#include <latch>
#include <mutex>

#include <gmock/gmock.h>

#include "core/error.h"
#include "tests/server/raw_client.h"

namespace wellspaced::http {
namespace {

using test::echo;
using test::eventually;
using test::RawClient;
using test::RawResponse;
using test::Served;

std::string get(const std::string& target) { return "GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n"; }
std::string post(const std::string& body, const std::string& more = "") {
  return "POST /p HTTP/1.1\r\nHost: x\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + more +
         "\r\n" + body;
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator entries("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}
std::size_t running_threads() {
  const std::filesystem::directory_iterator entries("/proc/self/task");
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

TEST(Guard, AnswersAGet) {
  Served server(echo);
  const RawResponse response = RawClient(server.port()).get("/a%20b?c=d");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body, "GET /a%20b?c=d ");
  EXPECT_EQ(response.header("Content-Type"), "text/plain");
  EXPECT_FALSE(response.header("X-Request-Id").empty());
  EXPECT_FALSE(response.header("Date").empty());
  EXPECT_FALSE(response.has("Connection"));
}

TEST(Guard, HandsTheWholeRequestToTheHandler) {
  Request seen;
  Served server([&](const Request& request) {
    seen = request;
    return Response{};
  });
  RawClient(server.port())
      .ask(
          "PUT /a%2Fb/c?x=%31 HTTP/1.1\r\nHost: h\r\nX-Request-Id: my.id-1\r\nREMOTE_ADDR: 6.6.6.6\r\n"
          "X-Percent: 100%25\r\nContent-Length: 3\r\n\r\nabc");
  EXPECT_EQ(seen.method, "PUT");
  EXPECT_EQ(seen.segments, (std::vector<std::string>{"a/b", "c"}));
  EXPECT_EQ(seen.query, (std::vector<std::pair<std::string, std::string>>{{"x", "1"}}));
  EXPECT_EQ(seen.body, "abc");
  EXPECT_EQ(seen.id, "my.id-1");
  EXPECT_EQ(seen.header("X-Percent"), "100%25");
  EXPECT_EQ(seen.header("REMOTE_ADDR"), "");
}

TEST(Guard, KeepsAConnectionForAsManyRequestsAsWanted) {
  Served server(echo);
  RawClient client(server.port());
  for (int i = 0; i < 2000; ++i)
    ASSERT_EQ(client.get("/" + std::to_string(i)).body, "GET /" + std::to_string(i) + " ");
}

TEST(Guard, AnswersPipelinedRequestsInOrder) {
  Served server(echo);
  RawClient client(server.port());
  std::string burst;
  for (int i = 0; i < 500; ++i) burst += i % 2 == 0 ? get("/" + std::to_string(i)) : post(std::to_string(i));
  std::thread writer([&] { client.say(burst); });
  for (int i = 0; i < 500; ++i) {
    const std::string n = std::to_string(i);
    EXPECT_EQ(client.response().body, i % 2 == 0 ? "GET /" + n + " " : "POST /p " + n);
  }
  writer.join();
}

TEST(Guard, HowTheBytesArriveMakesNoDifference) {
  Served server(echo);
  RawClient client(server.port());
  for (const char c : post("hello")) ASSERT_TRUE(client.say({&c, 1}));
  EXPECT_EQ(client.response().body, "POST /p hello");
}

TEST(Guard, AnEmptyLineBeforeARequestIsForgiven) {
  Served server(echo);
  EXPECT_EQ(RawClient(server.port()).ask("\r\n" + get("/")).status, 200);
}

TEST(Guard, ClosesWhenAskedTo) {
  Served server(echo);
  for (const char* request :
       {"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", "GET / HTTP/1.0\r\n\r\n"}) {
    RawClient client(server.port());
    const RawResponse response = client.ask(request);
    EXPECT_EQ(response.header("Connection"), "close");
    EXPECT_TRUE(client.closed_by_peer());
  }
}

TEST(Guard, KeepsAnHttp10ConnectionOnlyOnRequest) {
  Served server(echo);
  RawClient client(server.port());
  const std::string request = "GET / HTTP/1.0\r\nConnection: keep-alive\r\n\r\n";
  EXPECT_EQ(client.ask(request).header("Connection"), "keep-alive");
  EXPECT_EQ(client.ask(request).status, 200);
}

TEST(Guard, AnswersAClientThatHasFinishedSending) {
  Served server(echo);
  RawClient client(server.port());
  client.say(get("/"));
  client.finish_sending();
  EXPECT_EQ(client.response().status, 200);
  EXPECT_TRUE(client.closed_by_peer());
}

TEST(Guard, HeadIsGetWithoutTheBody) {
  Served server(echo);
  RawClient client(server.port());
  const RawResponse head = client.ask("HEAD /abc HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.header("Content-Length"), std::to_string(std::string("HEAD /abc ").size()));
  EXPECT_FALSE(head.has("Accept-Ranges"));
  EXPECT_EQ(client.get("/after").body, "GET /after ");
}

TEST(Guard, BodilessStatusesHaveNoLengthAndNoBody) {
  Served server([](const Request& request) {
    Response response;
    response.status = request.path == "/204" ? 204 : 304;
    response.body = "must not be sent";
    return response;
  });
  RawClient client(server.port());
  for (const int status : {204, 304}) {
    const RawResponse response = client.get("/" + std::to_string(status));
    EXPECT_EQ(response.status, status);
    EXPECT_FALSE(response.has("Content-Length"));
  }
}

TEST(Guard, AnswersExpectBeforeTheBody) {
  Served server(echo);
  RawClient client(server.port());
  const std::string whole = post("hello", "Expect: 100-continue\r\n");
  client.say(whole.substr(0, whole.size() - 5));
  EXPECT_EQ(client.response().status, 100);
  client.say("hello");
  EXPECT_EQ(client.response().body, "POST /p hello");
}

TEST(Guard, PostWithoutALengthHasAnEmptyBody) {
  Served server(echo);
  EXPECT_EQ(RawClient(server.port()).ask("POST /p HTTP/1.1\r\nHost: x\r\n\r\n").body, "POST /p ");
}

TEST(Guard, LargeBodiesGoInAndOutWhole) {
  Served server(echo);
  std::string body(20u << 20, 'x');
  for (std::size_t i = 0; i < body.size(); i += 997) body[i] = static_cast<char>('a' + i % 26);
  RawClient client(server.port());
  EXPECT_TRUE(client.ask(post(body)).body == "POST /p " + body);
  EXPECT_EQ(client.get("/next").body, "GET /next ");
}

TEST(Guard, HandlersErrorsBecomeTheirProblems) {
  Served server([](const Request&) -> Response {
    throw Error(ErrorCode::invalid_parameters, "beta must be above 0", "/beta");
  });
  RawClient client(server.port());
  const RawResponse response = client.get("/");
  EXPECT_EQ(response.status, 422);
  EXPECT_EQ(response.header("Content-Type"), "application/problem+json");
  EXPECT_THAT(response.body, testing::HasSubstr("\"pointer\":\"/beta\""));
  EXPECT_EQ(client.get("/").status, 422);
}

TEST(Guard, OtherExceptionsTellOnlyTheRequestId) {
  Served server([](const Request& request) -> Response {
    if (request.path == "/int") throw 42;
    throw std::runtime_error("secret");
  });
  RawClient client(server.port());
  for (const char* path : {"/", "/int"}) {
    const RawResponse response = client.get(path);
    EXPECT_EQ(response.status, 500);
    EXPECT_THAT(response.head + response.body, testing::Not(testing::HasSubstr("secret")));
    EXPECT_THAT(response.body, testing::HasSubstr(response.header("X-Request-Id")));
  }
}

TEST(Guard, StrangeRequestIdsAreReplaced) {
  Served server([](const Request& request) {
    Response response;
    response.body = request.id;
    return response;
  });
  RawClient client(server.port());
  const auto id = [&](const std::string& offered) {
    return client.ask("GET / HTTP/1.1\r\nHost: x\r\nX-Request-Id: " + offered + "\r\n\r\n").body;
  };
  EXPECT_EQ(id("abc-1"), "abc-1");
  for (const std::string& bad : {std::string("a b"), std::string("\"x"), std::string(65, 'a')})
    EXPECT_NE(id(bad), bad);
  EXPECT_NE(id(""), id(""));
}

TEST(Guard, HandlersCanNotBreakTheFraming) {
  Served server([](const Request&) {
    Response response;
    response.set("Content-Length", "1")
        .set("Connection", "close")
        .set("X-A", "b\r\nX-Evil: c")
        .set("X-B", "%41");
    response.body = "whole";
    return response;
  });
  RawClient client(server.port());
  const RawResponse response = client.get("/");
  EXPECT_EQ(response.body, "whole");
  EXPECT_FALSE(response.has("X-Evil"));
  EXPECT_EQ(response.header("X-B"), "%41");
  EXPECT_EQ(client.get("/").status, 200);
}

TEST(Guard, ResponsesAreNeverCompressed) {
  Served server(echo);
  const RawResponse response =
      RawClient(server.port())
          .ask("GET / HTTP/1.1\r\nHost: x\r\nAccept-Encoding: gzip, br\r\nRange: bytes=0-0\r\n\r\n");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body, "GET / ");
  EXPECT_FALSE(response.has("Content-Encoding"));
}

TEST(Guard, ReportsEveryExchange) {
  std::mutex mutex;
  std::vector<Exchange> seen;
  const auto handler = [](const Request&) {
    Response response;
    response.status = 201;
    response.route = "/things/{id}";
    response.body = "12345";
    return response;
  };
  const auto note = [&](const Exchange& exchange) {
    const std::lock_guard lock(mutex);
    seen.push_back(exchange);
  };
  {
    Served server(GuardOptions{}, handler, note);
    RawClient(server.port())
        .ask(
            "POST /things/7 HTTP/1.1\r\nHost: x\r\nX-Request-Id: id-7\r\ntraceparent: 00-ab\r\n"
            "Content-Length: 3\r\n\r\nabc");
    const auto reported = [&] {
      const std::lock_guard lock(mutex);
      return !seen.empty();
    };
    ASSERT_TRUE(eventually(reported));  // a response may be read before its exchange is reported
    RawClient(server.port()).ask("GET / HTTP/1.1\r\n\r\n");
  }
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].status, 201);
  EXPECT_EQ(seen[0].route, "/things/{id}");
  EXPECT_EQ(seen[0].target, "/things/7");
  EXPECT_EQ(seen[0].id, "id-7");
  EXPECT_EQ(seen[0].trace_parent, "00-ab");
  EXPECT_GT(seen[0].bytes_in, 50u);
  EXPECT_GT(seen[0].bytes_out, 50u);
  EXPECT_GE(seen[0].seconds, 0);
  EXPECT_EQ(seen[1].status, 400);
}

TEST(Guard, IdleConnectionsNeedNoThread) {
  GuardOptions options;
  options.threads = 1;
  Served server(options, echo);
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 300; ++i) {
    clients.push_back(std::make_unique<RawClient>(server.port()));
    ASSERT_EQ(clients.back()->get("/").status, 200);
  }
  for (const auto& client : clients) ASSERT_EQ(client->get("/again").body, "GET /again ");
}

TEST(Guard, ReservedPathsAreAnsweredWhenEveryThreadIsBusy) {
  std::latch entered(2), leave(1);
  GuardOptions options;
  options.threads = 2;
  options.reserved_paths = {"/livez"};
  Served server(options, [&](const Request& request) {
    if (request.path == "/livez") return echo(request);
    entered.count_down();
    leave.wait();
    return Response{};
  });
  RawClient first(server.port()), second(server.port());
  first.say(get("/"));
  second.say(get("/"));
  entered.wait();
  EXPECT_EQ(RawClient(server.port()).get("/livez?verbose").status, 200);
  leave.count_down();
  EXPECT_EQ(first.response().status, 200);
  EXPECT_EQ(second.response().status, 200);
}

TEST(Guard, SlowReadersKeepNoThreadBusy) {
  GuardOptions options;
  options.threads = 1;
  Served server(options, [](const Request& request) {
    Response response;
    response.body.assign(request.path == "/big" ? 16u << 20 : 2, 'x');
    return response;
  });
  std::vector<std::unique_ptr<RawClient>> slow;
  for (int i = 0; i < 8; ++i) {
    slow.push_back(std::make_unique<RawClient>(server.port(), 4096));
    slow.back()->say(get("/big"));
  }
  EXPECT_EQ(RawClient(server.port()).get("/small").body, "xx");
  EXPECT_EQ(slow.front()->response().body.size(), 16u << 20);
}

TEST(Guard, ASecondServerOnThePortIsAClearError) {
  Served server(echo);
  GuardOptions options;
  options.port = server.port();
  Guard second(options, echo);
  try {
    second.listen();
    FAIL() << "two servers share a port";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("127.0.0.1"), testing::HasSubstr("in use"),
                                             testing::HasSubstr(std::to_string(server.port()))));
  }
}

TEST(Guard, ListensOnNamesAndIpv6) {
  for (const char* host : {"localhost", "::1", "[::1]", "*", ""}) {
    if (std::string(host).find("::1") != std::string::npos && !std::filesystem::exists("/proc/net/if_inet6"))
      continue;
    GuardOptions options;
    options.host = host;
    options.port = 0;
    Guard guard(options, echo);
    EXPECT_NO_THROW(guard.listen()) << host;
    EXPECT_GT(guard.port(), 0) << host;
  }
  GuardOptions options;
  options.host = "256.1.2.3.invalid";
  Guard guard(options, echo);
  EXPECT_THROW(guard.listen(), Error);
}

TEST(Guard, StopLetsRunningHandlersFinish) {
  std::latch entered(1), leave(1);
  Served server([&](const Request&) {
    entered.count_down();
    leave.wait();
    Response response;
    response.body = "done";
    return response;
  });
  RawClient client(server.port()), idle(server.port());
  client.say(get("/"));
  entered.wait();
  server.guard().stop();
  EXPECT_TRUE(idle.closed_by_peer());
  leave.count_down();
  EXPECT_EQ(client.response().body, "done");
  EXPECT_TRUE(client.closed_by_peer());
}

TEST(Guard, StopLetsARequestThatIsArrivingFinish) {
  Served server(echo);
  RawClient client(server.port()), idle(server.port());
  EXPECT_EQ(client.get("/first").status, 200);
  EXPECT_EQ(idle.get("/").status, 200);
  const std::string request = post("hello");
  client.say(request.substr(0, 20));
  EXPECT_EQ(RawClient(server.port()).get("/").status, 200);  // by now, the hub has the first bytes too
  server.guard().stop();
  EXPECT_TRUE(idle.closed_by_peer());
  client.say(request.substr(20));
  const RawResponse response = client.response();
  EXPECT_EQ(response.body, "POST /p hello");
  EXPECT_EQ(response.header("Connection"), "close");
}

TEST(Guard, StopAnswersWhatCameWhileAResponseWasOnItsWay) {
  const std::string large(32u << 20, 'x');
  Served server([&](const Request& request) {
    Response response = echo(request);
    if (request.path == "/large") response.body = large;
    return response;
  });
  RawClient client(server.port(), 4096);
  client.say(get("/large"));
  EXPECT_TRUE(client.hear("\r\n\r\n"));  // it is on its way, and promises to go on
  client.say(get("/second"));
  server.guard().stop();
  const RawResponse first = client.response(), second = client.response();
  EXPECT_EQ(first.body.size(), large.size());
  EXPECT_FALSE(first.has("Connection"));
  EXPECT_EQ(second.body, "GET /second ");
  EXPECT_EQ(second.header("Connection"), "close");
  EXPECT_TRUE(client.closed_by_peer());
}

TEST(Guard, StopBeforeServeReturnsAtOnce) {
  GuardOptions options;
  options.port = 0;
  Guard guard(options, echo);
  guard.listen();
  guard.stop();
  guard.serve();
  Guard never_listened(options, echo);
  never_listened.stop();
  never_listened.serve();
}

TEST(Guard, DrainingEndsAtItsLimit) {
  GuardOptions options;
  options.drain_timeout_ms = 100;
  options.header_timeout_ms = 60'000;
  Served server(options, echo);
  RawClient half(server.port());
  EXPECT_EQ(half.get("/").status, 200);
  half.say("GET / HT");
  EXPECT_EQ(RawClient(server.port()).get("/").status, 200);
  const auto begin = std::chrono::steady_clock::now();
  server.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin,
            std::chrono::milliseconds(options.header_timeout_ms) / 2);
}

TEST(Guard, LeavesNoThreadAndNoDescriptorBehind) {
  { Served warm_up(echo); }  // what libraries open once stays open
  const std::size_t descriptors = open_descriptors(), threads = running_threads();
  {
    Served server(echo);
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int i = 0; i < 50; ++i) {
      clients.push_back(std::make_unique<RawClient>(server.port()));
      if (i % 3 == 0) clients.back()->get("/");
      if (i % 3 == 1) clients.back()->say("GET / HT");
      if (i % 5 == 0) clients.back()->close();
    }
    clients.clear();
  }
  EXPECT_EQ(open_descriptors(), descriptors);
  EXPECT_TRUE(eventually([&] { return running_threads() == threads; }));
}

}  // namespace
}  // namespace wellspaced::http
