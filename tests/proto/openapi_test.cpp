#include "proto/openapi.h"

#include <algorithm>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "core/render/pictures/pictures.h"
#include "proto/measures/measures.h"
#include "proto/operations.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

using nlohmann::ordered_json;

const ordered_json& document() {
  static const ordered_json made = openapi_json({});
  return made;
}

const ordered_json& schema(const std::string& name) { return document()["components"]["schemas"].at(name); }

/// The schema in a union that is for that method.
const ordered_json& schema_of_method(const std::string& all, const std::string& method) {
  static const ordered_json none;
  for (const auto& choice : schema(all)["oneOf"]) {
    const std::string reference = choice["$ref"];
    const std::string name = reference.substr(reference.rfind('/') + 1);
    const ordered_json& candidate = schema(name);
    if (candidate["properties"]["method"]["enum"] == ordered_json::array({method})) return candidate;
  }
  ADD_FAILURE() << all << " has no " << method;
  return none;
}

void expect_parameters(const ordered_json& object, const Method& method) {
  for (const Parameter& p : method.parameters) {
    SCOPED_TRACE(method.name + " " + p.name);
    ASSERT_TRUE(object["properties"].contains(p.name));
    EXPECT_EQ(object["properties"][p.name], parameter_schema(p));
    const auto required = object.value("required", ordered_json::array());
    EXPECT_EQ(p.required, std::find(required.begin(), required.end(), p.name) != required.end());
    if (!p.density) continue;
    const std::string alternative = R"({"required":[")" + p.name + "\"]}";
    EXPECT_THAT(object["oneOf"], ::testing::Contains(ordered_json::parse(alternative)));
  }
  EXPECT_EQ(object["additionalProperties"], false);
}

TEST(Openapi, DescribesEveryParameterOfEveryMethod) {
  for (const Generator& method : generators()) {
    expect_parameters(schema_of_method("GenerateRequest", method.name), method);
    expect_parameters(schema_of_method("PointsToGenerate", method.name), method);
  }
  for (const Optimizer& method : optimizers())
    expect_parameters(schema_of_method("OptimizeRequest", method.name), method);
  EXPECT_EQ(schema("GenerateRequest")["oneOf"].size(), generators().size());
  EXPECT_EQ(schema("OptimizeRequest")["oneOf"].size(), optimizers().size());
}

std::set<std::string> query_names(const std::string& path) {
  std::set<std::string> names;
  for (const auto& parameter : document()["paths"][path]["post"]["parameters"])
    if (parameter["in"] == "query" && !names.insert(parameter["name"]).second)
      ADD_FAILURE() << parameter["name"] << " is there twice";
  return names;
}

TEST(Openapi, RequiresPointsWhereTheyAreWorkedOn) {
  const auto points = ::testing::Contains(ordered_json("points"));
  for (const Optimizer& method : optimizers())
    EXPECT_THAT(schema_of_method("OptimizeRequest", method.name)["required"], points);
  std::vector<std::string> sources;
  for (const auto& one : schema("AnalyzeRequest")["oneOf"]) sources.push_back(one["required"][0]);
  EXPECT_THAT(sources, ::testing::ElementsAre("points", "sets", "compare"));
}

TEST(Openapi, ListsTheQueryOfRequestsWhosePointsAreNotJson) {
  const auto optimize = query_names("/v1/optimize"), analyze = query_names("/v1/analyze");
  for (const Optimizer& method : optimizers())
    for (const Parameter& p : method.parameters) EXPECT_EQ(optimize.count(p.name), 1u) << p.name;
  for (const char* name : {"method", "enrich", "format", "picture", "domain.type", "domain.width",
                           "domain.height", "domain.radius", "domain.wkt"})
    EXPECT_EQ(optimize.count(name), 1u) << name;
  for (const char* name : {"measures", "format", "picture", "domain.type", "domain.width", "domain.height"})
    EXPECT_EQ(analyze.count(name), 1u) << name;
  std::set<std::string> pictorial = {"format", "picture", "picture.scale"};
  for (const Picture& picture : pictures())
    for (const Parameter& p : picture.parameters) pictorial.insert("picture." + p.name);
  EXPECT_EQ(query_names("/v1/generate"), pictorial);
}

