#include "server/http/connection.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <random>

#include <sys/socket.h>
#include <sys/uio.h>

namespace wellspaced::http {
namespace {

// Unique, not secret: a random prefix per process and a count.
std::string new_request_id() {
  static const std::uint64_t prefix = [] {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
  }();
  static std::atomic<std::uint32_t> count = 0;
  std::array<char, 32> text{};
  const int size = std::snprintf(text.data(), text.size(), "%016llx%08x",
                                 static_cast<unsigned long long>(prefix), ++count);
  return {text.data(), static_cast<std::size_t>(size)};
}

}  // namespace

Io flush(Connection& connection, std::size_t budget) {
  const std::size_t stop = connection.sent + std::min(budget, connection.unsent());
  while (connection.sent < stop) {
    const std::size_t head_size = connection.out_head.size();
    const std::size_t head_sent = std::min(connection.sent, head_size);
    const std::size_t body_sent = connection.sent - head_sent;
    const std::size_t body_count = std::min(connection.out_body.size() - body_sent, stop - connection.sent);
    std::array<iovec, 2> parts{{{connection.out_head.data() + head_sent, head_size - head_sent},
                                {connection.out_body.data() + body_sent, body_count}}};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    const ssize_t count = sendmsg(connection.socket.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK ? Io::blocked : Io::failed;
    connection.sent += static_cast<std::size_t>(count);
  }
  return connection.unsent() == 0 ? Io::done : Io::partial;
}

void drop_sent(Connection& connection) {
  constexpr std::size_t kWorthIt = 64u << 10;
  const std::size_t head_size = connection.out_head.size();
  if (connection.unsent() > 0 && connection.sent < head_size + kWorthIt) return;
  connection.exchange.bytes_out += connection.sent;
  connection.out_body.erase(0, connection.sent - head_size);
  connection.out_head.clear();
  connection.sent = 0;
}

Io receive(int fd, std::string& into, std::size_t limit) {
  std::array<char, 64u << 10> buffer;
  for (;;) {
    const ssize_t count = recv(fd, buffer.data(), std::min(limit, buffer.size()), MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN || errno == EWOULDBLOCK ? Io::blocked : Io::failed;
    if (count == 0) return Io::failed;
    into.append(buffer.data(), static_cast<std::size_t>(count));
    return Io::partial;
  }
}

void reset_exchange(Connection& connection) {
  connection.head = {};
  connection.request = {};
  connection.exchange = {};
  connection.started = {};
  connection.out_head.clear();
  connection.out_body = {};
  connection.sent = 0;
  connection.scanned = 0;
  connection.reported = false;
  connection.pending_route.clear();
}

std::string request_id(std::string_view offered) {
  const bool sane =
      !offered.empty() && offered.size() <= 64 && std::all_of(offered.begin(), offered.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
               c == '_' || c == '-';
      });
  return sane ? std::string(offered) : new_request_id();
}

}  // namespace wellspaced::http
