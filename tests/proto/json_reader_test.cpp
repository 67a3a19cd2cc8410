#include "proto/json_reader.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"
#include "proto/json_writer.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> pointers = {"/points", "/points/points", "/other"};

JsonDocument read(const std::string& text, std::size_t row_limit = 1000) {
  return read_json(text, pointers, row_limit);
}

Error error_of(const std::string& text, std::size_t row_limit = 1000) {
  try {
    read(text, row_limit);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error: " << text.substr(0, 80);
  return {ErrorCode::internal, "none"};
}

const Table& only(const JsonDocument& document) {
  EXPECT_EQ(document.tables.size(), 1u);
  return document.tables.at(0).table;
}

std::string repeat(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

TEST(ReadJson, ReadsADocumentWithoutPointsAsTheLibraryDoes) {
  const char* texts[] = {
      "null",
      "-12",
      "18446744073709551615",
      "1e-999",
      "\"\\u00e9\\ud83d\\ude00\\n \\\\\"",
      "[]",
      "{}",
      " \r\n\t{\"a\" : [1, -2, 2.5e3, true, false, null, \"s   s\", {\"b\": []}] , \"c\":{}}  \n ",
      "\xef\xbb\xbf{\"a\":1}",
      "{\"points\":{\"generate\":{\"count\":10}},\"other\":3}",
      "[[1,2],[3,4]]",
      "{\"a\":{\"points\":[[1,2],[3,4,5]]},\"list\":[{\"points\":[[1]]}]}",
  };
  for (const char* text : texts) {
    const JsonDocument document = read(text);
    EXPECT_EQ(document.root, Json::parse(text)) << text;
    EXPECT_TRUE(document.tables.empty()) << text;
  }
}

TEST(ReadJson, TakesThePointsOutOfTheTree) {
  const JsonDocument document = read(R"({"a": 1, "points": [[0.5, 1], [-2, 3e-1]], "b": [2]})");
  EXPECT_EQ(document.root, Json::parse(R"({"a": 1, "points": [], "b": [2]})"));
  ASSERT_EQ(document.tables.size(), 1u);
  EXPECT_EQ(document.tables[0].pointer, "/points");
  EXPECT_EQ(only(document).rows, 2u);
  EXPECT_EQ(only(document).columns, 2u);
  EXPECT_THAT(only(document).values, ElementsAre(0.5, 1, -2, 0.3));
}

TEST(ReadJson, FindsPointsAtEveryPointer) {
  const JsonDocument nested = read(R"({"points": {"domain": {}, "points": [[1,2,3],[4,5,6],[7,8,9]]}})");
  EXPECT_EQ(nested.tables.at(0).pointer, "/points/points");
  EXPECT_EQ(nested.root, Json::parse(R"({"points": {"domain": {}, "points": []}})"));
  EXPECT_EQ(only(nested).columns, 3u);
  EXPECT_THAT(only(nested).values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));

  const std::array<std::string_view, 1> root = {""};
  const JsonDocument bare = read_json("[[1,2],[3,4]]", root, 10);
  EXPECT_EQ(bare.root, Json::array());
  EXPECT_THAT(only(bare).values, ElementsAre(1, 2, 3, 4));
}

TEST(ReadJson, FindsSeveralListsByPlaceholders) {
  constexpr std::array<std::string_view, 2> places = {"/**/points", "/sets/*"};
  const JsonDocument document = read_json(
      R"({"sets": [[[1,2]], {"points": [[3,4,5]]}, 7], "a": {"points": [], "sets": [[6]]}})", places, 3);
  EXPECT_EQ(document.root,
            Json::parse(R"({"sets": [[], {"points": []}, 7], "a": {"points": [], "sets": [[6]]}})"));
  ASSERT_EQ(document.tables.size(), 3u);
  EXPECT_EQ(document.tables[0].pointer, "/sets/0");
  EXPECT_THAT(document.tables[0].table.values, ElementsAre(1, 2));
  EXPECT_EQ(document.tables[1].pointer, "/sets/1/points");
  EXPECT_THAT(document.tables[1].table.values, ElementsAre(3, 4, 5));
  EXPECT_EQ(document.tables[2].pointer, "/a/points");
  EXPECT_EQ(document.tables[2].table.rows, 0u);
}

TEST(ReadJson, CountsTheRowsOfAllLists) {
  constexpr std::array<std::string_view, 1> places = {"/**/points"};
  const std::string text = R"({"points": [[1,2],[3,4]], "a": {"points": [[5,6],[7,8]]}})";
  EXPECT_EQ(read_json(text, places, 4).tables.size(), 2u);
  try {
    read_json(text, places, 3);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::too_large);
    EXPECT_EQ(error.where(), "/a/points");
  }
}

