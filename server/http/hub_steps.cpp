// What the hub does with one connection; the loop around it is in hub.cpp.
#include <algorithm>
#include <cstdint>
#include <exception>

#include <sys/socket.h>

#include "server/http/hub.h"
#include "server/http/target.h"

namespace wellspaced::http {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLinger{2000};
constexpr std::size_t kProgressBytes = 64u << 10;
constexpr std::size_t kReadBytes = 64u << 10;
constexpr std::size_t kStreamBacklogBytes = 1u << 20;
// Reads of one connection before the others get their turn.
constexpr int kReadsPerTurn = 16;
constexpr std::size_t kWriteBytesPerTurn = 2u << 20;

}  // namespace

void Hub::advance(Connection& connection) {
  try {
    while (step(connection)) {
    }
  } catch (const std::exception&) {
    // Out of memory for this client must not end the service for the others.
    close(connection);
  }
}

// True if the state has changed and there may be more to do right away.
bool Hub::step(Connection& connection) {
  switch (connection.state) {
    case State::head:
      return read_head(connection);
    case State::body:
      return read_body(connection);
    case State::writing:
      return write(connection);
    case State::streaming:
    case State::lingering:
      return discard_input(connection);
    case State::waiting:
      return poll_pending(connection), false;
    case State::handling:
    case State::closed:
      return false;
  }
  return false;
}

bool Hub::read_head(Connection& connection) {
  for (;;) {
    // One empty line before a request line is forgiven (RFC 9112, 2.2).
    if (connection.scanned <= 1 && connection.in.starts_with("\r\n")) {
      connection.in.erase(0, 2);
      connection.scanned = 0;
    }
    HeadScan scan = scan_head(connection.in, connection.scanned, limits_);
    connection.scanned = connection.in.size();
    if (scan.problem) return refuse(connection, *scan.problem);
    if (scan.end > 0) return begin_request(connection, scan.end);
    if (!connection.readable) return false;
    const bool idle = connection.in.empty();
    const Io io = receive(connection.socket.get(), connection.in, kReadBytes);
    if (io == Io::blocked) connection.readable = false;
    if (io == Io::failed) return close(connection), false;
    // One deadline for the whole block, from its first byte: feeding it byte by byte gains nothing.
    if (io == Io::partial && idle) connection.deadline = now_ + milliseconds(options_.header_timeout_ms);
  }
}

