#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "server/http/guard.h"
#include "server/http/header_block.h"
#include "server/http/message.h"
#include "server/http/socket.h"

namespace wellspaced::http {

using Clock = std::chrono::steady_clock;

enum class Io {
  done,     ///< nothing is left to do
  partial,  ///< something was moved, and there may be more
  blocked,  ///< the socket takes or has no more just now
  failed,   ///< closed or reset by the peer
};

/// One client. It has one owner at a time: the hub, or, in state `handling`, one worker of the pool. Members
/// under "hub only" are the hub's even then.
struct Connection {
  enum class State {
    head,       ///< waiting for, or in the middle of, a header block
    body,       ///< the head is vetted, the body is arriving
    handling,   ///< with a worker
    waiting,    ///< for its `pending` response to be ready
    writing,    ///< the response is going out
    streaming,  ///< the response is an event stream
    lingering,  ///< everything is said; waiting for the client to close, so that a reset can't eat the
                ///< response
    closed,
  };

  explicit Connection(Descriptor fd) : socket(std::move(fd)) {}

  Descriptor socket;
  std::string in;           ///< received, not yet consumed; at most a header block and one read
  std::size_t scanned = 0;  ///< of `in`, by scan_head
  Head head;
  Request request;
  std::string out_head, out_body;
  std::size_t sent = 0;  ///< of out_head and out_body together
  bool close_after = false;
  std::unique_ptr<EventSource> events;
  std::unique_ptr<Pending> pending;
  std::string pending_route;  ///< the route that made `pending`
  bool abandoned = false;     ///< the client closed before its response was known
  Exchange exchange;
  bool reported = false;  ///< the exchange has been told to on_exchange
  Clock::time_point started;

  /// @name hub only
  /// @{
  State state = State::head;
  Clock::time_point deadline;
  std::size_t progress_mark = 0;  ///< bytes moved when `deadline` was last put off
  bool readable = false;
  std::shared_ptr<std::atomic<bool>> gone;  ///< what `request.gone` shows to whom works on it
  bool surplus = false;                     ///< above the connection limit: it only gets told so
  bool queued = false;                      ///< in the hub's list of connections to look at
  /// @}

  std::size_t unsent() const { return out_head.size() + out_body.size() - sent; }
};

/// Sends what is left of out_head and out_body, at most about `budget` bytes, without blocking and without a
/// copy. Never raises SIGPIPE.
Io flush(Connection& connection, std::size_t budget);

/// Forgets the bytes of out_head and out_body that are sent, when they are worth it, and counts them.
void drop_sent(Connection& connection);

/// Appends at most `limit` bytes to `into`, in one read; never `done`.
Io receive(int fd, std::string& into, std::size_t limit);

/// Makes a finished exchange's connection ready for the next request; keeps pipelined bytes.
void reset_exchange(Connection& connection);

/// The client's X-Request-Id if it is 1 to 64 characters of [A-Za-z0-9._-], else a new one.
std::string request_id(std::string_view offered);

}  // namespace wellspaced::http
