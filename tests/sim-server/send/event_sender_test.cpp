// SPDX-License-Identifier: MIT
// What a receiver gets, told on a clock that the test turns.
#include "sim-server/send/event_sender.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <variant>
#include <vector>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "tests/protocol/other_readers.hpp"
#include "tests/sim-server/send/peer.hpp"
#include "tests/sim-server/send/sample_events.hpp"

namespace splash::sim {
namespace {

using test::Peer;

constexpr double kOrigin = 1.7e9;  // Unix time of simulated second 0 [s]
constexpr double kTick = 1.0e-6;   // doubles near 1.7e9 are 0.24 us apart [s]

struct Heard {
  double time = 0.0;  // of the bundle, Unix [s]
  protocol::Frame frame;
  std::vector<protocol::Event> events;
};

double offset_ms(const protocol::Event& event) {
  return std::visit([](const auto& kind) { return static_cast<double>(kind.offset_ms); }, event);
}

class EventSenderTest : public testing::Test {
 protected:
  EventSender& sender() {
    if (!sender_) {
      settings.clock = [this] { return now; };
      sender_ = std::make_unique<EventSender>(targets, socket, nullptr, settings);
    }
    return *sender_;
  }
  static FrameTime frame(double seconds, std::int64_t step = 0) {
    return {.step = step, .seconds = seconds, .unix_origin = kOrigin};
  }
  /// One bundle; it must open with /frame and be read alike by oscpack.
  Heard hear(Peer& peer) {
    const auto bytes = peer.bytes();
    if (!bytes) {
      ADD_FAILURE() << "no bundle came";
      return {};
    }
    const auto decoded = protocol::decode(*bytes);
    EXPECT_EQ(decoded.refusal, protocol::Refusal::none);
    EXPECT_EQ(protocol::test::read_with_oscpack(*bytes), decoded.packet);
    Heard heard;
    heard.time = protocol::to_unix_seconds(decoded.packet.time.value());
    heard.frame = protocol::to_frame(decoded.packet.messages.at(0)).value();
    for (std::size_t i = 1; i < decoded.packet.messages.size(); ++i) {
      heard.events.push_back(protocol::to_event(decoded.packet.messages[i]).value());
    }
    return heard;
  }
  static double sounds_at(const Heard& heard, std::size_t index) {
    return heard.time + offset_ms(heard.events.at(index)) * 1.0e-3 - kOrigin;
  }

  double now = kOrigin;
  EventSenderSettings settings;
  Peer synth;
  Targets targets{{synth.endpoint()}};
  protocol::UdpSocket socket{protocol::Endpoint{}};

 private:
  std::unique_ptr<EventSender> sender_;
};

TEST_F(EventSenderTest, EveryEventSoundsAtItsMoment) {
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0, 77),
                     {test::cavity(2, 1.009), test::impact(0, 1.003), test::bubble(1, 1.007)});
  const auto heard = hear(synth);
  EXPECT_NEAR(heard.time, now, kTick);
  EXPECT_EQ(heard.frame.step, 77);
  EXPECT_EQ(heard.frame.delay_ms, 0.0F);
  ASSERT_EQ(heard.events.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<protocol::Impact>(heard.events[0]));
  EXPECT_TRUE(std::holds_alternative<protocol::Bubble>(heard.events[1]));
  EXPECT_TRUE(std::holds_alternative<protocol::Cavity>(heard.events[2]));
  EXPECT_NEAR(sounds_at(heard, 0), 1.003, kTick);
  EXPECT_NEAR(sounds_at(heard, 1), 1.007, kTick);
  EXPECT_NEAR(sounds_at(heard, 2), 1.009, kTick);
  EXPECT_EQ(sender().counts().overdue, 0U);
}

TEST_F(EventSenderTest, AnEventThatSoundsSoonerThanAnEarlierFramesEventIsNotHeldBack) {
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0), {test::bubble(0, 1.050)});
  now = kOrigin + 1.004;
  sender().send_step(frame(1.004), {test::impact(0, 1.006)});
  const auto first = hear(synth);
  const auto second = hear(synth);
  EXPECT_GE(second.time, first.time);
  EXPECT_NEAR(sounds_at(first, 0), 1.050, kTick);
  EXPECT_NEAR(sounds_at(second, 0), 1.006, kTick);
}

