// SPDX-License-Identifier: MIT
// The very datagrams of sd_notify(3), read from the socket that they were sent to.
#include "program/service_notice.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace splash::program {
namespace {

/// The service manager's end, at an address of the abstract namespace that the kernel chooses.
class Manager {
 public:
  Manager() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    socklen_t size = sizeof at.sun_family;
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&at), size) != 0) {
      throw std::runtime_error("no socket to be bound");
    }
    size = sizeof at;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size);
    const std::string name(at.sun_path + 1, size - sizeof at.sun_family - 1);
    setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  }
  ~Manager() { close(socket_); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  /// What came next, empty: nothing.
  [[nodiscard]] std::string next() const {
    std::array<char, 256> text{};
    const ssize_t size = recv(socket_, text.data(), text.size(), 0);
    return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
  }

 private:
  int socket_;
};

TEST(ServiceNotice, AsksForMoreTimeInMicroseconds) {
  const Manager manager;
  ServiceNotice service;
  service.starting(90.5);
  EXPECT_EQ(manager.next(), "EXTEND_TIMEOUT_USEC=90500000");
  EXPECT_EQ(manager.next(), "");
}

TEST(ServiceNotice, IsReadyOnceItSaysSo) {
  const Manager manager;
  ServiceNotice service;
  EXPECT_EQ(manager.next(), "");
  service.ready("pool");
  EXPECT_EQ(manager.next(), "READY=1\nSTATUS=pool");
  service.stopping();
  EXPECT_EQ(manager.next(), "STOPPING=1");
}

// Programs that this one starts are not to speak for it.
TEST(ServiceNotice, TakesTheSocketOutOfTheEnvironment) {
  const Manager manager;
  const ServiceNotice service;
  EXPECT_EQ(std::getenv("NOTIFY_SOCKET"), nullptr);
}

TEST(ServiceNotice, WithoutAManagerSaysNothing) {
  unsetenv("NOTIFY_SOCKET");
  ServiceNotice service;
  testing::internal::CaptureStderr();
  service.starting(1.0);
  service.ready("pool");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace splash::program
