// Domains are uploaded once, referred to by the hash of their bytes, and kept while anything lies on them.
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using support::Answer;
using support::Caller;
using support::Process;
using support::ServedApp;
using support::TemporaryDirectory;
using ::testing::HasSubstr;

constexpr const char* kPlain = "text/plain";

/// A regular tetrahedron with edges of length sqrt(8).
const std::string tetrahedron =
    "OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";
// printf ... | sha256sum
const std::string square = "POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))";
const std::string square_id = "95b031818c0bc2ae7014dc59edc8880150b263a3780c2e4ba85930421c1f897f";

std::string on(const std::string& type, const std::string& id, const std::string& more) {
  return R"({"domain":{"type":")" + type + R"(","id":")" + id + R"("},)" + more + "}";
}

TEST(ServiceDomains, AreKeptUnderTheHashOfTheirBytes) {
  const ServedApp app;
  const Caller caller(app.port());
  const Answer made = caller.post("/v1/domains", square, {}, kPlain);
  ASSERT_EQ(made.status, 201) << made.body;
  EXPECT_EQ(made.header("Location"), "/v1/domains/" + square_id);
  const json facts = made.parsed();
  EXPECT_EQ(facts["id"], square_id);
  EXPECT_EQ(facts["type"], "polygon");
  EXPECT_EQ(facts["format"], "wkt");
  EXPECT_EQ(facts["bytes"], square.size());
  EXPECT_EQ(facts["area"], 2.0);
  EXPECT_EQ(facts["boundary_length"], 6.0);
  EXPECT_EQ(facts["holes"], 0);
  EXPECT_EQ(facts["box"], json::parse(R"({"min":[0.0,0.0],"max":[2.0,1.0]})"));
  EXPECT_EQ(caller.post("/v1/domains", square, {}, kPlain).status, 200);
  const json again = caller.get("/v1/domains/" + square_id).parsed();
  EXPECT_EQ(again["area"], 2.0);
  const json mesh = caller.post("/v1/domains", tetrahedron, {}, "application/octet-stream").parsed();
  EXPECT_EQ(mesh["type"], "mesh");
  EXPECT_EQ(mesh["faces"], 4);
  EXPECT_EQ(mesh["genus"], 0);
  EXPECT_NEAR(mesh["area"].get<double>(), 8 * std::sqrt(3), 1e-12);

  const Answer first = caller.get("/v1/domains?limit=1");
  EXPECT_EQ(first.parsed()["domains"].size(), 1u);
  const std::string link = first.header("Link");
  const Answer second = caller.get(link.substr(1, link.find('>') - 1));
  EXPECT_NE(first.parsed()["domains"][0]["id"], second.parsed()["domains"][0]["id"]);

  EXPECT_EQ(caller.remove("/v1/domains/" + square_id).status, 204);
  EXPECT_EQ(caller.remove("/v1/domains/" + square_id).problem(), "no-such-domain");
  EXPECT_EQ(caller.get("/v1/domains/" + square_id).status, 404);
}

TEST(ServiceDomains, HoldPointsAsIfTheyWereGivenWhole) {
  const ServedApp app;
  const Caller caller(app.port());
  const std::string id = caller.post("/v1/domains", square, {}, kPlain).parsed()["id"];
  const std::string more = R"("method":"poisson-disk","radius":0.2,"seed":3)";
  const json made = caller.post("/v1/generate", on("polygon", id, more)).parsed();
  const json whole =
      caller.post("/v1/generate", R"({"domain":{"type":"polygon","wkt":")" + square + "\"}," + more + "}")
          .parsed();
  ASSERT_FALSE(made["points"].empty());
  EXPECT_EQ(made["points"], whole["points"]);
  EXPECT_EQ(made["domain"], json({{"type", "polygon"}, {"id", id}}));
}

TEST(ServiceDomains, StayWhileAnythingLiesOnThem) {
  const ServedApp app;
  const Caller caller(app.port());
  const std::string id = caller.post("/v1/domains", tetrahedron, {}, kPlain).parsed()["id"];
  const std::string job = caller.submit("generate", on("mesh", id, R"("radius":0.4)"));
  ASSERT_EQ(caller.finished(job)["status"], "successful");
  const Answer kept = caller.remove("/v1/domains/" + id);
  EXPECT_EQ(kept.problem(), "conflict");
  EXPECT_THAT(kept.body, HasSubstr(job));
  // Work on the job's points lies on the domain, too.
  const std::string next = caller.submit("optimize", R"({"points":{"job":")" + job + R"("},"beta":0.9})");
  ASSERT_EQ(caller.finished(next)["status"], "successful");
  EXPECT_EQ(caller.remove("/v1/jobs/" + job + "?purge=true").status, 204);
  EXPECT_THAT(caller.remove("/v1/domains/" + id).body, HasSubstr(next));
  EXPECT_EQ(caller.get("/v1/jobs/" + next + "/result").parsed()["domain"]["id"], id);
  EXPECT_EQ(caller.remove("/v1/jobs/" + next + "?purge=true").status, 204);
  EXPECT_EQ(caller.remove("/v1/domains/" + id).status, 204);
}

