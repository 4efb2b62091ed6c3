// SPDX-License-Identifier: MIT
// From datagrams to commands for the audio thread, with clocks of the test's own.
#include "synth-server/receive/intake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"

namespace splash::synth {
namespace {

using protocol::Message;
using protocol::TimeTag;

constexpr double kUnix = 1.8e9;      // system time when the monotonic clock shows kStart [s]
constexpr double kStart = 5000.0;    // [s]
constexpr double kPrecision = 1e-6;  // a double holds today's Unix time to 0.24 us [s]
constexpr protocol::Endpoint kSim{INADDR_LOOPBACK, 57300};
constexpr protocol::Endpoint kOtherHost{0x0A000005, 57300};

Message bubble(int id, float offset_ms = 0.0F) {
  return protocol::to_message(protocol::Bubble{id, 0, 0.005F, 0.1F, {0.0F, 0.0F, 0.0F}, offset_ms});
}

Message frame(int session, int sequence, float delay_ms = 0.0F) {
  return protocol::to_message(protocol::Frame{session, sequence, sequence, delay_ms});
}

class IntakeTest : public testing::Test {
 protected:
  IntakeTest()
      : intake_(queue_, {}, {},
                LocalTime([this] { return kUnix + (now_ - kStart); }, [this] { return now_; })) {}

  void send(const std::vector<std::byte>& bytes, const protocol::Endpoint& from = kSim) {
    intake_.datagram(bytes, from, now_, replies_);
  }
  /// A tag for the monotonic moment `at` by a clock that is `ahead` of ours.
  static TimeTag tag(double at, double ahead = 0.0) {
    return protocol::to_time_tag(kUnix + (at - kStart) + ahead);
  }
  std::vector<Command> commands() {
    std::vector<Command> all;
    queue_.consume_all([&](const Command& command) { all.push_back(command); });
    return all;
  }
  std::vector<Command> played() {
    auto all = commands();
    std::erase_if(all, [](const Command& c) { return c.kind != Command::Kind::play; });
    return all;
  }
  /// Answers the last ping as a sender whose clock is `ahead` would, `travel` later each way.
  void answer_ping(double ahead, double travel, const protocol::Endpoint& from) {
    ASSERT_FALSE(replies_.empty());
    const Message ping = replies_.back().message;
    ASSERT_EQ(ping.address, "/ping");
    now_ += 2.0 * travel;
    send(protocol::encode(protocol::pong(std::get<TimeTag>(ping.arguments[0]),
                                         tag(now_ - travel, ahead), tag(now_ - travel, ahead))),
         from);
  }

  double now_ = kStart;
  CommandQueue queue_;
  std::vector<Reply> replies_;
  Intake intake_;
};

TEST_F(IntakeTest, MomentIsTheTagPlusTheOffset) {
  send(protocol::encode(tag(now_ + 0.010), {frame(1, 0, 10.0F), bubble(1, 2.5F)}));
  const auto events = played();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].moment, kStart + 0.0125, kPrecision);
  EXPECT_NEAR(events[0].by_arrival, kStart + 0.0125, kPrecision);
  EXPECT_EQ(std::get<protocol::Bubble>(events[0].event).id, 1);
}

TEST_F(IntakeTest, ImmediatelyMeansArrivalPlusDelayPlusOffset) {
  send(protocol::encode(protocol::kImmediately, {frame(1, 0, 10.0F), bubble(1, 2.5F)}));
  send(protocol::encode(bubble(2, 3.0F)));
  send(protocol::encode(tag(now_ + 0.2), {bubble(3, 1.0F)}));
  const auto events = played();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_NEAR(events[0].moment, kStart + 0.0125, kPrecision);
  EXPECT_NEAR(events[1].moment, kStart + 0.0030, kPrecision) << "a bare message";
  EXPECT_NEAR(events[2].moment, kStart + 0.2010, kPrecision) << "a tagged bundle without a frame";
  EXPECT_FALSE(events[0].at_once) << "it names a delay: two such are as far apart as they say";
  EXPECT_TRUE(events[1].at_once);
  EXPECT_DOUBLE_EQ(events[1].offset, 0.003);
  EXPECT_FALSE(events[2].at_once);
}

