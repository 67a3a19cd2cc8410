// Event streams: how they start, live and end.
#include <atomic>
#include <mutex>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "server/http/guard.h"
#include "tests/server/raw_client.h"

namespace wellspaced::http {
namespace {

using test::eventually;
using test::RawClient;
using test::RawResponse;
using test::Served;

/// What all sources of a test share.
struct Feed {
  std::mutex mutex;
  std::string text;   ///< every source sends it once, from its beginning
  bool over = false;  ///< end after the text
  std::atomic<int> alive = 0;

  void add(const std::string& more) {
    const std::lock_guard lock(mutex);
    text += more;
  }
  void end() {
    const std::lock_guard lock(mutex);
    over = true;
  }
};

class FeedSource : public EventSource {
 public:
  explicit FeedSource(Feed& feed) : feed_(feed) { ++feed_.alive; }
  ~FeedSource() override { --feed_.alive; }
  std::optional<std::string> poll() override {
    const std::lock_guard lock(feed_.mutex);
    if (feed_.over && sent_ == feed_.text.size()) return std::nullopt;
    std::string news = feed_.text.substr(sent_);
    sent_ = feed_.text.size();
    return news;
  }

 private:
  Feed& feed_;
  std::size_t sent_ = 0;
};

/// Has more to say at every poll.
class Chatterbox : public EventSource {
 public:
  explicit Chatterbox(std::atomic<int>& alive) : alive_(alive) { ++alive_; }
  ~Chatterbox() override { --alive_; }
  std::optional<std::string> poll() override { return std::string(512u << 10, 'x'); }

 private:
  std::atomic<int>& alive_;
};

class Broken : public EventSource {
 public:
  std::optional<std::string> poll() override { throw std::runtime_error("secret"); }
};

Handler streaming(Feed& feed) {
  return [&feed](const Request& request) {
    Response response;
    if (request.path != "/events") return test::echo(request);
    response.body = "retry: 2000\n\n";
    response.events = std::make_unique<FeedSource>(feed);
    return response;
  };
}

const std::string kAsk = "GET /events HTTP/1.1\r\nHost: x\r\n\r\n";

TEST(EventStream, StartsWithItsHeadersAndItsBody) {
  Feed feed;
  Served server(streaming(feed));
  RawClient client(server.port());
  client.say(kAsk);
  ASSERT_TRUE(client.hear("retry: 2000\n\n"));
  const std::string head = client.received();
  for (const char* line : {"Content-Type: text/event-stream\r\n", "Cache-Control: no-store\r\n",
                           "X-Accel-Buffering: no\r\n", "Connection: close\r\n", "X-Request-Id: "})
    EXPECT_THAT(head, testing::HasSubstr(line));
  EXPECT_THAT(head, testing::Not(testing::HasSubstr("Content-Length")));
}

TEST(EventStream, CarriesWhatTheSourceHasUntilItsEnd) {
  Feed feed;
  Served server(streaming(feed));
  RawClient client(server.port());
  client.say(kAsk);
  ASSERT_TRUE(client.hear("retry"));
  feed.add("data: one\n\n");
  EXPECT_TRUE(client.hear("data: one\n\n"));
  feed.add("data: two\n\n");
  server.guard().wake();
  EXPECT_TRUE(client.hear("data: two\n\n"));
  feed.end();
  EXPECT_THAT(client.response().body, testing::EndsWith("data: two\n\n"));
  EXPECT_TRUE(client.closed_by_peer());
  EXPECT_TRUE(eventually([&] { return feed.alive == 0; }));
}

TEST(EventStream, OneThatIsOverAtOnceIsComplete) {
  Feed feed;
  feed.add("data: all\n\n");
  feed.end();
  Served server(streaming(feed));
  RawClient client(server.port());
  EXPECT_EQ(client.ask(kAsk).body, "retry: 2000\n\ndata: all\n\n");
  EXPECT_TRUE(client.closed_by_peer());
}

TEST(EventStream, LetsGoOfItsSourceWhenTheClientLeaves) {
  Feed feed;
  Served server(streaming(feed));
  RawClient client(server.port());
  client.say(kAsk);
  ASSERT_TRUE(client.hear("retry"));
  EXPECT_EQ(feed.alive, 1);
  client.close();
  EXPECT_TRUE(eventually([&] { return feed.alive == 0; }));
}

TEST(EventStream, ASlowReaderIsDropped) {
  std::atomic<int> alive = 0;
  Served server([&](const Request&) {
    Response response;
    response.events = std::make_unique<Chatterbox>(alive);
    return response;
  });
  RawClient client(server.port(), 4096);
  client.say(kAsk);
  ASSERT_TRUE(client.hear("HTTP/1.1 200"));
  EXPECT_TRUE(eventually([&] {
    server.guard().wake();
    return alive == 0;
  }));
}

TEST(EventStream, AFailingSourceEndsOnlyItsStream) {
  Served server([](const Request&) {
    Response response;
    response.body = "hello";
    response.events = std::make_unique<Broken>();
    return response;
  });
  for (int i = 0; i < 2; ++i) EXPECT_EQ(RawClient(server.port()).ask(kAsk).body, "hello");
}

TEST(EventStream, HeadGetsTheHeadersOnly) {
  Feed feed;
  Served server(streaming(feed));
  RawClient client(server.port());
  const RawResponse response = client.ask("HEAD /events HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_EQ(response.header("Content-Type"), "text/event-stream");
  EXPECT_TRUE(client.closed_by_peer());
  EXPECT_TRUE(eventually([&] { return feed.alive == 0; }));
}

TEST(EventStream, StopEndsIt) {
  Feed feed;
  Served server(streaming(feed));
  RawClient client(server.port());
  client.say(kAsk);
  ASSERT_TRUE(client.hear("retry"));
  server.guard().stop();
  EXPECT_EQ(client.response().status, 200);
  EXPECT_TRUE(client.closed_by_peer());
  EXPECT_TRUE(eventually([&] { return feed.alive == 0; }));
}

TEST(EventStream, ManyNeedFewThreads) {
  constexpr std::size_t kStreams = 1500;
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 8192);
  setrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < 2 * kStreams + 100) GTEST_SKIP() << "needs " << 2 * kStreams + 100 << " open files";
  Feed feed;
  Served server(streaming(feed));
  std::vector<std::unique_ptr<RawClient>> clients;
  for (std::size_t i = 0; i < kStreams; ++i) {
    clients.push_back(std::make_unique<RawClient>(server.port()));
    clients.back()->say(kAsk);
  }
  for (const auto& client : clients) ASSERT_TRUE(client->hear("retry"));
  EXPECT_EQ(RawClient(server.port()).get("/still-here").status, 200);
  feed.add("data: all\n\n");
  server.guard().wake();
  for (const auto& client : clients) ASSERT_TRUE(client->hear("data: all"));
  clients.clear();
  EXPECT_TRUE(eventually([&] { return feed.alive == 0; }));
}

}  // namespace
}  // namespace wellspaced::http
