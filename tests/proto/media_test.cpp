#include "proto/formats/media.h"

#include <array>
#include <string>

#include <gmock/gmock.h>

#include "core/error.h"
#include "proto/result.h"

namespace wellspaced {
namespace {

using ::testing::HasSubstr;

Format chosen(std::string_view accept, std::string_view parameter = "") {
  return negotiate(parameter, accept, formats_of("generate"));
}

template <class Action>
std::string refusal(const Action& action, ErrorCode code) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(Negotiate, GivesTheFirstFormatToClientsThatDontMind) {
  for (const char* accept : {"", " ", "*/*", "application/*", "*/*;q=0.1", "text/html, */*;q=0.8",
                             "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8"})
    EXPECT_EQ(chosen(accept), Format::json) << accept;
}

TEST(Negotiate, FollowsTheWeights) {
  EXPECT_EQ(chosen("text/csv"), Format::csv);
  EXPECT_EQ(chosen("TEXT/CSV"), Format::csv);
  EXPECT_EQ(chosen("application/json;q=0.5, text/csv"), Format::csv);
  EXPECT_EQ(chosen("application/json ; Q=0.5 ,text/csv; q=0.4"), Format::json);
  EXPECT_EQ(chosen("image/*"), Format::svg);
  EXPECT_EQ(chosen("text/*;q=0.3, image/svg+xml;q=0.2"), Format::csv);
  EXPECT_EQ(chosen("text/csv;q=0.123, application/x-npy;q=0.124"), Format::npy);
  EXPECT_EQ(chosen("text/html, image/svg+xml"), Format::svg);
  EXPECT_EQ(chosen("application/json;charset=utf-8;q=0.1, application/x-npy;q=0.2"), Format::npy);
}

TEST(Negotiate, LetsTheMoreSpecificRangeDecide) {
  EXPECT_EQ(chosen("application/json;q=0, */*"), Format::npy);
  EXPECT_EQ(chosen("*/*, application/json;q=0"), Format::npy);
  EXPECT_EQ(chosen("application/*;q=0.1, application/x-npy, */*;q=0.5"), Format::npy);
  EXPECT_EQ(chosen("application/*;q=0, */*;q=0.1"), Format::csv);
}

TEST(Negotiate, LetsTheFormatParameterWin) {
  EXPECT_EQ(chosen("text/csv", "npy"), Format::npy);
  EXPECT_EQ(chosen("image/png", "svg"), Format::svg);
}

TEST(Negotiate, ListsTheFormatsWhereItRefuses) {
  const auto code = ErrorCode::not_acceptable;
  const char* list = "application/json (?format=json), application/x-npy (?format=npy), text/csv";
  for (const char* accept :
       {"image/jpeg", "text/html", "*/*;q=0", "application/json;q=0", ";", ",", "json", "*"})
    EXPECT_THAT(refusal([&] { chosen(accept); }, code), HasSubstr(list)) << accept;
  for (const char* name : {"jpg", "JSON", "json ", "application/json"})
    EXPECT_THAT(refusal([&] { chosen("*/*", name); }, code), HasSubstr(list)) << name;
  EXPECT_THAT(refusal([] { negotiate("npy", "", formats_of("analyze")); }, code),
              ::testing::Not(HasSubstr("npy")));
}

TEST(InputFormat, ReadsTheMediaTypeAlone) {
  EXPECT_EQ(input_format("application/json"), Format::json);
  EXPECT_EQ(input_format(" Application/JSON ; charset=utf-8"), Format::json);
  EXPECT_EQ(input_format("application/x-npy"), Format::npy);
  EXPECT_EQ(input_format("text/csv;header=present"), Format::csv);
}

TEST(InputFormat, SaysWhatToSendInstead) {
  const auto code = ErrorCode::unsupported_media_type;
  EXPECT_THAT(refusal([] { input_format(""); }, code), HasSubstr("no Content-Type; send application/json"));
  EXPECT_THAT(refusal([] { input_format("application/x-www-form-urlencoded"); }, code),
              HasSubstr("-H 'Content-Type: application/json'"));
  for (const char* picture : {"image/svg+xml", "image/png"}) refusal([=] { input_format(picture); }, code);
}

TEST(Formats, HaveDistinctNamesAndMediaTypes) {
  const std::array all = {Format::json, Format::npy, Format::csv, Format::svg, Format::png};
  for (const Format a : all)
    for (const Format b : all) {
      EXPECT_EQ(a == b, name_of(a) == name_of(b));
      EXPECT_EQ(a == b, media_type_of(a) == media_type_of(b));
    }
  EXPECT_EQ(name_of(Format::npy), "npy");
  EXPECT_EQ(media_type_of(Format::svg), "image/svg+xml");
}

}  // namespace
}  // namespace wellspaced
