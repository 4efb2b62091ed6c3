// SPDX-License-Identifier: MIT
// Thresholds of the detection, set while the simulator runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"

namespace splash::tests {
namespace {

using protocol::Message;
using testing::HasSubstr;

constexpr double kTimeout = 20.0;  ///< [s]
constexpr const char* kRow = "detect/impact_speed";

/// Somebody who asked for events.
class Client {
 public:
  explicit Client(const protocol::Endpoint& simulator) {
    socket_.send_to(simulator, protocol::encode({"/notify", {1, std::string(64, 'x')}}));
  }
  /// The next message at this address within so many seconds.
  std::optional<Message> hear(const std::string& address, double seconds) {
    const double end = protocol::monotonic_now() + seconds;
    std::vector<std::byte> bytes(2048);
    while (protocol::monotonic_now() < end) {
      const auto got = socket_.receive(bytes.data(), bytes.size(), 0.1);
      if (!got) continue;
      for (auto& message :
           protocol::decode(protocol::Bytes(bytes).first(got->size)).packet.messages) {
        if (message.address == address) return std::move(message);
      }
    }
    return std::nullopt;
  }

 private:
  protocol::UdpSocket socket_{protocol::Endpoint{INADDR_LOOPBACK, 0}};
};

std::string reason_of(const Message& reply) {
  EXPECT_EQ(reply.address, "/fail");
  return reply.arguments.size() < 2 ? "" : std::get<std::string>(reply.arguments[1]);
}

TEST(Param, AThresholdHoldsFromTheNextFrameOnAndIsTold) {
  const SmallScene scene(plunging());
  Simulator simulator({"--scene", scene.path()});
  Client client(simulator.endpoint());
  EXPECT_EQ(simulator.ask({"/param", {kRow}}, "/value"), protocol::value_of(kRow, 0.05));
  EXPECT_TRUE(client.hear("/impact", kTimeout)) << "a disc that plunges once a second";

  EXPECT_EQ(simulator.ask({"/param", {kRow, 10.0F}}, "/value"), protocol::value_of(kRow, 10.0));
  const auto told = client.hear("/value", kTimeout);
  ASSERT_TRUE(told);
  EXPECT_EQ(*told, protocol::value_of(kRow, 10.0));
  EXPECT_FALSE(client.hear("/impact", 1.5)) << "nothing is as fast";

  EXPECT_EQ(simulator.ask({"/param", {kRow, 0.05F}}, "/value").address, "/value");
  EXPECT_TRUE(client.hear("/impact", kTimeout)) << "it is as before";
}

TEST(Param, WhatTheTableDoesNotAllowIsRefusedWithItsRange) {
  const SmallScene scene(tracked());
  Simulator simulator({"--scene", scene.path()});
  EXPECT_THAT(reason_of(simulator.ask({"/param", {kRow, 11.0F}}, "/fail")),
              HasSubstr("11 m/s, allowed 0 to 10"));
  EXPECT_THAT(reason_of(simulator.ask({"/param", {"detect/radius_max", 0.001F}}, "/fail")),
              HasSubstr("not above radius_min"));
  EXPECT_THAT(reason_of(simulator.ask({"/param", {"detect/bubble_sped", 1.0F}}, "/fail")),
              HasSubstr("did you mean detect/bubble_speed?"));
  EXPECT_THAT(reason_of(simulator.ask({"/param", {"fluid/viscosity"}}, "/fail")),
              HasSubstr("no live row"));
  EXPECT_EQ(simulator.ask({"/param", {kRow}}, "/value"), protocol::value_of(kRow, 0.05));
}

}  // namespace
}  // namespace splash::tests
