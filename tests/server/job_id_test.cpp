#include "server/jobs/job_id.h"

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace wellspaced {
namespace {

constexpr std::int64_t kSomeTimeMs = 1'700'000'000'123;

TEST(JobId, HasOneLengthAndOneAlphabet) {
  for (const std::int64_t time :
       {std::int64_t{0}, std::int64_t{1}, kSomeTimeMs, (std::int64_t{1} << 48) - 1}) {
    const std::string id = make_job_id(time);
    EXPECT_EQ(id.size(), kJobIdLength);
    EXPECT_EQ(id.find_first_not_of("0123456789abcdefghjkmnpqrstvwxyz"), std::string::npos) << id;
    EXPECT_TRUE(is_job_id(id));
  }
}

TEST(JobId, KeepsItsTime) {
  for (const std::int64_t time :
       {std::int64_t{0}, std::int64_t{1}, kSomeTimeMs, (std::int64_t{1} << 48) - 1}) {
    EXPECT_EQ(job_id_time_ms(make_job_id(time)), time);
  }
}

TEST(JobId, MovesTimesOutsideOf48BitsToTheNearerEnd) {
  EXPECT_EQ(job_id_time_ms(make_job_id(-5)), 0);
  EXPECT_EQ(job_id_time_ms(make_job_id(std::numeric_limits<std::int64_t>::max())),
            (std::int64_t{1} << 48) - 1);
}

TEST(JobId, SortsByTime) {
  std::string last = make_job_id(kSomeTimeMs - 1);
  for (std::int64_t i = 0; i < 2000; ++i) {
    std::string next = make_job_id(kSomeTimeMs + i);
    ASSERT_LT(last, next);
    last = std::move(next);
  }
}

TEST(JobId, NeverRepeatsWithinAMillisecond) {
  std::set<std::string> seen;
  for (int i = 0; i < 20'000; ++i) EXPECT_TRUE(seen.insert(make_job_id(kSomeTimeMs)).second);
}

// 122 random bits: the last two of the time's ten characters' 50 bits, and all of the other 24 characters.
TEST(JobId, DrawsEveryCharacterAfterTheTimeFromTheWholeAlphabet) {
  std::array<std::set<char>, kJobIdLength> letters;
  for (int i = 0; i < 4000; ++i) {
    const std::string id = make_job_id(kSomeTimeMs);
    for (std::size_t c = 0; c < kJobIdLength; ++c) letters[c].insert(id[c]);
  }
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(letters[c].size(), 1u) << c;
  EXPECT_EQ(letters[9].size(), 4u);
  for (std::size_t c = 10; c < kJobIdLength; ++c) EXPECT_EQ(letters[c].size(), 32u) << c;
}

TEST(JobId, RefusesWhatIsNoId) {
  const std::string id = make_job_id(kSomeTimeMs);
  EXPECT_FALSE(is_job_id(""));
  EXPECT_FALSE(is_job_id(id.substr(1)));
  EXPECT_FALSE(is_job_id(id + "0"));
  for (const char wrong : {'i', 'l', 'o', 'u', 'A', '/', '.', ' ', '\0', '\xff'}) {
    std::string other = id;
    other[5] = wrong;
    EXPECT_FALSE(is_job_id(other)) << wrong;
  }
}

}  // namespace
}  // namespace wellspaced
