// SPDX-License-Identifier: MIT
// A browser that the test plays, byte by byte: what it says to view-server and what it hears.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <utility>

#include "protocol/udp_socket.hpp"

namespace splash::tests {

class Browser {
 public:
  explicit Browser(const protocol::Endpoint& where) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(where.address);
    address.sin_port = htons(where.port);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~Browser() { close(descriptor_); }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  bool say(const std::string& bytes) const {
    return send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// What comes until `text` did, or the end, or so long a silence [ms].
  std::string hear(const std::string& text, int silence = 5000) {
    pollfd readable{descriptor_, POLLIN, 0};
    while (heard_.find(text) == std::string::npos && poll(&readable, 1, silence) > 0) {
      std::array<char, 65536> buffer;
      const ssize_t count = recv(descriptor_, buffer.data(), buffer.size(), 0);
      if (count <= 0) break;
      heard_.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return std::exchange(heard_, {});
  }

 private:
  int descriptor_;
  std::string heard_;
};

/// What a page says first, to become a viewer.
inline std::string upgrade(const std::string& host, const std::string& origin) {
  return "GET /view HTTP/1.1\r\nHost: " + host + "\r\nOrigin: " + origin +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

}  // namespace splash::tests
