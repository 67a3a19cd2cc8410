#include "server/http/header_block.h"

#include <random>

#include <gtest/gtest.h>

#include "server/http/target.h"

namespace wellspaced::http {
namespace {

using namespace std::string_view_literals;

constexpr HeadLimits kLimits;

std::variant<Head, Problem> vet(const std::string& lines) {
  const std::string block = lines + "\r\n";
  const HeadScan scan = scan_head(block, 0, kLimits);
  if (scan.problem) return *scan.problem;
  EXPECT_EQ(scan.end, block.size());
  return vet_head(block, kLimits);
}

int status_of(const std::string& lines) {
  const auto vetted = vet(lines);
  const auto* problem = std::get_if<Problem>(&vetted);
  return problem != nullptr ? problem->status : 200;
}

Head head_of(const std::string& lines) { return std::get<Head>(vet(lines)); }

const std::string kGet = "GET /a?b=c HTTP/1.1\r\nHost: x\r\n";
const std::string kPost = "POST /a HTTP/1.1\r\nHost: x\r\n";

TEST(HeaderBlock, APlainRequestIsRead) {
  const Head head = head_of(kPost + "Content-Length: 12\r\nX-Thing:  spaced out \t\r\n");
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.target, "/a");
  EXPECT_EQ(head.content_length, 12u);
  EXPECT_EQ(head.headers.find("x-thing")->second, "spaced out");
  EXPECT_TRUE(head.keep_alive);
  EXPECT_FALSE(head.expects_continue);
}

TEST(HeaderBlock, HeaderValuesAreNotPercentDecoded) {
  EXPECT_EQ(head_of(kGet + "If-None-Match: \"%0d%0a\"\r\n").headers.find("If-None-Match")->second,
            "\"%0d%0a\"");
}

TEST(HeaderBlock, NamesWithUnderscoresAreDropped) {
  const Head head = head_of(kGet + "REMOTE_ADDR: 1.2.3.4\r\nContent_Length: 3\r\nEXCEPTION_WHAT: x\r\n");
  EXPECT_EQ(head.headers.size(), 1u);  // Host
}

TEST(HeaderBlock, MissingContentLengthOnPostIsZero) { EXPECT_EQ(head_of(kPost).content_length, 0u); }

TEST(HeaderBlock, ConnectionAndVersionDecideAboutKeepAlive) {
  EXPECT_FALSE(head_of(kGet + "Connection: foo, Close\r\n").keep_alive);
  EXPECT_FALSE(head_of("GET / HTTP/1.0\r\n").keep_alive);
  EXPECT_TRUE(head_of("GET / HTTP/1.0\r\nConnection: Keep-Alive\r\n").keep_alive);
}

struct Case {
  const char* name;
  std::string lines;
  int status;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class HeaderBlockRefusal : public testing::TestWithParam<Case> {};

TEST_P(HeaderBlockRefusal, HasItsStatus) { EXPECT_EQ(status_of(GetParam().lines), GetParam().status); }

std::string many(int count) {
  std::string lines;
  for (int i = 0; i < count; ++i) lines += "A: b\r\n";
  return lines;
}

INSTANTIATE_TEST_SUITE_P(
    All, HeaderBlockRefusal,
    testing::Values(
        Case{"Valid", kGet, 200}, Case{"TransferEncoding", kPost + "Transfer-Encoding: chunked\r\n", 411},
        Case{"BothLengths", kPost + "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n", 400},
        Case{"TwoLengths", kPost + "Content-Length: 3\r\nContent-Length: 3\r\n", 400},
        Case{"LengthList", kPost + "Content-Length: 3, 3\r\n", 400},
        Case{"NegativeLength", kPost + "Content-Length: -1\r\n", 400},
        Case{"PlusLength", kPost + "Content-Length: +1\r\n", 400},
        Case{"HexLength", kPost + "Content-Length: 0x10\r\n", 400},
        Case{"EmptyLength", kPost + "Content-Length:\r\n", 400},
        Case{"HugeLength", kPost + "Content-Length: 99999999999999999999999\r\n", 413},
        Case{"LengthAtLimit", kPost + "Content-Length: 268435456\r\n", 200},
        Case{"LengthAboveLimit", kPost + "Content-Length: 268435457\r\n", 413},
        Case{"BodyOnGet", kGet + "Content-Length: 1\r\n", 400},
        Case{"EmptyBodyOnGet", kGet + "Content-Length: 0\r\n", 200},
        Case{"BodyOnHead", "HEAD / HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\n", 400},
        Case{"Fold", kGet + "A: b\r\n c\r\n", 400}, Case{"TabFold", kGet + "A: b\r\n\tc\r\n", 400},
        Case{"FoldedFirstLine", "GET / HTTP/1.1\r\n Host: x\r\n", 400},
        Case{"SpaceBeforeColon", kGet + "A : b\r\n", 400}, Case{"NoColon", kGet + "Ab\r\n", 400},
        Case{"EmptyName", kGet + ": b\r\n", 400}, Case{"BadName", kGet + "A(b: c\r\n", 400},
        Case{"BareLf", kGet + "A: b\nC: d\r\n", 400}, Case{"BareCr", kGet + "A: b\rC: d\r\n", 400},
        Case{"Nul", kGet + "A: b" + std::string(1, '\0') + "\r\n", 400},
        Case{"Escape", kGet + "A: \x1b[0m\r\n", 400}, Case{"NoHost", "GET / HTTP/1.1\r\n", 400},
        Case{"NoHostIn10", "GET / HTTP/1.0\r\n", 200}, Case{"TwoHosts", kGet + "Host: y\r\n", 400},
        Case{"BadHost", "GET / HTTP/1.1\r\nHost: a b\r\n", 400},
        Case{"Gzip", kPost + "Content-Length: 1\r\nContent-Encoding: gzip\r\n", 415},
        Case{"Identity", kPost + "Content-Length: 1\r\nContent-Encoding: identity\r\n", 200},
        Case{"Expect", kPost + "Content-Length: 1\r\nExpect: 100-Continue\r\n", 200},
        Case{"OtherExpect", kPost + "Content-Length: 1\r\nExpect: cake\r\n", 417},
        Case{"Version2", "PRI * HTTP/2.0\r\n", 505}, Case{"Version12", "GET / HTTP/1.2\r\nHost: x\r\n", 505},
        Case{"VersionWord", "GET / HTTQ/1.1\r\nHost: x\r\n", 400}, Case{"OneWord", "GET\r\n", 400},
        Case{"TwoWords", "GET /\r\n", 400}, Case{"DoubleSpace", "GET  / HTTP/1.1\r\nHost: x\r\n", 400},
        Case{"SpaceInTarget", "GET /a b HTTP/1.1\r\nHost: x\r\n", 400},
        Case{"HighByteInTarget", "GET /\xc3\xa4 HTTP/1.1\r\nHost: x\r\n", 400},
        Case{"Fragment", "GET /#a HTTP/1.1\r\nHost: x\r\n", 400},
        Case{"LowerCaseMethod", "get / HTTP/1.1\r\nHost: x\r\n", 501},
        Case{"LinesAtLimit", kGet + many(63), 200}, Case{"LinesAboveLimit", kGet + many(64), 431},
        Case{"LongTarget", "GET /" + std::string(8192, 'a') + " HTTP/1.1\r\nHost: x\r\n", 414},
        Case{"TargetAtLimit", "GET /" + std::string(8191, 'a') + " HTTP/1.1\r\nHost: x\r\n", 200},
        Case{"LongBlock", kGet + "A: " + std::string(16384, 'a') + "\r\n", 431},
        Case{"EndlessTarget", "GET /" + std::string(20000, 'a'), 414}),
    [](const auto& param) { return param.param.name; });

TEST(HeaderBlock, ExpectWithoutABodyIsNotAnswered) {
  EXPECT_FALSE(head_of(kPost + "Expect: 100-continue\r\n").expects_continue);
  EXPECT_TRUE(head_of(kPost + "Expect: 100-continue\r\nContent-Length: 1\r\n").expects_continue);
}

TEST(HeaderBlock, ScanFindsTheSameEndHoweverTheBytesArrive) {
  const std::string block = kGet + "A: b\r\n\r\n", bytes = block + "GET / HTTP/1.1\r\n\r\n";
  for (std::size_t cut = 0; cut < block.size(); ++cut) {
    const HeadScan first = scan_head(std::string_view(bytes).substr(0, cut), 0, kLimits);
    ASSERT_FALSE(first.problem) << cut;
    ASSERT_EQ(first.end, 0u) << cut;
    EXPECT_EQ(scan_head(bytes, cut, kLimits).end, block.size()) << cut;
  }
}

TEST(HeaderBlock, RandomDamageNeverYieldsAnInvalidHead) {
  std::mt19937 random(20240607);
  const std::string base = kPost + "Content-Length: 3\r\nConnection: close\r\n\r\n";
  const std::string_view alphabet = "\r\n\t \0:,%/AZaz09\x7f\x80\xff"sv;
  int accepted = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string block = base;
    for (unsigned damage = random() % 4 + 1; damage > 0; --damage)
      block[random() % block.size()] = alphabet[random() % alphabet.size()];
    const HeadScan scan = scan_head(block, 0, kLimits);
    if (scan.problem || scan.end == 0) continue;
    const auto vetted = vet_head(std::string_view(block).substr(0, scan.end), kLimits);
    const auto* head = std::get_if<Head>(&vetted);
    if (head == nullptr) continue;
    ++accepted;
    ASSERT_LE(head->content_length, kLimits.body_bytes);
    ASSERT_EQ(head->headers.count("Transfer-Encoding"), 0u);
    for (const auto& [name, value] : head->headers)
      ASSERT_EQ((name + value).find_first_of(std::string("\r\n\0_", 4)), std::string::npos) << block;
  }
  EXPECT_GT(accepted, 1000);
}

Target target_of(const std::string& text) { return std::get<Target>(parse_target(text)); }

TEST(Target, IsSplitBeforeItIsDecodedAndDecodedOnce) {
  const Target target = target_of("/v1/a%2Fb/%2541/+?x=1&y=a%20b+c&x=2&flag&=v&&e=a=b");
  EXPECT_EQ(target.segments, (std::vector<std::string>{"v1", "a/b", "%41", "+"}));
  EXPECT_EQ(target.path, "/v1/a/b/%41/+");
  const std::vector<std::pair<std::string, std::string>> query = {{"x", "1"},   {"y", "a b c"}, {"x", "2"},
                                                                  {"flag", ""}, {"", "v"},      {"e", "a=b"}};
  EXPECT_EQ(target.query, query);
}

TEST(Target, RootAndTrailingSlashesAreKeptApart) {
  EXPECT_EQ(target_of("/").segments, (std::vector<std::string>{""}));
  EXPECT_EQ(target_of("/a").segments, (std::vector<std::string>{"a"}));
  EXPECT_EQ(target_of("/a/").segments, (std::vector<std::string>{"a", ""}));
  EXPECT_EQ(target_of("//a").segments, (std::vector<std::string>{"", "a"}));
}

TEST(Target, AbsoluteFormLosesItsAuthority) {
  EXPECT_EQ(target_of("http://host:80/a?b=c").text, "/a?b=c");
  EXPECT_EQ(target_of("http://host?b=c").text, "/?b=c");
  EXPECT_EQ(target_of("https://host").path, "/");
}

TEST(Target, InvalidEscapesAndFormsAreRefused) {
  for (const char* text : {"/%", "/%4", "/%zz", "/%00", "/a?b=%00", "/a?%=b", "/a?b=%1", "a", "host:80"}) {
    const auto parsed = parse_target(text);
    ASSERT_TRUE(std::holds_alternative<Problem>(parsed)) << text;
    EXPECT_EQ(std::get<Problem>(parsed).status, 400) << text;
  }
}

}  // namespace
}  // namespace wellspaced::http