TEST_F(IntakeTest, NeverPlaysABundleTwice) {
  const auto bundle = protocol::encode(tag(now_), {frame(1, 0), bubble(1)});
  for (int i = 0; i < 5; ++i) send(bundle);
  EXPECT_EQ(played().size(), 1U);
  EXPECT_EQ(intake_.counters().sequence.duplicates, 4U);
  EXPECT_EQ(intake_.counters().events, 1U);
}

TEST_F(IntakeTest, CountsTheLostAndPlaysTheReordered) {
  for (const int sequence : {0, 1, 5, 3, 6}) {
    send(protocol::encode(tag(now_), {frame(1, sequence), bubble(sequence)}));
  }
  EXPECT_EQ(played().size(), 5U);
  const SequenceTotals totals = intake_.counters().sequence;
  EXPECT_EQ(totals.received, 5U);
  EXPECT_EQ(totals.lost, 2U) << "2 and 4";
  EXPECT_EQ(totals.reordered, 1U);
}

TEST_F(IntakeTest, CountsTheSenderThatIsGoneAndTakesItBack) {
  send(protocol::encode(tag(now_), {frame(1, 0)}));
  for (int beat = 1; beat <= 20; ++beat) {  // two seconds of heartbeats
    now_ += protocol::kHeartbeatPeriod;
    intake_.tick(now_);
    send(protocol::encode(tag(now_), {frame(1, beat)}));
  }
  EXPECT_TRUE(commands().empty());

  now_ += kLease - 0.01;
  intake_.tick(now_);
  EXPECT_TRUE(intake_.sender_present());
  now_ += 0.02;
  intake_.tick(now_);
  EXPECT_TRUE(commands().empty()) << "what sounds rings out";
  EXPECT_FALSE(intake_.sender_present());

  send(protocol::encode(tag(now_), {frame(2, 0), bubble(1)}));  // restarted
  const auto seen = commands();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].kind, Command::Kind::play);
  EXPECT_EQ(intake_.counters().sequence.sessions, 2U);
  EXPECT_EQ(intake_.counters().departures, 1U);
}

TEST_F(IntakeTest, LetsTheEventsOfOneThatTakesItsLeaveSoundToTheirEnd) {
  send(protocol::encode(tag(now_), {frame(1, 0), bubble(0)}));
  send(protocol::encode(tag(now_), {frame(1, 1), {"/leave", {}}}));
  EXPECT_FALSE(intake_.sender_present());
  EXPECT_EQ(intake_.counters().departures, 1U);
  (void)commands();
  now_ += 10.0 * kLease;
  intake_.tick(now_);
  EXPECT_TRUE(commands().empty());
  send(protocol::encode(tag(now_), {frame(1, 1), {"/leave", {}}}));  // twice on the wire
  EXPECT_EQ(intake_.counters().departures, 1U);
  EXPECT_EQ(intake_.counters().out_of_table, 0U);
}

TEST_F(IntakeTest, AFloodThatNobodyTakesLeavesRoomForCommands) {
  send(protocol::encode(tag(now_), {frame(1, 0), bubble(0)}));
  for (std::size_t id = 1; id < 2 * kCommandCapacity; ++id) {
    send(protocol::encode({bubble(static_cast<int>(id))}));
  }
  EXPECT_GT(intake_.counters().queue_full, kCommandCapacity - kKeptPlaces);
  EXPECT_GE(queue_.write_available(), kKeptPlaces);
}