TEST(ReadJson, ReadsAnEmptyListAsNoPoints) {
  const JsonDocument document = read(R"({"points": [ ]})", 0);
  ASSERT_EQ(document.tables.size(), 1u);
  EXPECT_EQ(only(document).rows, 0u);
  EXPECT_EQ(only(document).columns, 0u);
  EXPECT_EQ(document.tables.at(0).pointer, "/points");
}

// The reader passes plain rows by the library's lexer: both ways must agree, whichever row is plain.
TEST(ReadJson, ReadsEveryNumberAsTheLibraryDoesWhereverItStands) {
  const std::vector<std::string> numbers = {"0",
                                            "-0",
                                            "-0.0",
                                            "7",
                                            "-7",
                                            "0.1",
                                            "1e5",
                                            "1E+5",
                                            "1e-5",
                                            "5e-324",
                                            "1e-999",
                                            "2.5e-324",
                                            "0.000000000000000000000000000000000000001",
                                            "9007199254740993",
                                            "18446744073709551615",
                                            "18446744073709551616",
                                            "-9223372036854775809",
                                            "1.7976931348623157e308",
                                            "0." + repeat("3", 2000),
                                            "1" + repeat("0", 300),
                                            "123456789012345678901234567890e-20"};
  for (const std::string& number : numbers) {
    const double expected = number == "-0" ? -0.0 : Json::parse(number).get<double>();
    std::string text = "{\"points\":[";
    for (int row = 0; row < 4; ++row) {
      if (row != 0) text += row == 2 ? " ,\n" : ",";
      text += row == 1 ? "[" + number + "," + number + "]" : "[ " + number + "\t,\r\n" + number + " ]";
    }
    const JsonDocument document = read(text + "]}", 4);
    ASSERT_EQ(only(document).values.size(), 8u) << number;
    for (const double value : only(document).values) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << number;
    }
  }
}

struct Refused {
  std::string text;
  std::string where;
  std::string message;
};

TEST(ReadJson, RefusesWhatIsNotAListOfPoints) {
  const std::string plain = "[0,0],[0,0],";
  const Refused cases[] = {
      {R"({"points": [0.5, 0.5]})", "/points/0", "found a number"},
      {R"({"points": [[0,0], "a"]})", "/points/1", "found a string"},
      {R"({"points": [[0,0], null]})", "/points/1", "found null"},
      {R"({"points": [[0,0], true]})", "/points/1", "found a boolean"},
      {R"({"points": [[0,0], {"x": 1}]})", "/points/1", "found an object"},
      {R"({"points": [[0,0], [0, "a"]]})", "/points/1/1", "found a string"},
      {R"({"points": [[0,0], [null, 0]]})", "/points/1/0", "found null"},
      {R"({"points": [[0,0], [0, [1]]]})", "/points/1/1", "found an array"},
      {R"({"points": [[0,0], [{}, 1]]})", "/points/1/0", "found an object"},
      {R"({"points": [[0,0], [1,2], 3, [4,5]]})", "/points/2", "found a number"},
      {R"({"points": [[]]})", "/points/0", "this one has 0"},
      {R"({"points": [[1]]})", "/points/0", "this one has 1"},
      {R"({"points": [[1,2,3,4]]})", "/points/0", "this one has more"},
      {R"({"points": [[1,2],[1,2],[1,2],[1,2,3],[1,2]]})", "/points/3",
       "3 coordinates, the ones before have 2"},
      {R"({"points": [[1,2,3],[1,2]]})", "/points/1", "2 coordinates, the ones before have 3"},
      {"{\"points\":{\"points\":[" + repeat(plain, 100) + "[0,false]]}}", "/points/points/200/1",
       "found a boolean"},
  };
  for (const Refused& refused : cases) {
    const Error error = error_of(refused.text);
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << refused.text;
    EXPECT_EQ(error.where(), refused.where) << refused.text;
    EXPECT_THAT(error.what(), HasSubstr(refused.message)) << refused.text;
  }
}

