// SPDX-License-Identifier: MIT
// A receiver's pings are answered where the events come from, with stamps of the simulator's clock.
#include "sim-server/listen/clock_answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>

#include "protocol/control.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/time_tag.hpp"
#include "tests/sim-server/send/peer.hpp"
#include "tests/support/own_address.hpp"
#include "tests/support/waiting.hpp"

namespace splash::sim {
namespace {

class ClockAnswersTest : public testing::Test {
 protected:
  test::Peer receiver;
  Targets targets{{receiver.endpoint()}};
  protocol::UdpSocket events{protocol::Endpoint{}};
  ClockAnswers answers{events, targets, nullptr};

  /// The pongs counted once their thread, which counts after it has sent, got round to it.
  std::uint64_t answered() {
    tests::eventually([&] { return answers.answered() > 0; }, test::kTimeout);
    return answers.answered();
  }
};

TEST_F(ClockAnswersTest, PongCarriesItsThreeStamps) {
  const double before = protocol::unix_now();
  const protocol::TimeTag asked{12345};
  receiver.send(events.local(), protocol::ping(asked));
  const protocol::Message pong = receiver.message();
  const double after = protocol::unix_now();
  ASSERT_EQ(pong.address, "/pong");
  EXPECT_EQ(receiver.last_sender(), events.local());
  EXPECT_EQ(std::get<protocol::TimeTag>(pong.arguments.at(0)), asked);
  constexpr double kTick = 1e-6;  // a time tag is a whole number of 2^-32 s [s]
  const double arrived =
      protocol::to_unix_seconds(std::get<protocol::TimeTag>(pong.arguments.at(1)));
  const double answered =
      protocol::to_unix_seconds(std::get<protocol::TimeTag>(pong.arguments.at(2)));
  EXPECT_GE(arrived, before - kTick);
  EXPECT_GE(answered, arrived);
  EXPECT_LE(answered, after + kTick);
}

TEST_F(ClockAnswersTest, AnswersNothingElse) {
  receiver.send(events.local(), protocol::Message{"/quit", {}});
  receiver.send(events.local(), protocol::Message{"/ping", {1}});
  receiver.send(events.local(), protocol::ping(protocol::TimeTag{7}));
  // In order: had another been answered, its answer would come first.
  const protocol::Message first = receiver.message();
  ASSERT_EQ(first.address, "/pong");
  EXPECT_EQ(std::get<protocol::TimeTag>(first.arguments.at(0)).value, 7U);
  EXPECT_EQ(answered(), 1U);
}

TEST(ClockAnswers, StrangersAreNotAnswered) {
  test::Peer stranger;
  const Targets targets({{.address = 0x7F000102, .port = 9}});  // 127.0.1.2 alone
  protocol::UdpSocket events{protocol::Endpoint{}};
  const ClockAnswers answers(events, targets, nullptr);
  stranger.send(events.local(), protocol::ping(protocol::TimeTag{7}));
  EXPECT_FALSE(stranger.bytes(0.3));
}

// A target on another host gets a /pong for as many bytes only.
TEST(ClockAnswers, APingOfAnotherHostMustBeAsLongAsItsPong) {
  const auto address = tests::own_address();
  if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
  test::Peer receiver(*address);
  protocol::UdpSocket events({.address = *address, .port = 0});
  const Targets targets({receiver.endpoint()});
  std::promise<std::string> told;
  const ClockAnswers answers(events, targets,
                             [&](const std::string& line) { told.set_value(line); });
  receiver.send(events.local(), protocol::ping(protocol::TimeTag{7}));
  receiver.send(events.local(), protocol::filled_up(protocol::ping(protocol::TimeTag{8}), 40));
  const auto answer = receiver.bytes();
  ASSERT_TRUE(answer && answer->size() == 40U);
  const auto pong = protocol::decode(*answer).packet.messages.at(0);
  EXPECT_EQ(std::get<protocol::TimeTag>(pong.arguments.at(0)).value, 8U) << "the first got none";
  EXPECT_EQ(answers.withheld(), 1U);
  auto line = told.get_future();
  ASSERT_EQ(line.wait_for(std::chrono::duration<double>(test::kTimeout)),
            std::future_status::ready);
  EXPECT_THAT(line.get(), testing::HasSubstr("asked /ping in a datagram of 20 bytes; "
                                             "the reply has 40 bytes"));
}

// Both pings of a bundle would draw 80 bytes for 64.
TEST(ClockAnswers, PingsOfABundleCountTogether) {
  const auto address = tests::own_address();
  if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
  test::Peer receiver(*address);
  protocol::UdpSocket events({.address = *address, .port = 0});
  const Targets targets({receiver.endpoint()});
  const ClockAnswers answers(events, targets, nullptr);
  const auto ping = protocol::ping(protocol::TimeTag{7});
  receiver.send(events.local(), protocol::encode({1}, {ping, ping}));
  EXPECT_TRUE(receiver.bytes());
  EXPECT_FALSE(receiver.bytes(0.3));
  EXPECT_EQ(answers.withheld(), 1U);
}

}  // namespace
}  // namespace splash::sim