TEST_F(IntakeTest, AFloodOfBubblesThatNobodyTakesLeavesRoomForImpactsAndCavities) {
  for (std::size_t id = 1; id < 2 * kCommandCapacity; ++id) {
    send(protocol::encode({bubble(static_cast<int>(id))}));
  }
  const std::uint64_t events = intake_.counters().events;
  protocol::Impact impact;
  protocol::Cavity cavity;
  impact.speed = 1.0F;
  cavity.radius = 0.1F;
  for (int id = 1; id <= 100; ++id) {
    send(protocol::encode({protocol::to_message(impact)}));
    send(protocol::encode({protocol::to_message(cavity)}));
  }
  EXPECT_EQ(intake_.counters().events, events + 200);
  EXPECT_EQ(intake_.counters().without_place.of<protocol::Impact>(), 0U);
  EXPECT_EQ(intake_.counters().without_place.of<protocol::Cavity>(), 0U);
  EXPECT_EQ(intake_.counters().without_place.of<protocol::Bubble>(), intake_.counters().queue_full);
  EXPECT_GT(intake_.counters().queue_full, 0U);
}

TEST_F(IntakeTest, UnframedSendersAreNotWatched) {
  send(protocol::encode(bubble(1)));
  now_ += 10.0;
  intake_.tick(now_);
  EXPECT_EQ(commands().size(), 1U);
  EXPECT_TRUE(replies_.empty());
}

TEST_F(IntakeTest, GoesByArrivalWhileAClockIsAnHourOff) {
  for (const double ahead : {3600.0, -3600.0}) {
    const protocol::Endpoint from{INADDR_LOOPBACK, static_cast<std::uint16_t>(ahead > 0 ? 1 : 2)};
    for (int i = 0; i < 10; ++i) {
      now_ += 0.05;
      const double travel = i % 2 == 0 ? 0.0004 : 0.0080;
      send(protocol::encode(tag(now_ - travel + 0.010, ahead), {frame(1, i, 10.0F), bubble(i)}),
           from);
      const auto events = played();
      ASSERT_EQ(events.size(), 1U);
      EXPECT_NEAR(events[0].moment, now_ + 0.010 - (travel - 0.0004), kPrecision)
          << "jitter of the network is not heard";
    }
  }
  EXPECT_EQ(intake_.counters().corrected, 20U);
}

TEST_F(IntakeTest, AsksForTheClockAndCorrectsIt) {
  const double ahead = 12.345;
  send(protocol::encode(tag(now_, ahead), {frame(1, 0)}), kOtherHost);
  for (int i = 0; i < 6; ++i) {
    answer_ping(ahead, 0.002, kOtherHost);
    now_ += 0.2;
    replies_.clear();
    send(protocol::encode(tag(now_, ahead), {frame(1, i + 1)}), kOtherHost);
  }
  (void)commands();
  send(protocol::encode(tag(now_ + 0.010, ahead), {frame(1, 10), bubble(1)}), kOtherHost);
  const auto events = played();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].moment, now_ + 0.010, 1e-4);
}

TEST_F(IntakeTest, IgnoresPongsNobodyAskedFor) {
  send(protocol::encode(tag(now_), {frame(1, 0)}));
  const auto lie = [this](double asked) {
    return protocol::encode(protocol::pong(tag(now_ + asked), tag(now_, 9.0), tag(now_, 9.0)));
  };
  for (int i = 1; i < 10; ++i) send(lie(i));  // stamps that were never sent
  send(lie(0.0), kOtherHost);                 // the right stamp, from somebody else
  (void)commands();
  send(protocol::encode(tag(now_ + 0.010), {frame(1, 1, 10.0F), bubble(1)}));
  EXPECT_NEAR(played().at(0).moment, now_ + 0.010, kPrecision);
}

TEST_F(IntakeTest, KeepsStrangersFromControl) {
  for (const char* address : {"/status", "/quit", "/clearSched", "/nonsense", "/ping"}) {
    send(protocol::encode(Message{address, {}}), kOtherHost);
  }
  EXPECT_TRUE(replies_.empty()) << "not even a refusal: its address may be forged";
  EXPECT_EQ(intake_.counters().forbidden, 5U);
  send(protocol::encode(bubble(1)), kOtherHost);
  EXPECT_EQ(played().size(), 1U) << "events are welcome from who can reach the port";
}

