#pragma once

#include "server/http/message.h"

namespace wellspaced::http {

/// Conditions and single byte ranges on complete 200 responses; anything else passes through unchanged.
/// Use: `return apply_range(request, apply_conditions(request, std::move(response)));`
/// Reference: RFC 9110, sections 13.1.2, 13.1.5 and 14.

/// 304 without a body when If-None-Match names the response's ETag (weak comparison) or is "*". GET and HEAD
/// only.
Response apply_conditions(const Request& request, Response response);

/// Guarantees
/// 1. A 200 to a GET or HEAD without events gets `Accept-Ranges: bytes`; a GET's with one satisfiable `bytes`
/// range it becomes 206 with
///    Content-Range and just these bytes; with one that lies outside it becomes 416 with `Content-Range:
///    bytes */size`.
/// 2. Several ranges, other units, malformed ranges, and an If-Range that is not exactly the (strong) ETag
/// leave the 200:
///    a client can never multiply the output.
/// Cost: no second copy of the body.
Response apply_range(const Request& request, Response response);

}  // namespace wellspaced::http
