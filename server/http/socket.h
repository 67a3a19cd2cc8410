#pragma once

#include <string>
#include <utility>

namespace wellspaced::http {

/// A file descriptor with one owner.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void reset();

 private:
  int fd_;
};

/// A non-blocking listening socket on the first address of `host` (IPv4, IPv6 or a name; empty or "*": all)
/// that can be bound. SO_REUSEADDR, never SO_REUSEPORT, so a second server on a taken port fails; backlog
/// 1024. Errors: Error{internal} with host, port and the reason.
Descriptor open_listener(const std::string& host, int port);

/// The port a socket is bound to.
int bound_port(const Descriptor& socket);

/// True once the peer has closed its side. Bytes that nobody has read yet hide that.
bool peer_closed(int fd);

}  // namespace wellspaced::http