TEST_F(EventSenderTest, DelayIsTheTimeFromSendingToTheTag) {
  settings.lead = 0.008;
  now = kOrigin + 0.997;  // the frame was ready 3 ms early
  sender().send_step(frame(1.0), {test::bubble(0, 1.010), test::bubble(1, 1.0125)});
  const auto heard = hear(synth);
  EXPECT_NEAR(heard.time, kOrigin + 1.008, kTick);
  EXPECT_NEAR(static_cast<double>(heard.frame.delay_ms), 11.0, 1.0e-3);
  EXPECT_NEAR(offset_ms(heard.events.at(0)), 2.0, 1.0e-3);
  EXPECT_NEAR(offset_ms(heard.events.at(1)), 4.5, 1.0e-3);
}

TEST_F(EventSenderTest, ALeadNeverDelaysAnEventThatIsDueBeforeIt) {
  settings.lead = 0.008;
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0), {test::impact(0, 1.002)});
  const auto heard = hear(synth);
  EXPECT_NEAR(heard.time, kOrigin + 1.002, kTick);
  EXPECT_EQ(offset_ms(heard.events.at(0)), 0.0);
}

TEST_F(EventSenderTest, WhatIsTooLateSoundsAtOnceAndIsCounted) {
  now = kOrigin + 1.020;  // the simulator is 20 ms behind
  sender().send_step(frame(1.0), {test::impact(0, 1.005), test::bubble(0, 1.030)});
  const auto heard = hear(synth);
  EXPECT_EQ(offset_ms(heard.events.at(0)), 0.0);
  EXPECT_NEAR(sounds_at(heard, 1), 1.030, kTick);
  EXPECT_EQ(sender().counts().overdue, 1U);
  EXPECT_NEAR(sender().counts().most_overdue, 0.015, kTick);
}

TEST_F(EventSenderTest, ALargeFrameIsSplitUnderOneTag) {
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0, 5), test::bubbles(60, 1.010));
  std::vector<Heard> all;
  for (int i = 0; i < 3; ++i) all.push_back(hear(synth));
  EXPECT_TRUE(synth.silent());
  std::int32_t next_id = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].time, all[0].time);
    EXPECT_EQ(all[i].frame.sequence, static_cast<std::int32_t>(i));
    EXPECT_EQ(all[i].frame.step, 5);
    EXPECT_EQ(all[i].frame.session, sender().session());
    for (std::size_t k = 0; k < all[i].events.size(); ++k) {
      EXPECT_EQ(std::get<protocol::Bubble>(all[i].events[k]).id, next_id);
      EXPECT_NEAR(sounds_at(all[i], k), 1.010 + 1.0e-4 * next_id, kTick);
      ++next_id;
    }
  }
  EXPECT_EQ(next_id, 60);
  EXPECT_EQ(sender().counts().bundles, 3U);
  EXPECT_EQ(sender().counts().events.of<protocol::Bubble>(), 60U);
}

TEST_F(EventSenderTest, TagsNeverDecreaseAndOffsetsAreNeverNegative) {
  // Frames with moments before and behind their own time, on a clock that runs unevenly and is
  // set back a little.
  double last = 0.0;
  const std::vector<double> lateness{0.0, 0.004, 0.001, -0.003, 0.030, 0.0, -0.001, 0.002};
  settings.lead = 0.005;
  for (std::size_t i = 0; i < lateness.size(); ++i) {
    const double seconds = 1.0 + 0.004 * static_cast<double>(i);
    now = kOrigin + seconds + lateness[i];
    const double impact_at = seconds + (i % 3 == 0 ? -0.003 : 0.010);
    const double bubble_at = seconds + (i % 2 == 0 ? 0.0 : 0.020);
    sender().send_step(frame(seconds), {test::impact(0, impact_at), test::bubble(0, bubble_at)});
    const auto heard = hear(synth);
    EXPECT_GE(heard.time, last) << i;
    EXPECT_GE(heard.frame.delay_ms, 0.0F) << i;
    for (const auto& event : heard.events) EXPECT_GE(offset_ms(event), 0.0) << i;
    last = heard.time;
  }
}

