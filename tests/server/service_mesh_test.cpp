// POST /v1/mesh as clients see it.

#include <string>

#include <gmock/gmock.h>

#include "tests/support/server_app.h"

namespace wellspaced {
namespace {

using nlohmann::json;
using support::Answer;
using support::Caller;
using support::ServedApp;

const std::string request =
    R"({"points":{"generate":{"count":200,"domain":{"type":"sphere"}}},"method":"voronoi"})";

TEST(ServiceMesh, ComesInTheFormatAskedForWithASummary) {
  const ServedApp app;
  const Caller caller(app.port());
  const json told = caller.post("/v1/mesh", request).parsed();
  EXPECT_EQ(told["faces"].size(), 200u);
  const struct {
    const char *format, *type, *start;
  } forms[] = {{"ply", "model/ply", "ply\nformat binary_little_endian"},
               {"obj", "model/obj", "# wellspaced\nv "},
               {"vtu", "application/vnd.vtk.vtu+xml", "<?xml"}};
  for (const auto& form : forms) {
    SCOPED_TRACE(form.format);
    const Answer answer = caller.post("/v1/mesh?format=" + std::string(form.format), request);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.header("Content-Type"), form.type);
    EXPECT_TRUE(answer.body.starts_with(form.start));
    EXPECT_THAT(answer.header("Content-Disposition"), ::testing::HasSubstr(form.format));
    const json summary = json::parse(answer.header("Wellspaced-Summary"));
    EXPECT_EQ(summary["quality"]["faces"], 200);
    EXPECT_EQ(caller.post("/v1/mesh", request, {{"Accept", form.type}}).body, answer.body);
  }
  const Answer refused = caller.post("/v1/mesh?format=svg", request);
  EXPECT_EQ(refused.status, 406);
  EXPECT_THAT(refused.body, ::testing::HasSubstr("vtu"));
}

TEST(ServiceMesh, IsAJobWhosePointsAreOthersInput) {
  const ServedApp app;
  const Caller caller(app.port());
  const std::string job = caller.submit("mesh", request);
  ASSERT_EQ(caller.finished(job)["status"], "successful");
  EXPECT_EQ(caller.get("/v1/jobs/" + job + "/result?format=vtu").body,
            caller.post("/v1/mesh?format=vtu", request).body);
  const Answer next = caller.post("/v1/mesh", R"({"points":{"job":")" + job + R"("}})");
  EXPECT_EQ(next.parsed()["faces"].size(), 396u);
  EXPECT_EQ(caller.get("/v1/jobs?operation=mesh").parsed()["jobs"].size(), 3u);
  EXPECT_EQ(caller.get("/v1/operations/mesh").parsed()["methods"].size(), 2u);
}

TEST(ServiceMesh, SaysWhatIsWrong) {
  const ServedApp app;
  const Caller caller(app.port());
  const Answer method = caller.post("/v1/mesh", R"({"points":{"generate":{"count":9}},"method":"quad"})");
  EXPECT_EQ(method.problem(), "invalid-parameters");
  EXPECT_EQ(method.pointer(), "/method");
  const Answer picture = caller.post("/v1/mesh?picture=points", request);
  EXPECT_EQ(picture.pointer(), "/picture");
}

}  // namespace
}  // namespace wellspaced
