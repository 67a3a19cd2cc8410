#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wellspaced::http {

/// ASCII case-insensitive order, for header names.
struct CaseInsensitiveLess {
  using is_transparent = void;
  bool operator()(std::string_view a, std::string_view b) const;
};
using Headers = std::multimap<std::string, std::string, CaseInsensitiveLess>;

/// A vetted request: the guard has already refused everything that is not plain HTTP/1.1 (see guard.h).
struct Request {
  std::string method;                 ///< "GET", "HEAD", "POST", "DELETE", ...
  std::string target;                 ///< path and query as sent, not decoded
  std::string path;                   ///< without the query, percent-decoded
  std::vector<std::string> segments;  ///< of the path, each decoded after splitting on '/'
  /// Of the path pattern: {id}. Mutable because the router, alone, fills it in without copying the request.
  mutable std::vector<std::pair<std::string, std::string>> parameters;
  mutable std::string route;  ///< pattern that matched, likewise; known even when the handler throws
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded, in order, duplicates kept
  Headers headers;
  std::string body;
  std::string id;  ///< request id: the client's X-Request-Id if sane, else our own
  /// True once the client has closed its connection, while its request is worked on: nobody waits for an
  /// answer any more. Never missing in a handler.
  std::shared_ptr<const std::atomic<bool>> gone;

  /// First value of a header, or empty.
  std::string_view header(std::string_view name) const;
  /// Value of a path parameter; it must exist.
  const std::string& parameter(std::string_view name) const;
};

/// Bytes that come over time (server-sent events). Lives on the hub thread, never on a pool thread.
class EventSource {
 public:
  virtual ~EventSource() = default;
  /// Bytes to send now; empty: nothing new; nullopt: the stream is over, close it.
  /// Called every 200 ms or so and at once after `Hub::wake`. Must not block.
  virtual std::optional<std::string> poll() = 0;
};

struct Response;

/// A response that is not known yet, because a job has to end first. Waiting occupies no pool thread.
class Pending {
 public:
  virtual ~Pending() = default;
  /// Asked on the hub thread every 200 ms or so and at once after `Guard::wake`. Must not block.
  virtual bool ready() = 0;
  /// Once, on a pool thread, when ready. Its exceptions become problems, as a handler's do.
  virtual Response finish() = 0;
  /// Instead of finish, on a pool thread: the client has closed its connection.
  virtual void abandon() {}
};

struct Response {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::unique_ptr<EventSource> events;  ///< when set: `body` goes out first, then what the source yields
  std::unique_ptr<Pending> pending;     ///< when set, it alone counts: the response is what it finishes with
  std::string route;                    ///< pattern that matched, for logs and metrics; set by the router

  Response& set(std::string name, std::string value) {
    headers.emplace_back(std::move(name), std::move(value));
    return *this;
  }
};

using Handler = std::function<Response(const Request&)>;

}  // namespace wellspaced::http
