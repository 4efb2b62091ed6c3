// SPDX-License-Identifier: MIT
#include "tests/system/notify_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"

namespace splash::tests {
namespace {

int sockets = 0;

}  // namespace

NotifySocket::NotifySocket(bool abstract)
    : address_(temporary_path("notify-" + std::to_string(++sockets))),
      socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (abstract) address_ = "@splash" + address_;
  sockaddr_un at{};
  at.sun_family = AF_UNIX;
  std::memcpy(at.sun_path, address_.data(), address_.size());
  if (abstract) at.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&at), size) != 0) {
    throw std::runtime_error("cannot bind " + address_ + ": " + std::strerror(errno));
  }
}

NotifySocket::~NotifySocket() {
  close(socket_);
  if (address_.front() != '@') unlink(address_.c_str());
}

std::string NotifySocket::receive(double seconds) {
  pollfd readable{socket_, POLLIN, 0};
  if (poll(&readable, 1, static_cast<int>(1e3 * std::max(seconds, 0.0))) <= 0) return {};
  std::array<char, 1024> text{};
  const ssize_t size = recv(socket_, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

std::string NotifySocket::wait_for(const std::string& start, double seconds) {
  const double limit = protocol::monotonic_now() + seconds;
  for (double now = limit - seconds; now < limit; now = protocol::monotonic_now()) {
    std::string text = receive(limit - now);
    if (text.starts_with(start)) return text;
  }
  return {};
}

int NotifySocket::clear() {
  int count = 0;
  while (!receive(0.0).empty()) ++count;
  return count;
}

}  // namespace splash::tests
