// SPDX-License-Identifier: MIT
// Two hosts on one machine: network namespaces of their own, joined by a virtual cable. Needs the
// rights of an administrator and the program `ip`; says so where it has not.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/programs.hpp"

namespace splash::network {

class TwoHosts {
 public:
  /// nullopt in its place when they cannot be had; why() then says what is missing.
  TwoHosts();
  ~TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  /// Empty: both are there.
  [[nodiscard]] const std::string& why_not() const { return why_not_; }

  /// 0 or 1: the first has 10.77.0.1 and 10.77.0.3, the second 10.77.0.2.
  [[nodiscard]] std::vector<std::string> command_on(int host,
                                                    std::vector<std::string> command) const;
  /// A socket that sends and listens there.
  [[nodiscard]] protocol::UdpSocket socket_on(int host, const std::string& endpoint) const;
  /// Sends `payload` from there with any address, which may be another host's, as its sender's.
  void send_forged(int host, const protocol::Endpoint& sender, const protocol::Endpoint& to,
                   protocol::Bytes payload) const;
  /// Datagrams and whatever else came there over the cable so far.
  [[nodiscard]] std::uint64_t received_on(int host) const;
  /// What listens there on UDP, as /proc/net/udp has it: "0100007F:DFF3".
  [[nodiscard]] std::vector<std::string> listening_on(int host) const;

 private:
  [[nodiscard]] std::string name(int host) const;
  std::string why_not_;
};

inline constexpr int kSimHost = 0;
inline constexpr int kSynthHost = 1;

/// Skips its tests, with the reason, where there are no network namespaces.
class OnTwoHosts : public testing::Test {
 protected:
  void SetUp() override {
    if (!hosts_.why_not().empty()) {
      GTEST_SKIP() << "no network namespaces here (they need root and iproute2): "
                   << hosts_.why_not();
    }
  }

  [[nodiscard]] std::unique_ptr<tests::ChildProcess> start(
      int host, const std::string& program, const tests::Arguments& arguments) const {
    return std::make_unique<tests::ChildProcess>(
        hosts_.command_on(host, tests::command(program, arguments)));
  }
  [[nodiscard]] std::unique_ptr<tests::ChildProcess> start_synth(
      const tests::Arguments& more) const {
    tests::Arguments arguments{"--rig", tests::rig_path("stereo.yaml"), "--device", "null"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto synth = start(kSynthHost, "synth-server", arguments);
    EXPECT_TRUE(synth->wait_for_text("listening: ")) << synth->output();
    return synth;
  }
  static protocol::Message answer_to(const protocol::Message& question, protocol::UdpSocket& socket,
                                     const std::string& to, double limits) {
    socket.send_to(protocol::parse_endpoint(to, 0), protocol::encode(question));
    std::array<std::byte, 2048> buffer{};
    const auto received = socket.receive(buffer.data(), buffer.size(), limits);
    if (!received) return {"no answer", {}};
    return protocol::decode(protocol::Bytes(buffer).first(received->size)).packet.messages.at(0);
  }

  TwoHosts hosts_;
};

}  // namespace splash::network
