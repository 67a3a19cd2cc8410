#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/http/message.h"
#include "server/problem.h"

namespace wellspaced::http {

struct HeadLimits {
  std::size_t bytes = 16u << 10;        ///< the whole block with its empty line, else 431
  std::size_t lines = 64;               ///< header lines, else 431
  std::size_t target_bytes = 8u << 10;  ///< else 414
  std::size_t body_bytes = 256u << 20;  ///< by Content-Length, else 413
};

/// Whether a header block has arrived in full.
struct HeadScan {
  std::size_t end = 0;             ///< size of the block with its empty line; 0: more bytes are needed
  std::optional<Problem> problem;  ///< the bytes can never become an acceptable block
};

/// Looks at `bytes[from..]`; the bytes before were looked at by an earlier call that asked for more.
/// Errors (in `problem`): 400 for NUL and other control characters, bare CR and bare LF; 414 or 431 above the
/// limits. Cost: linear in the new bytes.
HeadScan scan_head(std::string_view bytes, std::size_t from, const HeadLimits& limits);

/// What the guard needs to know of a request before it reads the body.
struct Head {
  std::string method;
  std::string target;  ///< as sent
  Headers headers;     ///< values trimmed, never decoded; names with '_' (CGI-like: REMOTE_ADDR) are left out
  std::size_t content_length = 0;
  bool keep_alive = true;
  bool old_version = false;  ///< HTTP/1.0
  bool expects_continue = false;
};

/// Parses and vets a complete block as `scan_head` found it. Pure.
///
/// Guarantee: of two readers of a vetted head none can see another body length than the other (request
/// smuggling). Errors: 400 bad syntax, obs-fold, space before a colon, missing or repeated Host,
/// Transfer-Encoding together with Content-Length, repeated or non-numeric Content-Length, a body on GET or
/// HEAD; 411 Transfer-Encoding; 413; 414; 415 Content-Encoding; 417; 431; 501 unknown method; 505.
std::variant<Head, Problem> vet_head(std::string_view block, const HeadLimits& limits);

}  // namespace wellspaced::http
