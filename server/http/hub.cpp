#include "server/http/hub.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

namespace wellspaced::http {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{200};
// A burst of wake() must not make the hub poll 1500 sources once for each.
constexpr milliseconds kPollGap{5};
// Connections above the limit that are still told 503; beyond them, there is only a close.
constexpr std::size_t kSurplusLimit = 512;
// Before those who are connected get their turn.
constexpr int kAcceptsPerTurn = 256;

Descriptor must(int fd, const char* what) {
  if (fd < 0)
    throw Error(ErrorCode::internal, std::string("can't create ") + what + ": " + std::strerror(errno) +
                                         "; raise the limit of open files (ulimit -n)");
  return Descriptor(fd);
}

HeadLimits head_limits(const GuardOptions& options) {
  return {options.header_limit_bytes, options.header_limit_lines, options.target_limit_bytes,
          options.body_limit_bytes};
}

}  // namespace

Hub::Hub(const GuardOptions& options, Callbacks callbacks)
    : options_(options),
      limits_(head_limits(options)),
      callbacks_(std::move(callbacks)),
      epoll_(must(epoll_create1(EPOLL_CLOEXEC), "an epoll instance")),
      bell_(must(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "an eventfd")) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = &bell_;
  epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, bell_.get(), &event);
}

void Hub::ring() {
  if (rung_.exchange(true)) return;
  const std::uint64_t one = 1;
  // It can fail only when the counter is full, and then the bell is ringing anyway.
  [[maybe_unused]] const ssize_t written = ::write(bell_.get(), &one, sizeof one);
}

void Hub::give_back(Connection& connection) {
  {
    const std::lock_guard lock(returned_mutex_);
    returned_.push_back(&connection);
  }
  ring();
}

void Hub::wake() {
  wake_requested_ = true;
  ring();
}

void Hub::stop() {
  stop_requested_ = true;
  ring();
}

void Hub::run(Descriptor listener) {
  listener_ = std::move(listener);
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = &listener_;
  epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, listener_.get(), &event);
  now_ = last_poll_ = Clock::now();
  next_tick_ = now_ + kTick;
  for (;;) {
    if (stop_requested_ && !draining_) begin_drain();
    if (draining_ && connections_.empty()) return;
    wait();
    take_returned();
    run_queue();
    if (now_ >= next_tick_) tick();
    if (wake_requested_.exchange(false)) poll_wanted_ = true;
    if (poll_wanted_ && now_ - last_poll_ >= kPollGap) poll_streams();
    graveyard_.clear();
  }
}

int Hub::wait_ms() const {
  if (!queue_.empty()) return 0;
  if (poll_wanted_) return static_cast<int>(kPollGap.count());
  if (connections_.empty() && !accept_paused_) return -1;
  const auto left = std::chrono::ceil<milliseconds>(next_tick_ - Clock::now());
  return static_cast<int>(std::clamp<milliseconds::rep>(left.count(), 0, kTick.count()));
}

void Hub::wait() {
  std::array<epoll_event, 256> events;
  const int count = epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), wait_ms());
  now_ = Clock::now();
  for (int i = 0; i < count; ++i) note_event(events[static_cast<std::size_t>(i)]);
}

void Hub::note_event(const epoll_event& event) {
  if (event.data.ptr == &listener_) return accept_all();
  if (event.data.ptr == &bell_) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(bell_.get(), &count, sizeof count);
    // Only after the read, or a ring in between would be read away with rung_ left true: deaf for good. What
    // was asked for up to here is found later in this turn.
    rung_ = false;
    return;
  }
  auto& connection = *static_cast<Connection*>(event.data.ptr);
  if ((event.events & ~static_cast<std::uint32_t>(EPOLLOUT)) != 0) connection.readable = true;
  enqueue(connection);
}

void Hub::enqueue(Connection& connection) {
  if (connection.queued || connection.state == State::handling || connection.state == State::closed) return;
  connection.queued = true;
  queue_.push_back(&connection);
}

void Hub::take_returned() {
  std::vector<Connection*> returned;
  {
    const std::lock_guard lock(returned_mutex_);
    returned.swap(returned_);
  }
  for (Connection* connection : returned) {
    if (connection->abandoned) {
      connection->state = State::writing;  // nobody is there to write to
      close(*connection);
      continue;
    }
    if (connection->pending) {
      connection->state = State::waiting;
      connection->deadline = Clock::time_point::max();
      poll_wanted_ = true;  // it may have become ready in between
      continue;
    }
    connection->state = State::writing;
    connection->progress_mark = connection->sent;
    connection->deadline = now_ + milliseconds(options_.write_timeout_ms);
    enqueue(*connection);
  }
}

