// SPDX-License-Identifier: MIT
// Each command over a real socket: its reply, its effect, its refusal.
#include "sim-server/listen/control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/sim-server/send/control_fixture.hpp"

namespace splash::sim {
namespace {

using protocol::Message;
using testing::HasSubstr;

class Control : public test::ControlFixture {};

const protocol::BodyPose kPose{
    .body = 2, .position = {0.1F, 0.2F, 0.3F}, .qx = 0.0F, .qy = 0.6F, .qz = 0.0F, .qw = 0.8F};

std::string reason(const Message& reply) {
  if (reply.address != "/fail" || reply.arguments.size() != 2) return "no /fail came";
  return std::get<std::string>(reply.arguments[1]);
}

TEST_F(Control, PassesPosesOnWithTheirArrival) {
  const double before = protocol::monotonic_now();
  tell(protocol::to_message(kPose));
  settle();
  const double after = protocol::monotonic_now();
  ASSERT_EQ(poses().size(), 1U);
  EXPECT_EQ(poses()[0].pose, kPose);
  EXPECT_GE(poses()[0].moment.arrival, before - 1.0e-3) << "the kernel's clock is another one";
  EXPECT_LE(poses()[0].moment.arrival, after);
  EXPECT_FALSE(poses()[0].moment.sent.has_value());
  EXPECT_EQ(server_->counts().poses, 1U);
}

TEST_F(Control, PassesTheTimeTagOfAPosesBundleOn) {
  const double sent = 1.0e9 + 0.125;
  const auto bundle = [](protocol::TimeTag tag) {
    return protocol::encode(tag, {protocol::to_message(kPose)});
  };
  tell(bundle(protocol::to_time_tag(sent)));
  tell(bundle(protocol::kImmediately));
  tell(bundle({0}));
  settle();
  ASSERT_EQ(poses().size(), 3U);
  ASSERT_TRUE(poses()[0].moment.sent.has_value());
  EXPECT_NEAR(*poses()[0].moment.sent, sent, 1.0e-6);
  EXPECT_FALSE(poses()[1].moment.sent.has_value()) << "at once is no moment";
  EXPECT_FALSE(poses()[2].moment.sent.has_value()) << "nor is nothing";
}

// The thread that listens is busy printing while they come.
TEST_F(Control, APoseCameWhenTheKernelTookIt) {
  server_ = nullptr;
  std::vector<double> arrivals;
  sim::ControlActions actions;
  actions.pose = [&](const protocol::BodyPose&, const PoseMoment& moment) {
    arrivals.push_back(moment.arrival);
    if (arrivals.size() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(300));
  };
  sim::ControlServer server({.listen = {}}, actions, targets_);
  const double first = protocol::monotonic_now();
  peer_.send(server.local(), protocol::to_message(kPose));
  const double first_sent = protocol::monotonic_now();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const double second = protocol::monotonic_now();
  peer_.send(server.local(), protocol::to_message(kPose));
  const double second_sent = protocol::monotonic_now();
  ASSERT_EQ(ask(server, {"/sync", {1}}).address, "/synced");
  ASSERT_EQ(arrivals.size(), 2U);
  constexpr double kTick = 1.0e-3;  // the kernel's clock is another one
  EXPECT_GE(arrivals[0], first - kTick);
  EXPECT_LE(arrivals[0], first_sent + kTick) << "it is taken while it is sent";
  EXPECT_GE(arrivals[1], second - kTick);
  EXPECT_LE(arrivals[1], second_sent + kTick);
}

TEST_F(Control, TakesPosesFromBundlesInTheirOrder) {
  auto second = kPose;
  second.body = 3;
  peer_.send(server_->local(),
             protocol::encode({1}, {protocol::to_message(kPose), protocol::to_message(second)}));
  settle();
  ASSERT_EQ(poses().size(), 2U);
  EXPECT_EQ(poses()[0].pose.body, 2);
  EXPECT_EQ(poses()[1].pose.body, 3);
}

TEST_F(Control, RefusesAPoseThatIsNoRotation) {
  auto stretched = kPose;
  stretched.qw = 1.0F;
  EXPECT_THAT(reason(ask(protocol::to_message(stretched))), HasSubstr("quaternion"));
  stretched.position.x = 2000.0F;
  EXPECT_THAT(reason(ask(protocol::to_message(stretched))), HasSubstr("allowed -1000 to 1000"));
  EXPECT_TRUE(poses().empty());
  EXPECT_EQ(server_->counts().no_rotations, 1U);
  EXPECT_EQ(server_->counts().malformed_poses, 1U);
  EXPECT_EQ(server_->counts().failed, 2U);
  EXPECT_EQ(server_->counts().out_of_table, 1U);
}

TEST_F(Control, AnswersStatusWithItsRefusals) {
  tell(std::vector<std::byte>(3));
  auto stretched = kPose;
  stretched.qw = 1.0F;
  EXPECT_THAT(reason(ask(protocol::to_message(stretched))), HasSubstr("quaternion"));
  stretched.position.x = 2000.0F;
  EXPECT_THAT(reason(ask(protocol::to_message(stretched))), HasSubstr("allowed"));
  EXPECT_THAT(reason(ask({"/notify", {2}})), HasSubstr("no forces here"));
  const auto status = protocol::to_sim_status(ask({"/status", {}}));
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->particles, 15000U);
  EXPECT_EQ(status->steps, 42U);
  EXPECT_EQ(status->refused, 1003U)
      << "what the program refused, the gate, a pose that is no rotation and one out of range; not "
         "a command that could not be obeyed";
}

TEST_F(Control, AnswersClearSchedAndPrintsWhatIsWrong) {
  EXPECT_EQ(ask({"/clearSched", {}}), protocol::done("/clearSched"));
  EXPECT_EQ(ask({"/nosuch", {}}).address, "/fail");
  EXPECT_EQ(lines().size(), 1U);
}

TEST_F(Control, NotifySubscribesTheSenderAndEndsIt) {
  EXPECT_EQ(ask({"/notify", {1}}), protocol::done("/notify", 1));
  ASSERT_EQ(targets_.list().size(), 1U);
  EXPECT_EQ(targets_.list()[0].endpoint, peer_.endpoint());
  EXPECT_FALSE(targets_.list()[0].fixed);
  EXPECT_EQ(ask({"/notify", {0}}), protocol::done("/notify", 0));
  EXPECT_TRUE(targets_.list().empty());
}

TEST_F(Control, AnyPacketRenewsASubscription) {
  server_ = nullptr;
  std::atomic<double> now = 0.0;  // read on the control's thread
  Targets targets({}, [&now] { return now.load(); });
  ControlServer server({.listen = {}}, {}, targets);
  ASSERT_EQ(ask(server, {"/notify", {1}}).address, "/done");
  now = 0.9 * kSubscriptionLease;
  ASSERT_EQ(ask(server, {"/sync", {1}}).address, "/synced");
  ASSERT_EQ(targets.list().size(), 1U);
  EXPECT_NEAR(targets.list()[0].expires, 1.9 * kSubscriptionLease, 1.0e-9);
}

TEST_F(Control, NotifyRefusesStreamsThatAreNotSent) {
  EXPECT_THAT(reason(ask({"/notify", {4}})), HasSubstr("allowed 0 to 3"));
  EXPECT_THAT(reason(ask({"/notify", {2}})), HasSubstr("no forces here"));
  EXPECT_THAT(reason(ask({"/notify", {3}})), HasSubstr("no forces here"));
  EXPECT_TRUE(targets_.list().empty());
}

TEST_F(Control, NotifySubscribesToForcesWhereThereAreAny) {
  server_ = nullptr;
  std::string why = "the water solves";
  ControlServer server({.listen = {}}, {.no_forces = [&] { return why; }}, targets_);
  EXPECT_THAT(reason(ask(server, {"/notify", {2}})), HasSubstr("the water solves"));
  why.clear();
  EXPECT_EQ(ask(server, {"/notify", {2}}), protocol::done("/notify", 2));
  EXPECT_TRUE(targets_.wants(kForceStream));
  EXPECT_FALSE(targets_.wants(kEventStream));
  EXPECT_EQ(ask(server, {"/notify", {3}}), protocol::done("/notify", 3));
  EXPECT_TRUE(targets_.wants(kEventStream));
  EXPECT_EQ(ask(server, {"/notify", {0}}), protocol::done("/notify", 0));
  EXPECT_FALSE(targets_.wants(kForceStream));
}

TEST_F(Control, TakesWhatAFloorFeelsWhereThereIsOne) {
  server_ = nullptr;
  bool has_floor = false;
  int taken = 0;
  ControlServer server({.listen = {}},
                       {.track =
                            [&](const Message&, const PoseMoment&) {
                              taken += has_floor ? 1 : 0;
                              return has_floor;
                            }},
                       targets_);
  EXPECT_THAT(reason(ask(server, {"/tile/pressure", {0, 5.0F}})), HasSubstr("kind: pressure"));
  has_floor = true;
  peer_.send(server.local(), Message{"/tile/pressure", {0, 5.0F, -1.0F}});
  EXPECT_EQ(ask(server, {"/sync", {1}}).address, "/synced") << "and nothing came before it";
  EXPECT_EQ(taken, 1);
  EXPECT_THAT(reason(ask(server, {"/tile/pressure", {0, 1}})), testing::Not(HasSubstr("no /fail")));
}

TEST_F(Control, QuitFromThisHostIsDoneAndObeyed) {
  EXPECT_EQ(ask({"/quit", {}}), protocol::done("/quit"));
  settle();
  EXPECT_EQ(quits(), 1);
}

TEST_F(Control, MessagesOfTrackersAreNoUnknownCommands) {
  const double sent = 1.0e9 + 0.125;
  const protocol::Message message = {"/tracker", {std::string("A"), 0.5F}};
  tell(protocol::encode(protocol::to_time_tag(sent), {message}));
  settle();
  ASSERT_EQ(tracked().size(), 1U);
  EXPECT_EQ(tracked()[0].message, message);
  EXPECT_NEAR(tracked()[0].moment.sent.value_or(0.0), sent, 1.0e-6);
  EXPECT_EQ(server_->counts().failed, 0U);
}

TEST_F(Control, BodiesThatNobodyTracksAreNamed) {
  const auto reply =
      ask({"/body/pose", {std::string("foot"), 0.1F, 0.2F, 0.3F, 0.0F, 0.0F, 0.0F, 1.0F}});
  EXPECT_THAT(reason(reply), HasSubstr("no body named 'foot'"));
}

TEST_F(Control, AnActionThatThrowsIsToldAndSurvived) {
  server_ = nullptr;
  sim::ControlActions actions;
  actions.status = []() -> protocol::SimStatus { throw std::runtime_error("device is gone"); };
  sim::ControlServer server({.listen = {}}, actions, targets_);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(reason(ask(server, {"/status", {}})), "device is gone");
}

TEST_F(Control, WhatTheProgramDoesNotOfferIsRefused) {
  server_ = nullptr;
  sim::ControlServer server({.listen = {}}, {}, targets_);
  for (const auto& message :
       {Message{"/status", {}}, Message{"/quit", {}}, protocol::to_message(kPose)}) {
    EXPECT_EQ(ask(server, message).address, "/fail") << message.address;
  }
}

TEST_F(Control, APortThatIsTakenIsAnError) {
  EXPECT_THROW(start({.listen = peer_.endpoint()}), std::runtime_error);
}

}  // namespace
}  // namespace splash::sim
