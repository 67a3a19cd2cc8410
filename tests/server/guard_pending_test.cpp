// Responses that wait for something: they occupy no thread, and end when their client goes.
#include <atomic>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "server/http/guard.h"
#include "tests/server/raw_client.h"

namespace wellspaced::http {
namespace {

using test::eventually;
using test::RawClient;
using test::Served;

std::string get(const std::string& target) { return "GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n"; }

/// What the waiting responses of a test share.
struct Gate {
  std::atomic<bool> open = false;
  std::atomic<int> finished = 0, abandoned = 0, alive = 0;
};

class GatedResponse final : public Pending {
 public:
  explicit GatedResponse(Gate& gate) : gate_(gate) { ++gate_.alive; }
  ~GatedResponse() override { --gate_.alive; }
  bool ready() override { return gate_.open; }
  Response finish() override {
    ++gate_.finished;
    Response response;
    response.body = "at last";
    return response;
  }
  void abandon() override { ++gate_.abandoned; }

 private:
  Gate& gate_;
};

Handler gated(Gate& gate) {
  return [&gate](const Request& request) {
    Response response;
    if (request.path == "/now") response.body = "now";
    if (request.path != "/now") response.pending = std::make_unique<GatedResponse>(gate);
    return response;
  };
}

TEST(Guard, PendingResponsesOccupyNoThread) {
  Gate gate;
  Served server(gated(gate));  // with far fewer threads than clients
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int k = 0; k < 100; ++k) {
    clients.push_back(std::make_unique<RawClient>(server.port()));
    clients.back()->say(get("/later"));
  }
  ASSERT_TRUE(eventually([&] { return gate.alive == 100; }));
  EXPECT_EQ(RawClient(server.port()).get("/now").body, "now");
  gate.open = true;
  server.guard().wake();
  for (auto& client : clients) EXPECT_EQ(client->response().body, "at last");
  EXPECT_EQ(gate.finished, 100);
  EXPECT_EQ(gate.alive, 0);
}

TEST(Guard, AbandonsAPendingResponseWhoseClientHasGone) {
  Gate gate;
  Served server(gated(gate));
  RawClient client(server.port());
  client.say(get("/later"));
  ASSERT_TRUE(eventually([&] { return gate.alive == 1; }));
  client.close();
  EXPECT_TRUE(eventually([&] { return gate.abandoned == 1 && gate.alive == 0; }));
  EXPECT_EQ(gate.finished, 0);
}

TEST(Guard, TellsAHandlerThatItsClientHasGone) {
  std::atomic<bool> working = false, told = false;
  std::atomic<int> status = 0;
  Served server(
      GuardOptions{},
      [&](const Request& request) -> Response {
        working = true;
        told = eventually([&] { return request.gone->load(); });
        throw Error(ErrorCode::cancelled, "nobody waits");
      },
      [&](const Exchange& exchange) { status = exchange.status; });
  RawClient client(server.port());
  client.say(get("/slow"));
  ASSERT_TRUE(eventually([&] { return working.load(); }));
  client.close();
  EXPECT_TRUE(eventually([&] { return status == 499; }));
  EXPECT_TRUE(told);
}

TEST(Guard, AnswersPipelinedRequestsAfterAPendingOneInOrder) {
  Gate gate;
  Served server(gated(gate));
  RawClient client(server.port());
  client.say(get("/later") + get("/now"));
  ASSERT_TRUE(eventually([&] { return gate.alive == 1; }));
  gate.open = true;
  EXPECT_EQ(client.response().body, "at last");
  EXPECT_EQ(client.response().body, "now");
}

TEST(Guard, FinishesPendingResponsesWhenItStops) {
  Gate gate;
  Served server(gated(gate));
  RawClient client(server.port());
  client.say(get("/later"));
  ASSERT_TRUE(eventually([&] { return gate.alive == 1; }));
  server.guard().stop();
  gate.open = true;
  EXPECT_EQ(client.response().body, "at last");
}

}  // namespace
}  // namespace wellspaced::http