// A forged sender address must not make the synth a source of traffic towards it.
TEST_F(IntakeTest, SendsAStrangerLessThanItSaid) {
  const auto say = [&](const std::vector<std::byte>& bytes) {
    const std::size_t before = replies_.size();
    send(bytes, kOtherHost);
    ASSERT_LE(replies_.size(), before + 1);
    if (replies_.size() == before) return;
    EXPECT_LE(protocol::encode(replies_.back().message).size(), bytes.size());
  };
  say(protocol::encode(frame(1, 0)));  // the shortest that draws a /ping
  for (int i = 1; i <= 100; ++i) {
    now_ += 0.02;
    intake_.tick(now_);
    if (i == 50) say(protocol::encode(frame(1, 1)));
    say(protocol::encode(Message{"/ping", {tag(now_)}}));
    say(protocol::encode(Message{"/status", {}}));
  }
  EXPECT_EQ(replies_.size(), 2U) << "one question for each frame, nothing else";
  EXPECT_EQ(intake_.counters().forbidden, 200U);
}

// As long as the /pong, which the simulator may send only then; short where the frame was, too.
TEST_F(IntakeTest, AsksAnotherHostInAsManyBytesAsItsAnswerHas) {
  const auto drawn_by = [&](const std::vector<std::byte>& datagram,
                            const protocol::Endpoint& from) {
    replies_.clear();
    now_ += 0.2;
    send(datagram, from);
    EXPECT_EQ(replies_.size(), 1U);
    if (replies_.empty()) return std::size_t{0};
    EXPECT_EQ(replies_[0].message.address, "/ping");
    return protocol::encode(replies_[0].message).size();
  };
  const auto heartbeat = [this](int sequence) {
    return protocol::encode(tag(now_), {frame(1, sequence)});
  };
  ASSERT_EQ(heartbeat(0).size(), 52U);
  EXPECT_EQ(drawn_by(heartbeat(0), kOtherHost), 40U);
  ASSERT_EQ(protocol::encode(frame(1, 1)).size(), 32U);
  EXPECT_EQ(drawn_by(protocol::encode(frame(1, 1)), kOtherHost), 20U);
  EXPECT_EQ(drawn_by(heartbeat(0), kSim), 20U) << "this host is answered whatever it sends";
}

TEST_F(IntakeTest, AnswersItsOwnHost) {
  send(protocol::encode(Message{"/status", {}}));
  send(protocol::encode(Message{"/nonsense", {}}));
  ASSERT_EQ(replies_.size(), 2U);
  EXPECT_EQ(replies_[0].message.address, "/status.reply");
  EXPECT_EQ(replies_[1].message.address, "/fail");
}

TEST_F(IntakeTest, NeverAnswersReplies) {
  for (const Message& message :
       {protocol::done("/x"), protocol::fail("/x", "y"), protocol::synced(1),
        protocol::version_reply("sim-server"), protocol::to_message(protocol::SimStatus{})}) {
    send(protocol::encode(message));
  }
  EXPECT_TRUE(replies_.empty());
}

TEST_F(IntakeTest, CountsWhatTheTableRefuses) {
  Message wild = bubble(1);
  wild.arguments[2] = 5000.0F;  // metres
  send(protocol::encode(tag(now_), {frame(1, 0), wild, bubble(2)}));
  send(protocol::encode(Message{"/bubble", {1, 2}}));
  EXPECT_EQ(played().size(), 1U);
  EXPECT_EQ(intake_.counters().out_of_table, 2U);
}

TEST_F(IntakeTest, CountsEventsThatNobodyTakes) {
  const std::size_t sent = kCommandCapacity + 100;
  for (std::size_t i = 0; i < sent; ++i) send(protocol::encode(bubble(1)));
  EXPECT_EQ(intake_.counters().events + intake_.counters().queue_full, sent);
  EXPECT_GE(intake_.counters().queue_full, 100U);
}

}  // namespace
}  // namespace splash::synth
