// SPDX-License-Identifier: MIT
// A receiver's pings are answered where the events come from, with stamps of the simulator's clock.
#include "sim-server/send/clock_answers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/sim-server/send/peer.hpp"

namespace splash::sim {
namespace {

class ClockAnswersTest : public testing::Test {
 protected:
  test::Peer receiver;
  Targets targets{{receiver.endpoint()}};
  protocol::UdpSocket events{protocol::Endpoint{}};
  ClockAnswers answers{events, targets};

  /// The pongs counted once their thread, which counts after it has sent, got round to it.
  std::uint64_t answered() {
    const double given_up = protocol::monotonic_now() + test::kPatience;
    while (answers.answered() == 0 && protocol::monotonic_now() < given_up)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
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
  const ClockAnswers answers(events, targets);
  stranger.send(events.local(), protocol::ping(protocol::TimeTag{7}));
  EXPECT_FALSE(stranger.bytes(0.3));
}

}  // namespace
}  // namespace splash::sim
