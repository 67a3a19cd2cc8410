#pragma once

#include <string>
#include <string_view>

namespace wellspaced {

/// Errors: malformed_request for a text that is not base64 (RFC 4648, padded; line breaks are taken).
std::string decode_base64(std::string_view text);

/// Padded, without line breaks.
std::string encode_base64(std::string_view bytes);

}  // namespace wellspaced
