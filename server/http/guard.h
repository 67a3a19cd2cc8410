#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "server/http/message.h"

namespace wellspaced::http {

struct GuardOptions {
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0: any free port, see Guard::port
  unsigned threads = 16;
  /// Quick ones (health, metrics). With a thread of their own they are answered when all others are busy.
  std::vector<std::string> reserved_paths;
  std::size_t body_limit_bytes = 256u << 20;
  std::size_t header_limit_bytes = 16u << 10;
  std::size_t header_limit_lines = 64;
  std::size_t target_limit_bytes = 8u << 10;  ///< else 414
  int header_timeout_ms = 10'000;             ///< for the whole header block, absolute
  int body_timeout_ms = 60'000;               ///< without progress of at least 64 KiB per timeout
  int write_timeout_ms = 60'000;              ///< likewise
  int idle_timeout_ms = 60'000;               ///< between requests of a kept-alive connection
  int drain_timeout_ms = 20'000;              ///< after stop, for everything but running handlers
  std::size_t connection_limit = 8192;        ///< parked and active; above it: 503 and close
};

/// What one finished exchange was, for logs and metrics.
struct Exchange {
  std::string id, method, route, target, trace_parent;
  std::string failure;  ///< what() of the exception behind a 500, for the log only
  int status = 0;       ///< 499: the client closed before its response was known
  double seconds = 0;
  std::size_t bytes_in = 0, bytes_out = 0;
};

/// HTTP/1.1 on top of cpp-httplib's parser, made fit for an open network.
///
/// Guarantees
/// 1. A handler sees only requests with a vetted header block: no Transfer-Encoding (411), no
///    Content-Encoding (415), one Content-Length, no obs-fold, no body on GET and HEAD, at most the limits
///    above (431, 413, 414, 408).
/// 2. Every refusal is a problem document, and `Expect: 100-continue` is answered before the body is read.
/// 3. Idle, slow and refused connections and event streams occupy no pool thread: only a complete request
///    does, and a response that its client is slow to read does no longer.
/// 4. A handler's exception never reaches the client as text: Error -> its problem; anything else -> 500
///    with the request id.
/// 5. HEAD gets the GET handler's headers without its body.
///
/// Thread safety: the handler is called from many threads at once, `on_exchange` from the thread in `serve`
/// (it must not block); `stop` and `wake` from any thread, also before `serve`.
class Guard {
 public:
  Guard(GuardOptions options, Handler handler, std::function<void(const Exchange&)> on_exchange = {});
  ~Guard();

  /// Binds (SO_REUSEADDR only, backlog 1024). Errors: Error{internal} that names host, port and the reason.
  void listen();
  int port() const;

  /// Serves until `stop`. Then: takes no new connections, lets running handlers finish and their answers go
  /// out, closes parked ones, ends event streams, and returns.
  void serve();
  void stop();

  /// Makes the hub poll all event sources now. Cheap; any thread.
  void wake();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wellspaced::http