bool Hub::begin_request(Connection& connection, std::size_t head_size) {
  connection.started = now_;
  connection.exchange.bytes_in = head_size;
  auto vetted = vet_head(std::string_view(connection.in).substr(0, head_size), limits_);
  connection.in.erase(0, head_size);
  if (const auto* problem = std::get_if<Problem>(&vetted)) return refuse(connection, *problem);
  connection.head = std::move(std::get<Head>(vetted));
  Request& request = connection.request;
  request.method = connection.head.method;
  request.headers = std::move(connection.head.headers);
  request.id = request_id(request.header("X-Request-Id"));
  auto target = parse_target(connection.head.target);
  if (const auto* problem = std::get_if<Problem>(&target)) return refuse(connection, *problem);
  auto& parts = std::get<Target>(target);
  request.target = std::move(parts.text);
  request.path = std::move(parts.path);
  request.segments = std::move(parts.segments);
  request.query = std::move(parts.query);
  if (connection.head.expects_continue && connection.in.empty()) {
    constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    // Nothing else is in the send buffer, so it fits; a client that got half of it has gone.
    send(connection.socket.get(), kContinue.data(), kContinue.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  connection.gone = std::make_shared<std::atomic<bool>>(false);
  request.gone = connection.gone;
  connection.state = State::body;
  connection.progress_mark = 0;
  connection.deadline = now_ + milliseconds(options_.body_timeout_ms);
  return true;
}

bool Hub::read_body(Connection& connection) {
  std::string& body = connection.request.body;
  const std::size_t length = connection.head.content_length;
  const std::size_t buffered = std::min(length - body.size(), connection.in.size());
  body.append(connection.in, 0, buffered);
  connection.in.erase(0, buffered);
  for (int reads = 0; body.size() < length; ++reads) {
    put_off(connection, body.size(), options_.body_timeout_ms);
    if (!connection.readable) return false;
    if (reads == kReadsPerTurn) return enqueue(connection), false;
    const Io io = receive(connection.socket.get(), body, length - body.size());
    if (io == Io::blocked) connection.readable = false;
    if (io == Io::failed) return close(connection), false;
  }
  connection.exchange.bytes_in += length;
  dispatch(connection);
  return false;
}

void Hub::dispatch(Connection& connection) {
  connection.state = State::handling;
  callbacks_.dispatch(connection);
}

// Slowness is allowed, standing still is not.
void Hub::put_off(Connection& connection, std::size_t moved, int timeout_ms) {
  if (moved < connection.progress_mark + kProgressBytes) return;
  connection.progress_mark = moved;
  connection.deadline = now_ + milliseconds(timeout_ms);
}

bool Hub::write(Connection& connection) {
  switch (flush(connection, kWriteBytesPerTurn)) {
    case Io::done:
      return finish(connection);
    case Io::partial:
      put_off(connection, connection.sent, options_.write_timeout_ms);
      enqueue(connection);
      return false;
    case Io::blocked:
      put_off(connection, connection.sent, options_.write_timeout_ms);
      return false;
    case Io::failed:
      close(connection);
      return false;
  }
  return false;
}

bool Hub::finish(Connection& connection) {
  if (connection.events && !draining_) {
    connection.state = State::streaming;
    connection.deadline = Clock::time_point::max();
    poll_stream(connection);
    return true;
  }
  report(connection);
  if (connection.close_after || connection.events) return hang_up(connection), true;
  reset_exchange(connection);
  connection.state = State::head;
  connection.deadline =
      now_ + milliseconds(connection.in.empty() ? options_.idle_timeout_ms : options_.header_timeout_ms);
  if (!draining_) return true;
  connection.readable = true;  // it was promised that it may send another request, and may have by now
  read_head(connection);
  if (connection.state == State::head && connection.in.empty()) hang_up(connection);
  return true;
}

// What a peer sends now is of no interest, but its end is.
bool Hub::discard_input(Connection& connection) {
  std::string ignored;
  for (int reads = 0; connection.readable; ++reads) {
    if (reads == kReadsPerTurn) return enqueue(connection), false;
    ignored.clear();
    const Io io = receive(connection.socket.get(), ignored, kReadBytes);
    if (io == Io::blocked) connection.readable = false;
    if (io == Io::failed) return close(connection), false;
  }
  if (connection.state == State::streaming && flush(connection, kWriteBytesPerTurn) == Io::failed)
    close(connection);
  return false;
}

bool Hub::refuse(Connection& connection, const Problem& problem) {
  Request& request = connection.request;
  if (request.id.empty()) request.id = request_id({});
  Response response = to_response(problem, request.id);
  const ReplyContext context{request.id, true, false};
  connection.out_head = engine_.exchange("GET / HTTP/1.1", [&] { return reply_head(response, context); });
  connection.out_body = std::move(response.body);
  connection.sent = 0;
  connection.close_after = true;
  Exchange& exchange = connection.exchange;
  exchange.id = request.id;
  exchange.method = connection.head.method;
  exchange.target = connection.head.target;
  exchange.status = problem.status;
  if (connection.started == Clock::time_point()) connection.started = now_;
  connection.state = State::writing;
  connection.progress_mark = 0;
  connection.deadline = now_ + milliseconds(options_.write_timeout_ms);
  return true;
}

// A plain close would answer bytes that are still under way with a reset, and the reset would eat the
// response.
void Hub::hang_up(Connection& connection) {
  shutdown(connection.socket.get(), SHUT_WR);
  connection.events.reset();
  connection.state = State::lingering;
  connection.readable = true;
  connection.deadline = now_ + kLinger;
}

void Hub::close(Connection& connection) {
  if (connection.exchange.status != 0) report(connection);
  const auto found = connections_.find(&connection);
  if (found == connections_.end()) return;
  if (connection.surplus) --surplus_;
  std::erase(queue_, &connection);
  connection.state = State::closed;
  connection.events.reset();
  // Said explicitly: where the process has just forked, closing our descriptor alone does not end its events,
  // and they would point to a connection that is no more.
  epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, connection.socket.get(), nullptr);
  connection.socket.reset();
  graveyard_.push_back(std::move(found->second));
  connections_.erase(found);
}

void Hub::report(Connection& connection) {
  if (connection.reported) return;
  connection.reported = true;
  connection.exchange.seconds = std::chrono::duration<double>(now_ - connection.started).count();
  connection.exchange.bytes_out += connection.sent;
  if (callbacks_.on_exchange) callbacks_.on_exchange(connection.exchange);
}

// Pipelined requests stay in the socket's buffer meanwhile: only the peer's end is looked for.
void Hub::poll_pending(Connection& connection) {
  connection.abandoned = peer_closed(connection.socket.get());
  if (connection.abandoned || connection.pending->ready()) dispatch(connection);
}

void Hub::poll_stream(Connection& connection) {
  std::optional<std::string> bytes;
  try {
    bytes = connection.events->poll();
  } catch (const std::exception&) {
    // A source that fails ends its stream; the client reconnects and asks again.
  }
  if (bytes && bytes->empty() && connection.unsent() == 0) return;
  drop_sent(connection);
  if (bytes) connection.out_body += *bytes;
  const Io io = flush(connection, SIZE_MAX);
  if (io == Io::failed || connection.unsent() > kStreamBacklogBytes) return close(connection);
  if (bytes) return;
  // The source is over: what is left goes out like any other response.
  connection.events.reset();
  connection.close_after = true;
  connection.state = State::writing;
  connection.progress_mark = connection.sent;
  connection.deadline = now_ + milliseconds(options_.write_timeout_ms);
}

}  // namespace wellspaced::http