TEST(ReadJson, NamesThePlaceOfAnOverflow) {
  const Refused cases[] = {
      {R"({"radius": 1e999})", "/radius", "range of a double"},
      {R"({"a": [0, {"b": -1e999}]})", "/a/1/b", "range of a double"},
      {R"({"points": [[0,0],[0,1e999],[0,0]]})", "/points/1/1", "range of a double"},
      {R"({"points": [[1e999,0]]})", "/points/0/0", "range of a double"},
      {"1e999", "", "range of a double"},
      {"[" + std::string(400, '9') + "]", "/0", "range of a double"},
  };
  for (const Refused& refused : cases) {
    const Error error = error_of(refused.text);
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << refused.text;
    EXPECT_EQ(error.where(), refused.where) << refused.text;
    EXPECT_THAT(error.what(), HasSubstr(refused.message)) << refused.text;
  }
}

TEST(ReadJson, RefusesAKeyTwice) {
  EXPECT_EQ(error_of(R"({"a": {"seed": 1, "seed": 1}})").where(), "/a/seed");
  const Error points = error_of(R"({"points": [[0,0]], "points": [[0,0]]})");
  EXPECT_EQ(points.code(), ErrorCode::invalid_parameters);
  EXPECT_EQ(points.where(), "/points");
  EXPECT_THAT(points.what(), HasSubstr("twice"));
}

TEST(ReadJson, SaysWhereAndWhyTextIsMalformed) {
  const Refused cases[] = {
      {"", "line 1, column 1 (byte offset 0)", "empty"},
      {"  \n ", "line 2, column 2 (byte offset 4)", "empty"},
      {"{\"a\": NaN}", "line 1, column 7 (byte offset 6)", "NaN and Infinity"},
      {"{\"a\":\n nan}", "line 2, column 3 (byte offset 8)", "NaN and Infinity"},
      {"[Infinity]", "byte offset 1", "NaN and Infinity"},
      {"[-Infinity]", "byte offset 2", "NaN and Infinity"},
      {"{\"points\": [[0,0],[0,0],[NaN,0]]}", "byte offset 25", "NaN and Infinity"},
      {"{\"points\": [[0,0],\n[0,0],\n[0,0,],[0,0]]}", "line 3, column 6 (byte offset 31)",
       "comma before the closing"},
      {"{\"points\": [[0,0],[1,2],]}", "byte offset 24", "comma before the closing"},
      {"{\"points\": [[0,0],[1,2],x3,4]]}", "byte offset 24", "invalid literal"},
      {"{\"points\": [[0,0],[1,2] [3,4]]}", "byte offset 24", "unexpected '['"},
      {"[True]", "byte offset 1", "true, false or null"},
      {"[None]", "byte offset 1", "true, false or null"},
      {"[undefined]", "byte offset 1", "true, false or null"},
      {"[1,", "byte offset 3", "too early"},
      {"{\"a\"   ", "byte offset 7", "too early"},
      {"\"abc", "byte offset 4", "closing quote"},
      {"{} {}", "byte offset 3", "more text after the end"},
      {"{}}", "byte offset 2", "more text after the end"},
      {"[1 2]", "byte offset 3", "unexpected number literal"},
      {"[1     2  ]", "byte offset 7", "unexpected number literal"},
      {"[1,2,]", "byte offset 5", "comma before the closing"},
      {"{\"a\":1,}", "byte offset 7", "comma before the closing"},
      {"{\"a\":1 // one\n}", "byte offset 7", "no comments"},
      {"# one\n{}", "byte offset 0", "no comments"},
      {"{'a':1}", "byte offset 1", "double quotes"},
      {"{true:1}", "byte offset 4", "expected string literal"},
      {"[01]", "byte offset 2", "unexpected number literal"},
      {"[.5]", "byte offset 1", "invalid literal"},
      {"[1.]", "byte offset 3", "digit after '.'"},
      {"{\"points\": [[0,0],[1.,0],[0,0]]}", "byte offset 21", "digit after '.'"},
      {"{\"points\": [[0,0],[0,01],[0,0]]}", "byte offset 22", "unexpected number literal"},
      {"[\"\xc3\xa9\", \"\xff\"]", "column 8 (byte offset 8)", "UTF-8"},
      {"[\"a\nb\"]", "byte offset 3", "control character"},
      {"[\"\\x\"]", "byte offset 3", "invalid string"},
      {"[\"\\ud800\"]", "byte offset 8", "surrogate"},
      {std::string("{}\0{}", 5), "byte offset 2", "NUL"},
      {"\xef\xbb{}", "byte offset 2", "BOM"},
  };
  for (const Refused& refused : cases) {
    const Error error = error_of(refused.text);
    EXPECT_EQ(error.code(), ErrorCode::malformed_request) << refused.text;
    EXPECT_THAT(error.what(), HasSubstr(refused.where)) << refused.text;
    EXPECT_THAT(error.what(), HasSubstr(refused.message)) << refused.text;
    EXPECT_EQ(error.where(), "") << refused.text;
  }
}

