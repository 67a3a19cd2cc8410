#include "server/jobs/job_id.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <sys/random.h>

#include "core/error.h"

namespace wellspaced {
namespace {

constexpr std::string_view kAlphabet = "0123456789abcdefghjkmnpqrstvwxyz";
constexpr int kTimeBits = 48;
constexpr int kIdBits = 5 * static_cast<int>(kJobIdLength);
constexpr std::size_t kBytes = (kIdBits + 7) / 8;

using Bits = std::array<unsigned char, kBytes>;  // first bit = highest of the first byte

void fill_with_random(unsigned char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = getrandom(to, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error(ErrorCode::internal, "the kernel gives no random bytes for a job id");
    to += got;
    count -= static_cast<std::size_t>(got);
  }
}

bool bit_at(const Bits& bits, std::size_t i) { return ((bits[i / 8] >> (7 - i % 8)) & 1) != 0; }

}  // namespace

std::string make_job_id(std::int64_t time_ms) {
  const std::int64_t time = std::clamp<std::int64_t>(time_ms, 0, (std::int64_t{1} << kTimeBits) - 1);
  Bits bits{};
  constexpr std::size_t kTimeBytes = kTimeBits / 8;
  for (std::size_t i = 0; i < kTimeBytes; ++i) {
    bits[i] = static_cast<unsigned char>(time >> (kTimeBits - 8 * (static_cast<int>(i) + 1)));
  }
  fill_with_random(bits.data() + kTimeBytes, kBytes - kTimeBytes);

  std::string id(kJobIdLength, '0');
  for (std::size_t c = 0; c < kJobIdLength; ++c) {
    unsigned digit = 0;
    for (std::size_t b = 0; b < 5; ++b) digit = digit << 1 | (bit_at(bits, 5 * c + b) ? 1u : 0u);
    id[c] = kAlphabet[digit];
  }
  return id;
}

bool is_job_id(std::string_view text) {
  return text.size() == kJobIdLength && text.find_first_not_of(kAlphabet) == std::string_view::npos;
}

std::int64_t job_id_time_ms(std::string_view id) {
  constexpr std::size_t kDigits = (kTimeBits + 4) / 5;
  std::int64_t bits = 0;
  for (const char c : id.substr(0, kDigits)) bits = bits << 5 | static_cast<std::int64_t>(kAlphabet.find(c));
  return bits >> (5 * kDigits - kTimeBits);
}

}  // namespace wellspaced
