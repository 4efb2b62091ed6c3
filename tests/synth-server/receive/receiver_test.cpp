// SPDX-License-Identifier: MIT
// The receiving thread behind a real socket: killers and floods pass, valid events arrive.
#include "synth-server/receive/receiver.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/protocol/killers.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::Endpoint;
using protocol::Message;
using tests::eventually;

constexpr Endpoint kAnyPort{INADDR_LOOPBACK, 0};

class ReceiverTest : public testing::Test {
 protected:
  ReceiverTest()
      : receiver_(protocol::UdpSocket(kAnyPort), queue_,
                  {.print = [this](const std::string&) { ++lines_; }}, {}) {}

  void send(const std::vector<std::byte>& bytes) { socket_.send_to(receiver_.local(), bytes); }

  /// The next datagram that comes to us.
  Message reply() {
    std::vector<std::byte> buffer(2048);
    const auto received = socket_.receive(buffer.data(), buffer.size(), 20.0);
    if (!received) return {"nothing", {}};
    const auto decoded = protocol::decode({buffer.data(), received->size});
    return decoded.packet.messages.empty() ? Message{} : decoded.packet.messages.front();
  }

  std::atomic<int> lines_{0};
  CommandQueue queue_;
  protocol::UdpSocket socket_{kAnyPort};
  Receiver receiver_;
};

Message bubble(int id) {
  return protocol::to_message(protocol::Bubble{id, 0, 0.005F, 0.1F, {0.0F, 0.0F, 0.0F}, 0.0F});
}

TEST_F(ReceiverTest, OutlivesEveryKillerAndCountsIt) {
  const double begun = protocol::monotonic_now();
  const auto& all = protocol::test::killers();
  IntakeCounters expected;
  for (const protocol::test::Killer& killer : all) {
    send(killer.bytes);
    ++expected.refusals[static_cast<std::size_t>(killer.why)];
    send(protocol::encode(bubble(1)));
  }
  ASSERT_TRUE(eventually([&] { return receiver_.counters().datagrams == 2 * all.size(); }));
  const IntakeCounters counters = receiver_.counters();
  expected.refusals[0] = 0;  // accepted
  EXPECT_EQ(counters.refusals, expected.refusals) << "each by its reason";
  EXPECT_EQ(counters.events, all.size() + 3) << "and three bubbles at odd times";
  EXPECT_GE(lines_, 1);
  EXPECT_LE(lines_, protocol::monotonic_now() - begun + 11.0) << "ten, and one a second";
  send(protocol::encode(Message{"/sync", {5}}));
  Message answer = reply();
  while (answer.address == "/fail" || answer.address == "/ping") answer = reply();
  EXPECT_EQ(answer, (Message{"/synced", {5}}));
}

TEST_F(ReceiverTest, PicksTheEventsOutOfAFlood) {
  std::mt19937 random(1);
  std::uint64_t sent = 0;
  for (int burst = 0; burst < 20; ++burst) {
    for (int i = 0; i < 100; ++i) {
      std::vector<std::byte> noise(random() % 1500);
      for (auto& byte : noise) byte = static_cast<std::byte>(random() & 0xFFU);
      send(noise);
    }
    send(protocol::encode(bubble(burst)));
    sent += 101;
    ASSERT_TRUE(eventually([&] { return receiver_.counters().datagrams == sent; }));
  }
  EXPECT_EQ(receiver_.counters().events, 20U);
}

TEST_F(ReceiverTest, SaysGoodbyeToItsClients) {
  {
    const Receiver receiver(protocol::UdpSocket(kAnyPort), queue_, {}, {});
    socket_.send_to(receiver.local(), protocol::encode(Message{"/notify", {1}}));
    EXPECT_EQ(reply().address, "/done");
  }
  EXPECT_EQ(reply(), protocol::done("/quit"));
}

TEST_F(ReceiverTest, DumpsPacketsWhenAsked) {
  send(protocol::encode(Message{"/dumpOSC", {3}}));
  ASSERT_EQ(reply().address, "/done");
  send(protocol::encode(bubble(1)));
  EXPECT_TRUE(eventually([&] { return lines_ == 2; })) << "in both forms";
}

}  // namespace
}  // namespace splash::synth