TEST(ReadJson, RefusesEveryTruncation) {
  const std::string text = R"({"a": [1, "\u00e9"], "points": [[0.5, 1], [2, 3], [4, 5]], "b": {"c": true}})";
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_EQ(error_of(text.substr(0, size)).code(), ErrorCode::malformed_request) << size;
  }
}

TEST(ReadJson, EscapesAndCutsThePointerAndEchoesNothingElse) {
  const std::string text = "{\"a/b~\\u0001\\n" + std::string(200, 'k') + "\": [\"secret\", 1e999]}";
  const Error error = error_of(text);
  EXPECT_EQ(error.where(), "/a~1b~0??" + std::string(94, 'k') + ".../1");
  const std::string cut = error_of("{\"" + std::string(99, 'k') + "\xc3\xa9\": 1e999}").where();
  EXPECT_EQ(cut, "/" + std::string(99, 'k') + "...");
  for (const char* bad :
       {"[\"secret\" \"secret\"]", "[secret]", "{\"secret\" 1}", "[\"secret\xff\"]", "[\"secret"}) {
    EXPECT_EQ(std::string(error_of(bad).what()).find("secret"), std::string::npos) << bad;
  }
}

TEST(ReadJson, AllowsSixteenLevelsAndNoMore) {
  EXPECT_EQ(read(std::string(16, '[') + std::string(16, ']')).root.size(), 1u);
  const Error error = error_of(std::string(17, '[') + std::string(17, ']'));
  EXPECT_EQ(error.code(), ErrorCode::malformed_request);
  EXPECT_THAT(error.what(), HasSubstr("deeper than 16"));
  EXPECT_EQ(error.where(), repeat("/0", 16));
  const std::string open = "{\"" + std::string(60, 'k') + "\":";
  EXPECT_LE(error_of(repeat(open, 100)).where().size(), 103u);
}