TEST(ServiceDomains, SayWhatIsWrongWithThem) {
  const ServedApp app;
  const Caller caller(app.port());
  const auto refused = [&](const std::string& body, const std::string& query = "",
                           const char* type = kPlain) {
    const Answer answer = caller.post("/v1/domains" + query, body, {}, type);
    return std::to_string(answer.status) + " " + answer.problem() + " " + answer.pointer();
  };
  EXPECT_EQ(refused("POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))").substr(0, 20), "422 degenerate-input");
  EXPECT_EQ(refused(R"({"type":"polygon","rings":[[[0,0],[1,0],[1,0]]]})", "", "application/json"),
            "422 degenerate-input /rings/0");
  EXPECT_EQ(refused("OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 9\n"), "422 invalid-parameters /faces/0");
  EXPECT_EQ(refused("OFF\n3 1000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").substr(0, 1), "4");
  EXPECT_EQ(refused("hello"), "400 malformed-request none");
  EXPECT_EQ(refused(square, "", "image/png"), "415 unsupported-media-type none");
  EXPECT_EQ(refused(square, "?format=stl"), "422 invalid-parameters /format");
  EXPECT_EQ(refused(square, "?color=red"), "422 invalid-parameters /color");
  EXPECT_EQ(caller.get("/v1/domains").parsed()["domains"].size(), 0u);
}

// Files of others that are known to be bad, each in its own way.
TEST(ServiceDomains, RefuseBadFilesOfOthersWithTheCulprit) {
  const std::string data = testing::shared_data();
  if (data.empty()) GTEST_SKIP() << "needs the folder that WELLSPACED_DATA_DIR names";
  const ServedApp app;
  const Caller caller(app.port());
  const auto read = [&](const std::string& name) {
    std::ifstream file(data + "/" + name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto expect_refused = [&](const std::string& body, const char* type, const std::string& pointer,
                                  const std::string& why) {
    const Answer answer = caller.post("/v1/domains", body, {}, type);
    EXPECT_EQ(answer.status, 422) << answer.body;
    EXPECT_THAT(answer.pointer(), ::testing::StartsWith(pointer)) << answer.body;
    EXPECT_THAT(answer.body, HasSubstr(why));
  };
  const auto polygon = [&](const std::string& name) {
    return R"({"type":"polygon","rings":)" + read("polygons_reject/" + name) + "}";
  };
  expect_refused(read("meshes_reject/fan3.obj"), kPlain, "/faces/", "edge");
  expect_refused(read("meshes_reject/degtri_sliding.off"), kPlain, "/faces/", "area");
  expect_refused(read("meshes_reject/tet-shuffled.off"), kPlain, "/faces/", "orient all faces alike");
  expect_refused(polygon("hourglass.json"), "application/json", "/rings/0/", "touches");
  expect_refused(polygon("bad-hole.json"), "application/json", "/rings/0/", "leave it out");
  EXPECT_EQ(caller.get("/v1/domains").parsed()["domains"].size(), 0u);
}

TEST(ServiceDomains, ReferencesSayWhatIsWrongWithThem) {
  const ServedApp app;
  const Caller caller(app.port());
  const auto refused = [&](const std::string& type, const std::string& id) {
    const Answer answer = caller.post("/v1/generate", on(type, id, R"("radius":0.3)"));
    return std::to_string(answer.status) + " " + answer.problem() + " " + answer.pointer();
  };
  EXPECT_EQ(refused("mesh", "abc"), "422 invalid-parameters /domain/id");
  EXPECT_EQ(refused("mesh", square_id), "404 no-such-domain /domain/id");
  caller.post("/v1/domains", square, {}, kPlain);
  EXPECT_EQ(refused("mesh", square_id), "422 invalid-parameters /domain/type");
}

TEST(ServiceDomains, SurviveAKillAfterTheirAnswer) {
  const TemporaryDirectory directory;
  const std::vector<std::string> serve = {"serve", "--listen", "127.0.0.1:0", "--store",
                                          directory / "jobs.db"};
  std::string id;
  {
    Process server(serve);
    id = Caller(server.port()).post("/v1/domains", square, {}, kPlain).parsed()["id"];
    server.signal(SIGKILL);
    server.wait();
  }
  Process server(serve);
  const Caller caller(server.port());
  EXPECT_EQ(caller.get("/v1/domains/" + id).status, 200);
  EXPECT_EQ(caller.post("/v1/generate", on("polygon", id, R"("radius":0.3)")).status, 200);
}

}  // namespace
}  // namespace wellspaced
