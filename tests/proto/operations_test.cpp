#include "proto/operations.h"

#include <string>

#include <gtest/gtest.h>

#include "proto/measures/measures.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

ordered_json operation(const std::string& name, const Limits& limits = {}) {
  const ordered_json all = operations_json(limits);
  for (const ordered_json& candidate : all["operations"])
    if (candidate["name"] == name) return candidate;
  ADD_FAILURE() << "no operation " << name;
  return {};
}

template <class Row>
void expect_methods(const ordered_json& methods, std::span<const Row> rows) {
  ASSERT_EQ(methods.size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(methods[k]["name"], rows[k].name);
    EXPECT_EQ(methods[k]["title"], rows[k].title);
    EXPECT_EQ(methods[k]["parameters"].size(), rows[k].parameters.size());
    for (const Parameter& p : rows[k].parameters)
      EXPECT_EQ(methods[k]["parameters"][p.name], parameter_schema(p)) << rows[k].name << " " << p.name;
  }
}

TEST(Operations, ListEveryMethodWithItsParameters) {
  expect_methods(operation("generate")["methods"], generators());
  expect_methods(operation("optimize")["methods"], optimizers());
}

TEST(Operations, ListEveryMeasureWithTheSchemaOfItsResult) {
  const ordered_json listed = operation("analyze")["measures"];
  ASSERT_EQ(listed.size(), measures().size());
  for (std::size_t k = 0; k < listed.size(); ++k) {
    EXPECT_EQ(listed[k]["name"], measures()[k].name);
    EXPECT_EQ(listed[k]["result"], measures()[k].schema());
  }
}

TEST(Operations, ListTheFormatsOfTheirResults) {
  for (const std::string name : operation_names) {
    const ordered_json formats = operation(name)["formats"];
    ASSERT_EQ(formats.size(), formats_of(name).size());
    for (std::size_t k = 0; k < formats.size(); ++k) {
      EXPECT_EQ(formats[k]["name"], std::string(name_of(formats_of(name)[k])));
      EXPECT_EQ(formats[k]["media_type"], std::string(media_type_of(formats_of(name)[k])));
    }
  }
}

TEST(Operations, TellTheLimitsThatHoldHere) {
  Limits limits;
  limits.generate_points = 11;
  limits.optimize_points = 12;
  limits.analyze_points = 13;
  EXPECT_EQ(operation("generate", limits)["limits"]["points"], 11);
  EXPECT_EQ(operation("optimize", limits)["limits"]["points"], 12);
  EXPECT_EQ(operation("analyze", limits)["limits"]["points"], 13);
}

}  // namespace
}  // namespace wellspaced
