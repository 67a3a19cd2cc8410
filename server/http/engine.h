#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/http/message.h"

namespace wellspaced::http {

/// Status and headers exactly as they go out.
struct ReplyHead {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// cpp-httplib, and the only place that includes it. It parses the (vetted) request line, dispatches and
/// writes the response's head; its sockets, threads, header decoding, body reading, ranges and compression
/// are never reached.
///
/// Thread safety: none; each thread has its own.
class Engine {
 public:
  Engine();
  ~Engine();

  /// Feeds httplib the request line (without CR LF), calls `handle` once from its routing hook, and returns
  /// the response's head as text. `handle` must not throw.
  std::string exchange(const std::string& request_line, const std::function<ReplyHead()>& handle);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

struct ReplyContext {
  std::string request_id;
  bool close = false;
  bool old_version = false;  ///< HTTP/1.0 must be told when the connection stays
};

/// The headers of a response plus those that only the guard knows: Date, X-Request-Id, Connection,
/// Content-Length and, for event streams, what keeps proxies from holding them back. Values are stripped of
/// control characters.
ReplyHead reply_head(const Response& response, const ReplyContext& context);

}  // namespace wellspaced::http