TEST_F(EventSenderTest, AClockThatIsSetBackByAnHourDoesNotSilenceTheSender) {
  now = kOrigin + 3600.0;
  sender().send_step({.seconds = 1.0, .unix_origin = kOrigin + 3599.0}, {test::impact(0, 1.0)});
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0), {test::impact(1, 1.005)});
  hear(synth);
  EXPECT_NEAR(sounds_at(hear(synth), 0), 1.005, kTick);
}

TEST_F(EventSenderTest, IdleSaysOneFrameEachTenthOfASecond) {
  sender().idle();  // the first word: here I am
  EXPECT_TRUE(hear(synth).events.empty());
  now += 0.099;
  sender().idle();
  EXPECT_TRUE(synth.silent());
  now += 0.0011;
  sender().idle();
  const auto beat = hear(synth);
  EXPECT_EQ(beat.frame.sequence, 1);
  EXPECT_NEAR(beat.time, now, kTick);
  sender().idle();
  EXPECT_TRUE(synth.silent());
  EXPECT_EQ(sender().counts().heartbeats, 2U);
}

TEST_F(EventSenderTest, EventsCountAsASignOfLifeAndEmptyFramesBeat) {
  sender().send_step(frame(0.0), {test::impact(0, 0.0)});
  hear(synth);
  now += 0.05;
  sender().send_step(frame(0.05, 10), {});
  EXPECT_TRUE(synth.silent());
  now += 0.06;
  sender().send_step(frame(0.11, 20), {});
  EXPECT_EQ(hear(synth).frame.step, 20);
}

TEST_F(EventSenderTest, CountersWrapWherePureDataStillCounts) {
  sender().send_step(frame(0.0, std::int64_t{protocol::kCounterWrap} + 5), {test::impact(0, 0.0)});
  EXPECT_EQ(hear(synth).frame.step, 5);
  EXPECT_GE(sender().session(), 1);
  EXPECT_LT(sender().session(), protocol::kCounterWrap);
}

TEST_F(EventSenderTest, EachSenderDrawsItsOwnSession) {
  EventSender other(targets, socket, nullptr);
  EventSender third(targets, socket, nullptr);
  // All three alike once in 2^48 runs.
  EXPECT_FALSE(sender().session() == other.session() && other.session() == third.session());
}

TEST_F(EventSenderTest, AnEventOutOfRangeDoesNotTakeItsBundleAlong) {
  auto broken = test::impact(0, 1.0);
  std::get<protocol::Impact>(broken.event).speed = std::numeric_limits<float>::quiet_NaN();
  auto far_away = test::bubble(0, 1.0);
  std::get<protocol::Bubble>(far_away.event).radius = 5.0F;
  const auto never = test::bubble(1, std::numeric_limits<double>::infinity());
  const auto next_minute = test::bubble(2, 61.0);
  now = kOrigin + 1.0;
  sender().send_step(frame(1.0), {broken, far_away, never, next_minute, test::bubble(3, 1.0)});
  const auto heard = hear(synth);
  ASSERT_EQ(heard.events.size(), 1U);
  EXPECT_EQ(std::get<protocol::Bubble>(heard.events[0]).id, 3);
  EXPECT_EQ(sender().counts().invalid, 4U);
  EXPECT_EQ(sender().counts().events.of<protocol::Bubble>(), 1U);
}

TEST_F(EventSenderTest, TwoTargetsGetTheSameBytesAndADeadOneHarmsNobody) {
  Peer second;
  Targets three({synth.endpoint(), {.address = 0xFFFFFFFFU, .port = 9}, second.endpoint()});
  settings.clock = [this] { return now; };
  EventSender all(three, socket, nullptr, settings);
  all.send_step(frame(0.0), {test::impact(0, 0.0), test::bubble(0, 0.01)});
  const auto first_bytes = synth.bytes();
  const auto second_bytes = second.bytes();
  ASSERT_TRUE(first_bytes.has_value());
  EXPECT_EQ(first_bytes, second_bytes);
  const auto list = three.list();
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].sent, 1U);
  EXPECT_EQ(list[1].failed, 1U);  // broadcasting without leave
  EXPECT_EQ(list[2].sent, 1U);
}

}  // namespace
}  // namespace splash::sim