TEST(ReadJson, RefusesHostileTextBeforeItCostsAnything) {
  const std::clock_t start = std::clock();  // processor time: the load of the machine doesn't count
  const std::size_t size = 40'000'000;
  EXPECT_EQ(error_of(std::string(size, '[')).code(), ErrorCode::malformed_request);
  EXPECT_EQ(error_of("{\"points\":" + std::string(size, '[')).code(), ErrorCode::invalid_parameters);
  EXPECT_EQ(error_of(repeat("{\"a\":", 1'000'000)).code(), ErrorCode::malformed_request);
  EXPECT_EQ(error_of("\"" + std::string(size, 'a')).code(), ErrorCode::too_large);
  EXPECT_EQ(error_of("[" + std::string(size, '1')).code(), ErrorCode::too_large);
  EXPECT_EQ(error_of("{\"points\":[" + repeat("[0,0],", 1'000'000)).code(), ErrorCode::too_large);
  EXPECT_EQ(error_of(std::string(size, '\n') + "]").code(), ErrorCode::malformed_request);
  // Some 0.5 s without sanitizers; the library's tree takes 17 s for the first of these.
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 10);
}

TEST(ReadJson, LimitsTheNumberOfValuesButNotOfPoints) {
  const auto list = [](std::size_t count) { return "[0" + repeat(",0", count - 1) + "]"; };
  EXPECT_EQ(read(list(99'999)).root.size(), 99'999u);
  const Error error = error_of("{\"a\":" + list(99'999) + "}");
  EXPECT_EQ(error.code(), ErrorCode::invalid_parameters);
  EXPECT_EQ(error.where(), "/a/99998");
  EXPECT_THAT(error.what(), HasSubstr("100000"));
  const JsonDocument document = read("{\"points\":[[0,0]" + repeat(",[0,0]", 199'999) + "]}", 200'000);
  EXPECT_EQ(only(document).rows, 200'000u);
}

TEST(ReadJson, RefusesMorePointsThanAllowed) {
  EXPECT_EQ(read(R"({"points": [[1,2],[3,4],[5,6]]})", 3).tables[0].table.rows, 3u);
  for (const std::size_t limit : {0u, 1u, 2u}) {
    const Error error = error_of(R"({"points": [[1,2],[3,4],[5,6]]})", limit);
    EXPECT_EQ(error.code(), ErrorCode::too_large) << limit;
    EXPECT_EQ(error.where(), "/points") << limit;
    EXPECT_THAT(error.what(), HasSubstr("limit of " + std::to_string(limit)));
  }
}

TEST(JsonWriter, WritesTheShortestNumbers) {
  const std::pair<double, const char*> numbers[] = {{0, "0"},
                                                    {-0.0, "-0"},
                                                    {1, "1"},
                                                    {0.1, "0.1"},
                                                    {1e22, "1e+22"},
                                                    {5e-324, "5e-324"},
                                                    {1.0 / 3, "0.3333333333333333"},
                                                    {-1.7976931348623157e308, "-1.7976931348623157e+308"},
                                                    {NAN, "null"},
                                                    {INFINITY, "null"},
                                                    {-INFINITY, "null"}};
  for (const auto& [value, text] : numbers) {
    std::string out = "=";
    append_number(out, value);
    EXPECT_EQ(out, std::string("=") + text);
  }
}

TEST(JsonWriter, WritesRows) {
  const std::vector<double> values = {0.5, 1, NAN, -2.5, 3, 4};
  EXPECT_EQ(rows_to_json(values.data(), 3, 2), "[[0.5,1],[null,-2.5],[3,4]]");
  EXPECT_EQ(rows_to_json(values.data(), 2, 3), "[[0.5,1,null],[-2.5,3,4]]");
  EXPECT_EQ(rows_to_json(nullptr, 0, 2), "[]");
}

TEST(JsonWriter, WritesWhatTheReaderReads) {
  std::vector<double> values;
  std::uint64_t bits = 0x9e3779b97f4a7c15u;
  while (values.size() < 30'000) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    const auto value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) values.push_back(value);
  }
  for (const std::size_t columns : {2u, 3u}) {
    const std::size_t rows = values.size() / columns;
    const JsonDocument document =
        read("{\"points\":" + rows_to_json(values.data(), rows, columns) + "}", rows);
    ASSERT_EQ(only(document).values.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(only(document).values[i]),
                std::bit_cast<std::uint64_t>(values[i]));
    }
  }
}

}  // namespace
}  // namespace wellspaced