void Hub::run_queue() {
  std::vector<Connection*> queue;
  queue.swap(queue_);
  for (Connection* connection : queue) {
    connection->queued = false;
    advance(*connection);
  }
}

void Hub::accept_all() {
  for (int turn = 0; turn < kAcceptsPerTurn; ++turn) {
    Descriptor socket(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket) {
      adopt(std::move(socket));
      continue;
    }
    if (errno == EAGAIN || errno == EWOULDBLOCK) return;
    if (errno != EMFILE && errno != ENFILE && errno != ENOBUFS && errno != ENOMEM)
      continue;  // one client's trouble
    // Without descriptors, the waiting client would make epoll spin: look again at the next tick.
    epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, listener_.get(), nullptr);
    accept_paused_ = true;
    return;
  }
}

void Hub::adopt(Descriptor socket) {
  if (surplus_ >= kSurplusLimit) return;
  const bool full = connections_.size() - surplus_ >= options_.connection_limit;
  const int yes = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  auto owned = std::make_unique<Connection>(std::move(socket));
  Connection& connection = *owned;
  connection.deadline = now_ + milliseconds(options_.idle_timeout_ms);
  epoll_event event{};
  event.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | static_cast<std::uint32_t>(EPOLLET);
  event.data.ptr = &connection;
  if (epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, connection.socket.get(), &event) != 0) return;
  connections_.emplace(&connection, std::move(owned));
  if (!full) return;
  connection.surplus = true;
  ++surplus_;
  refuse(connection, http_problem(503, "all " + std::to_string(options_.connection_limit) +
                                           " connections are taken; try again in a moment"));
  enqueue(connection);
}

void Hub::tick() {
  next_tick_ = now_ + kTick;
  poll_wanted_ = true;
  std::vector<Connection*> late;
  for (const auto& [connection, owned] : connections_) {
    if (connection->state == State::handling) {
      if (peer_closed(connection->socket.get())) *connection->gone = true;
    } else if (now_ > connection->deadline || (draining_ && now_ > drain_deadline_)) {
      late.push_back(connection);
    }
  }
  for (Connection* connection : late) expire(*connection);
  if (!accept_paused_ || draining_) return;
  accept_paused_ = false;
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = &listener_;
  epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, listener_.get(), &event);
}

void Hub::expire(Connection& connection) {
  if (connection.state == State::waiting) {
    connection.abandoned = true;
    return dispatch(connection);
  }
  const bool reading =
      (connection.state == State::head && !connection.in.empty()) || connection.state == State::body;
  if (!reading) return close(connection);
  const bool in_head = connection.state == State::head;
  refuse(connection,
         http_problem(408, in_head ? "the header block did not arrive in time; send it in one piece"
                                   : "the body stopped arriving; send it without pauses"));
  advance(connection);
}

void Hub::poll_streams() {
  poll_wanted_ = false;
  last_poll_ = now_;
  std::vector<Connection*> streams, waiting;
  for (const auto& [connection, owned] : connections_) {
    if (connection->state == State::streaming) streams.push_back(connection);
    if (connection->state == State::waiting) waiting.push_back(connection);
  }
  for (Connection* connection : streams) {
    poll_stream(*connection);
    advance(*connection);
  }
  for (Connection* connection : waiting) poll_pending(*connection);
}

void Hub::begin_drain() {
  draining_ = true;
  accept_all();  // they were promised a connection; their requests still get an answer
  listener_.reset();
  drain_deadline_ = now_ + milliseconds(options_.drain_timeout_ms);
  std::vector<Connection*> all;
  for (const auto& [connection, owned] : connections_) all.push_back(connection);
  for (Connection* connection : all) {
    if (connection->state == State::streaming) {
      connection->events.reset();
      connection->close_after = true;
      connection->state = State::writing;
      connection->progress_mark = connection->sent;
      connection->deadline = now_ + milliseconds(options_.write_timeout_ms);
    }
    if (connection->state == State::head) connection->readable = true;  // a request may have come just now
    advance(*connection);
    if (connection->state == State::head && connection->in.empty()) close(*connection);
  }
}

}  // namespace wellspaced::http
