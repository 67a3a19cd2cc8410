#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace wellspaced {

/// Job ids: 48 bits of milliseconds since 1970, then 122 bits from the kernel's random source, in lowercase
/// Crockford base32 (digits and letters without i, l, o, u).
///
/// Guarantees
/// 1. Always `kJobIdLength` characters of [0-9a-z], safe in a path and in a file name.
/// 2. Text order is time order: a later millisecond gives a greater id.
/// 3. One id tells nothing about another one's random bits.
inline constexpr std::size_t kJobIdLength = 34;

/// Times outside of 48 bits are moved to the nearer end. Errors: internal if the kernel gives no random
/// bytes.
std::string make_job_id(std::int64_t time_ms);

/// True for text of the right length and alphabet; nothing else can name a job.
bool is_job_id(std::string_view text);

/// The time within an id. Requires: is_job_id(id).
std::int64_t job_id_time_ms(std::string_view id);

}  // namespace wellspaced
