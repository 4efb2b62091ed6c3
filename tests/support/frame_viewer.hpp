// SPDX-License-Identifier: MIT
// A viewer of the frames that a program shows over TCP (protocol/frame_stream.hpp).
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "protocol/frame.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::tests {

class FrameViewer {
 public:
  /// `receive_buffer`: of the kernel [bytes]; 0: its own choice.
  explicit FrameViewer(const protocol::Endpoint& where, int receive_buffer = 0)
      : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(where.address);
    address.sin_port = htons(where.port);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~FrameViewer() { close(descriptor_); }
  FrameViewer(const FrameViewer&) = delete;
  FrameViewer& operator=(const FrameViewer&) = delete;

  void ask(std::size_t times = 1) const {
    const std::string bytes(times, '.');
    EXPECT_EQ(send(descriptor_, bytes.data(), times, MSG_NOSIGNAL), static_cast<ssize_t>(times));
  }
  [[nodiscard]] bool has_more(int milliseconds = 100) const {
    pollfd readable{descriptor_, POLLIN, 0};
    return poll(&readable, 1, milliseconds) > 0;
  }
  /// Empty: no whole frame came, and nothing for ten seconds.
  [[nodiscard]] protocol::ViewFrame read() const {
    protocol::ViewFrame frame(protocol::kFrameHead);
    if (!take(frame.data(), frame.size())) return {};
    const auto size = protocol::frame_number<std::uint32_t>(&frame[4]);
    if (size < protocol::kFrameHead || size > protocol::kLargestFrame) return {};
    frame.resize(size);
    if (!take(frame.data() + protocol::kFrameHead, size - protocol::kFrameHead)) return {};
    return frame;
  }

 private:
  bool take(std::byte* to, std::size_t size) const {
    while (size > 0) {
      const ssize_t count = has_more(10'000) ? recv(descriptor_, to, size, 0) : ssize_t{0};
      if (count <= 0) return false;
      to += count;
      size -= static_cast<std::size_t>(count);
    }
    return true;
  }
  int descriptor_;
};

}  // namespace splash::tests
