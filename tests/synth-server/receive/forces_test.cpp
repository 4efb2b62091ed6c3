// SPDX-License-Identifier: MIT
// Forces that the simulator tells: how fast they change, which are none, and who is asked for them.
#include "synth-server/receive/forces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/control.hpp"
#include "protocol/force_changes.hpp"
#include "protocol/limits.hpp"
#include "synth-server/receive/intake.hpp"

namespace splash::synth {
namespace {

using protocol::ForceChanges;
using protocol::Message;

constexpr protocol::Endpoint kSim{INADDR_LOOPBACK, 57300};
constexpr protocol::Endpoint kSending{INADDR_LOOPBACK, 40000};  ///< where its bundles come from

Message at(int body, float x) {
  return {"/body/at", {body, x, 0.5F, 0.2F, 0.0F, 0.0F, 0.0F, 1.0F}};
}
Message force(int body, float fx, float fy, float fz) {
  return {"/force", {body, fx, fy, fz, 0.0F, 0.0F, 0.0F}};
}
std::vector<Message> told(int session, const std::vector<Message>& messages) {
  std::vector<Message> all = {protocol::to_message(protocol::Frame{session, 0, 0, 0.0F})};
  all.insert(all.end(), messages.begin(), messages.end());
  return all;
}

TEST(Forces, ChangeByTheLengthOfTheirDifferenceInTime) {
  ForceChanges forces;
  EXPECT_TRUE(forces.take(told(1, {at(3, 0.1F), force(3, 1.0F, 2.0F, 10.0F)}), 5.0).empty());
  const auto pushes = forces.take(told(1, {at(3, 0.2F), force(3, 4.0F, 6.0F, 22.0F)}), 5.00625);
  ASSERT_EQ(pushes.size(), 1U);
  EXPECT_NEAR(pushes[0].rate, 13.0 / 0.00625, 1e-3) << "3, 4 and 12 N";
  EXPECT_EQ(pushes[0].body, 3);
  EXPECT_EQ(pushes[0].position, (protocol::Vec3{0.2F, 0.5F, 0.2F}));
}

TEST(Forces, OfEachBodyChangeByThemselves) {
  ForceChanges forces;
  (void)forces.take(told(1, {at(0, 0.0F), force(0, 0, 0, 1.0F), at(7, 1.0F), force(7, 0, 0, 5.0F)}),
                    1.0);
  const auto pushes = forces.take(
      told(1, {at(0, 0.0F), force(0, 0, 0, 2.0F), at(7, 1.0F), force(7, 0, 0, 5.0F)}), 1.01);
  ASSERT_EQ(pushes.size(), 2U);
  EXPECT_NEAR(pushes[0].rate, 100.0, 1e-4);
  EXPECT_EQ(pushes[1].rate, 0.0F) << "told, and steady";
}

TEST(Forces, BeginAnewAfterAGapARestartAndAClockThatWentBack) {
  ForceChanges forces;
  const auto take = [&](int session, float fz, double time) {
    return forces.take(told(session, {at(0, 0.0F), force(0, 0, 0, fz)}), time);
  };
  EXPECT_TRUE(take(1, 0.0F, 1.0).empty());
  EXPECT_EQ(take(1, 1.0F, 1.01).size(), 1U);
  EXPECT_TRUE(take(1, 9.0F, 1.01).empty()) << "the same once more";
  EXPECT_NEAR(take(1, 2.0F, 1.02).at(0).rate, 100.0, 1e-4) << "which changed nothing";
  EXPECT_TRUE(take(1, 50.0F, 1.13).empty()) << "a gap";
  EXPECT_TRUE(take(2, 0.0F, 1.14).empty()) << "another simulator";
  EXPECT_TRUE(take(2, 9.0F, 0.5).empty()) << "back";
  EXPECT_NEAR(take(2, 10.0F, 0.51).at(0).rate, 100.0, 1e-4);
  EXPECT_EQ(take(2, 1e6F, 0.52).at(0).rate, ForceChanges::kMostRate);
}

TEST(Forces, OutOfTheTableGiveNoPush) {
  ForceChanges forces;
  EXPECT_TRUE(forces.take({}, 1.0).empty());
  (void)forces.take(told(1, {at(0, 0.0F), force(0, 0, 0, 1.0F)}), 1.0);
  EXPECT_TRUE(forces.take(told(1, {at(0, 0.0F), {"/force", {2.0F}}}), 1.01).empty());
  EXPECT_TRUE(forces.take(told(1, {at(0, 0.0F), force(0, 2e6F, 0, 1.0F)}), 1.01).empty());
}

TEST(Forces, WithoutAPlaceGiveNoPush) {
  ForceChanges forces;
  (void)forces.take(told(1, {force(0, 0, 0, 1.0F)}), 1.0);
  EXPECT_TRUE(forces.take(told(1, {force(0, 0, 0, 2.0F)}), 1.01).empty());
}

TEST(Forces, AreAskedForWhileTheyAreWanted) {
  bool wanted = false;
  ForceQuestion question({kSim, [&] { return wanted; }});
  EXPECT_FALSE(question.due(100.0));
  wanted = true;
  const auto first = question.due(100.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->address, "/notify");
  EXPECT_EQ(std::get<std::int32_t>(first->arguments.at(0)), 2);
  EXPECT_GE(protocol::encoded_size(*first),
            protocol::encoded_size(protocol::fail("/notify", std::string(64, 'x'))));
  EXPECT_FALSE(question.due(100.9));
  EXPECT_TRUE(question.due(101.0)) << "nobody has answered";
  (void)question.refusal(protocol::done("/notify", 2), kSending);
  EXPECT_TRUE(question.due(102.0)) << "nor has the simulator";
  (void)question.refusal(protocol::done("/notify", 2), kSim);
  EXPECT_FALSE(question.due(106.0));
  EXPECT_TRUE(question.due(102.1 + ForceQuestion::kPeriod));
  wanted = false;
  const auto last = question.due(107.5);
  ASSERT_TRUE(last);
  EXPECT_EQ(std::get<std::int32_t>(last->arguments.at(0)), 0);
  EXPECT_FALSE(question.due(108.0)) << "said once";
  EXPECT_FALSE(ForceQuestion({}).due(1.0)) << "nobody to ask";
}

TEST(Forces, ThatAreRefusedAreSaidOnce) {
  ForceQuestion question({kSim, [] { return true; }});
  const Message no = protocol::fail("/notify", "no body has motion: {kind: osc}");
  EXPECT_EQ(question.refusal(no, kSending), "") << "from somebody else";
  EXPECT_THAT(question.refusal(no, kSim), testing::HasSubstr("no body has motion"));
  EXPECT_EQ(question.refusal(no, kSim), "");
  EXPECT_EQ(question.refusal(protocol::done("/notify", 2), kSim), "");
  EXPECT_NE(question.refusal(no, kSim), "") << "it was all right in between";
}

/// Bundles of events and of forces from one socket, each counted on its own.
TEST(Forces, DoNotDisturbTheCountOfEvents) {
  CommandQueue queue;
  constexpr double kUnix = 1.8e9;
  double now = 50.0;
  Intake intake(queue, {}, {}, LocalTime([&] { return kUnix + now; }, [&] { return now; }));
  std::vector<Reply> replies;
  const auto send = [&](const std::vector<Message>& messages) {
    intake.datagram(protocol::encode(protocol::to_time_tag(kUnix + now + 0.005), messages),
                    kSending, now, replies);
  };
  for (int i = 0; i < 10; ++i) {
    now += 0.00625;
    const auto fz = static_cast<float>(i);
    send({protocol::to_message(protocol::Frame{9, 2 * i, i, 5.0F}), at(0, 0.0F),
          force(0, 0.0F, 0.0F, fz)});
    send({protocol::to_message(protocol::Frame{9, i, i, 5.0F})});
  }
  EXPECT_EQ(intake.counters().sequence.lost, 0U);
  EXPECT_EQ(intake.counters().sequence.duplicates, 0U);
  EXPECT_EQ(intake.counters().out_of_table, 0U);
  std::vector<Command> pushes;
  queue.consume_all([&](const Command& command) { pushes.push_back(command); });
  ASSERT_EQ(pushes.size(), 9U);
  EXPECT_EQ(pushes[8].kind, Command::Kind::push);
  EXPECT_NEAR(pushes[8].push.rate, 160.0, 0.1);
  EXPECT_NEAR(pushes[8].moment, now + 0.005, 1e-5);
  send({protocol::to_message(protocol::Frame{9, 30, 30, 5.0F}), at(0, 0.0F),
        force(0, 2e6F, 0.0F, 0.0F)});
  EXPECT_EQ(intake.counters().out_of_table, 1U) << "no water pushes so hard";
}

}  // namespace
}  // namespace splash::synth
