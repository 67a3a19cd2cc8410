#include "proto/formats/csv.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.h"

namespace wellspaced {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Error error_of(const std::string& text, std::size_t row_limit = 1000) {
  try {
    read_csv(text, row_limit);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error: " << text.substr(0, 80);
  return {ErrorCode::internal, "none"};
}

TEST(ReadCsv, ReadsTwoPointsHoweverTheyAreWritten) {
  const char* texts[] = {
      "0.5,1\n2,-3e-1\n",
      "0.5,1\n2,-3e-1",
      "0.5,1\r\n2,-3e-1\r\n",
      "\xef\xbb\xbfx,y\n0.5,1\n2,-3e-1\n",
      "x,y\n0.5,1\n2,-3e-1\n",
      "X;Y\n0.5;1\n2;-3e-1\n",
      "\"x\",\"y\"\n0.5,1\n2,-3e-1\n",
      "x y\n0.5 1\n2 -3e-1\n",
      "x,y\n0.5 1\n2 -3e-1\n",
      "0.5;1\n2;-3e-1\n",
      "0.5\t1\n2\t-3e-1\n",
      "0.5 1\n2 -3e-1\n",
      "  0.5   1  \n2 \t -3e-1\n",
      " 0.5 , 1 \n 2,-3e-1 \n",
      "# x,y\n\n0.5,1\n   \n# between\n2,-3e-1\n\n",
      "+0.5,+1\n+2,-0.3\n",
      "5.E-1,1.\n2,-.3\n",
  };
  for (const char* text : texts) {
    const Table table = read_csv(text, 2);
    EXPECT_EQ(table.rows, 2u) << text;
    EXPECT_EQ(table.columns, 2u) << text;
    EXPECT_THAT(table.values, ElementsAre(0.5, 1, 2, -0.3)) << text;
  }
}

TEST(ReadCsv, ReadsThreeColumns) {
  for (const char* text : {"x,y,z\n1,2,3\n4,5,6\n", "1,2,3\n4,5,6\n", "1 2 3\n4 5 6"}) {
    const Table table = read_csv(text, 2);
    EXPECT_EQ(table.columns, 3u) << text;
    EXPECT_THAT(table.values, ElementsAre(1, 2, 3, 4, 5, 6)) << text;
  }
}

TEST(ReadCsv, ReadsNothingAsNoRows) {
  for (const char* text : {"", "\n", "\r\n\r\n", "# nothing\n", "\xef\xbb\xbf", "   "}) {
    const Table table = read_csv(text, 0);
    EXPECT_EQ(table.rows, 0u) << text;
    EXPECT_EQ(table.columns, 0u) << text;
  }
  EXPECT_EQ(read_csv("x,y,z\n", 0).columns, 3u);
}

TEST(ReadCsv, PassesNanAndInfinityThrough) {
  const Table table = read_csv("nan,inf\n-inf,+Infinity\n-0,NaN\n", 3);
  EXPECT_TRUE(std::isnan(table.values[0]));
  EXPECT_EQ(table.values[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.values[2], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.values[3], std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(table.values[4]));
  EXPECT_TRUE(std::isnan(table.values[5]));
}

struct Refused {
  std::string text;
  std::string where;
  std::vector<std::string> message;
};

TEST(ReadCsv, SaysWhereAndWhatIsWrong) {
  const Refused cases[] = {
      {"1,2\n3,abc\n", "/1/1", {"line 2", "cell 2", "'abc'", "not a number"}},
      {"# c\n\nx,y\n1,2\n\n1,2,3\n", "/1", {"line 6", "3 cells where there were 2"}},
      {"x,y,z\n1,2\n", "/0", {"line 2", "2 cells where there were 3"}},
      {"1,2\n3\n", "/1", {"line 2", "only one cell", "'3'"}},
      {"1\n2\n", "/0", {"line 1", "only one cell"}},
      {"1,2,3,4\n", "/0", {"line 1", "more than 3 cells", "'4'"}},
      {"1,\n", "/0/1", {"line 1", "cell 2", "is empty"}},
      {",1\n", "/0/0", {"line 1", "cell 1", "is empty"}},
      {"1\t\t2\n", "/0/1", {"is empty"}},
      {"1,2,\n", "/0/2", {"cell 3", "is empty"}},
      {"0,5;0,7\n", "/0/0", {"'0,5'", "decimals with a point"}},
      {"1,2\n1;2\n", "/1/0", {"line 2", "'1;2'"}},
      {"1e999,2\n", "/0/0", {"'1e999'", "range of a double"}},
      {"1e-999,2\n", "/0/0", {"'1e-999'", "range of a double"}},
      {"0x10,2\n", "/0/0", {"'0x10'"}},
      {"--1,2\n", "/0/0", {"'--1'"}},
      {"+-1,2\n", "/0/0", {"'+-1'"}},
      {"++1,2\n", "/0/0", {"'++1'"}},
      {"+,2\n", "/0/0", {"'+'"}},
      {"1 0,2\n", "/0/0", {"'1 0'"}},
      {"\"1\",\"2\"\n", "/0/0", {"without quotes"}},
      {"lon,lat\n1,2\n", "/0/0", {"line 1", "'lon'", "x,y or x,y,z"}},
      {"y,x\n1,2\n", "/0/0", {"line 1", "'y'", "x,y or x,y,z"}},
      {"x,y\nx,y\n", "/0/0", {"line 2", "'x'"}},
      {"1,2\nx,y\n", "/1/0", {"line 2", "'x'"}},
      {"1,2 # end\n", "/0/1", {"'2 # end'"}},
  };
  for (const Refused& refused : cases) {
    const Error error = error_of(refused.text);
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameters) << refused.text;
    EXPECT_EQ(error.where(), refused.where) << refused.text;
    for (const std::string& part : refused.message)
      EXPECT_THAT(error.what(), HasSubstr(part)) << refused.text;
  }
}

TEST(ReadCsv, CutsAndCleansTheCellThatItNames) {
  const Error error = error_of("1,2\n1,\x1b[31m\xff'" + std::string(100, 'a') + "\n");
  const std::string message = error.what();
  EXPECT_THAT(message, HasSubstr("'?[31m??aaa"));
  EXPECT_THAT(message, HasSubstr("aaa...'"));
  EXPECT_EQ(message.find(std::string(40, 'a')), std::string::npos);
  for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
}

TEST(ReadCsv, RefusesMoreRowsThanAllowed) {
  EXPECT_EQ(read_csv("1,2\n3,4\n", 2).rows, 2u);
  const Error error = error_of("x,y\n1,2\n3,4\n5,nonsense\n", 2);
  EXPECT_EQ(error.code(), ErrorCode::too_large);
  EXPECT_THAT(error.what(), HasSubstr("limit of 2"));
  EXPECT_THAT(error.what(), HasSubstr("line 4"));
}

TEST(ReadCsv, RefusesUtf16AndBinaryBytes) {
  EXPECT_EQ(error_of(std::string("\xff\xfe\x31\x00", 4)).code(), ErrorCode::malformed_request);
  EXPECT_EQ(error_of(std::string("\xfe\xff\x00\x31", 4)).code(), ErrorCode::malformed_request);
  EXPECT_EQ(error_of(std::string("1,2\0\n", 5)).code(), ErrorCode::invalid_parameters);
  EXPECT_EQ(error_of(std::string(100'000, '\0')).code(), ErrorCode::invalid_parameters);
}

TEST(WriteCsv, WritesAHeaderAndTheShortestNumbers) {
  const std::vector<double> values = {0.1, 1, -0.0, 1e22, 5e-324, 1.0 / 3};
  EXPECT_EQ(write_csv(values.data(), 3, 2), "x,y\n0.1,1\n-0,1e+22\n5e-324,0.3333333333333333\n");
  EXPECT_EQ(write_csv(values.data(), 1, 3), "x,y,z\n0.1,1,-0\n");
  EXPECT_EQ(write_csv(nullptr, 0, 2), "x,y\n");
  EXPECT_EQ(write_csv(nullptr, 0, 3), "x,y,z\n");
}

TEST(WriteCsv, WritesWhatTheReaderReads) {
  std::vector<double> values;
  std::uint64_t bits = 0x9e3779b97f4a7c15u;
  while (values.size() < 30'000) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    const auto value = std::bit_cast<double>(bits);
    if (!std::isnan(value)) values.push_back(value);
  }
  for (const std::size_t columns : {2u, 3u}) {
    const Table table = read_csv(write_csv(values.data(), values.size() / columns, columns), values.size());
    ASSERT_EQ(table.values.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(table.values[i]), std::bit_cast<std::uint64_t>(values[i]));
    }
  }
}

}  // namespace
}  // namespace wellspaced