TEST(Openapi, OffersEveryFormatOfEveryOperation) {
  for (const std::string operation : operation_names) {
    const auto& content = document()["paths"]["/v1/" + operation]["post"]["responses"]["200"]["content"];
    EXPECT_EQ(content.size(), formats_of(operation).size()) << operation;
    for (const Format format : formats_of(operation))
      EXPECT_TRUE(content.contains(std::string(media_type_of(format))))
          << operation << " " << name_of(format);
  }
}

TEST(Openapi, DescribesEveryMeasure) {
  for (const Measure& measure : measures()) {
    EXPECT_EQ(schema("AnalyzeResult")["properties"][measure.name], measure.schema());
    EXPECT_EQ(schema("ComparedResult")["properties"][measure.name], measure.schema());
    const ordered_json choices = schema("AnalyzeRequest")["properties"]["measures"]["items"]["oneOf"];
    EXPECT_THAT(choices[0]["enum"], ::testing::Contains(ordered_json(measure.name)));
    const auto own = std::find_if(choices.begin() + 1, choices.end(), [&](const ordered_json& choice) {
      return choice["properties"]["measure"]["enum"][0] == measure.name;
    });
    ASSERT_NE(own, choices.end()) << measure.name;
    for (const Parameter& p : measure.parameters) {
      EXPECT_EQ((*own)["properties"][p.name], parameter_schema(p));
      EXPECT_EQ(query_names("/v1/analyze").count(measure.name + "." + p.name), 1u);
    }
  }
}

/// Calls found(target) for each reference in a document.
template <class Found>
void each_reference(const ordered_json& value, const Found& found) {
  if (value.is_object() && value.contains("$ref")) found(value["$ref"].get<std::string>());
  if (value.is_structured())
    for (const auto& inner : value) each_reference(inner, found);
}

TEST(Openapi, RefersOnlyToWhatItHasAndHasOnlyWhatItRefersTo) {
  std::set<std::string> referred;
  each_reference(document(), [&](const std::string& target) {
    ASSERT_TRUE(target.starts_with("#/"));
    EXPECT_TRUE(document().contains(ordered_json::json_pointer(target.substr(1)))) << target;
    referred.insert(target);
  });
  for (const char* kind : {"schemas", "responses"})
    for (const auto& [name, value] : document()["components"][kind].items())
      EXPECT_EQ(referred.count(std::string("#/components/") + kind + "/" + name), 1u) << name;
}

TEST(Openapi, NamesEachOperationOnceAndAllOfItsPathParameters) {
  std::set<std::string> ids;
  for (const auto& [path, verbs] : document()["paths"].items())
    for (const auto& [verb, operation] : verbs.items()) {
      EXPECT_TRUE(ids.insert(operation["operationId"]).second) << operation["operationId"];
      std::string bare = path;
      for (const auto& parameter : operation.value("parameters", ordered_json::array())) {
        const std::string token = "{" + parameter["name"].get<std::string>() + "}";
        if (parameter["in"] != "path") continue;
        ASSERT_NE(bare.find(token), std::string::npos) << path;
        bare.erase(bare.find(token), token.size());
      }
      EXPECT_EQ(bare.find('{'), std::string::npos) << path;
    }
}

TEST(ParameterSchema, WritesRangeDefaultAndUnit) {
  const Parameter p{"beta", Parameter::Type::number, "Target", "degrees", 0.5, 1, false, true, "0.75"};
  const ordered_json schema = parameter_schema(p);
  EXPECT_EQ(schema["type"], "number");
  EXPECT_EQ(schema["description"], "Target (degrees)");
  EXPECT_EQ(schema["minimum"], 0.5);
  EXPECT_EQ(schema["exclusiveMaximum"], 1);
  EXPECT_EQ(schema["default"], 0.75);
  EXPECT_EQ(schema.size(), 5u);
}

TEST(ParameterSchema, WritesADefaultInWordsIntoTheDescription) {
  const Parameter p{"count", Parameter::Type::integer, "Wanted", "", 1, 1e15, false, false, "what fits"};
  const ordered_json schema = parameter_schema(p);
  EXPECT_EQ(schema["type"], "integer");
  EXPECT_EQ(schema["description"], "Wanted; default: what fits");
  EXPECT_EQ(schema["minimum"], 1);
  EXPECT_EQ(schema.size(), 3u);
}

}  // namespace
}  // namespace wellspaced
