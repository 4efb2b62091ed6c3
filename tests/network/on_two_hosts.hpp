// SPDX-License-Identifier: MIT
// What tests on two hosts share: the programs there, and questions to them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "protocol/message.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/programs.hpp"

namespace splash::network {

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
