// SPDX-License-Identifier: MIT
#include "synth-server/receive/control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/address.hpp"
#include "protocol/filling.hpp"

namespace splash::synth {
namespace {

using protocol::Message;

constexpr protocol::Endpoint kLocal{INADDR_LOOPBACK, 9000};
constexpr protocol::Endpoint kFriend{0x0A000005, 9000};
constexpr protocol::Endpoint kStranger{0x0A000006, 9000};

class ControlTest : public testing::Test {
 protected:
  ControlTest() : control_(actions(), {kFriend.address}) {}

  ControlActions actions() {
    return {[](protocol::SynthStatus status) {
              status.voices = 7;
              return status;
            },
            [this] { ++cleared_; },
            [this] { ++quits_; },
            [this](bool on) { muted_ = on; },
            [this](const std::string& name, double value) {
              if (name != "impact/q") return std::string("no such row");
              q_ = value;
              return std::string();
            },
            [](const std::string& name, double /*seconds*/) {
              return std::string(name == "calibrated" ? "" : "no sound is called so");
            },
            [this](const std::string& name) {
              return name == "impact/q" ? std::optional(q_) : std::nullopt;
            },
            [this](std::size_t most) {
              std::vector<ControlActions::Value> all(std::min<std::size_t>(most, 1));
              all[0] = {"impact/q", q_};
              return all;
            }};
  }
  /// The one reply; a new second for each command, so that the limit is not met.
  Message ask(const Message& message, const protocol::Endpoint& from = kLocal) {
    std::vector<Reply> replies;
    now_ += 1.0;
    protocol::SynthStatus status;
    status.events = 42;
    const Message question = from == kLocal ? message : protocol::filled_up(message, 256);
    protocol::ReplyBudget budget(from, protocol::encode(question).size());
    control_.handle(question, {from, now_, 1.8e9 + now_, budget}, status, replies);
    EXPECT_EQ(replies.size(), 1U) << message.address;
    if (replies.empty()) return {};
    EXPECT_EQ(replies.front().to, from);
    EXPECT_EQ(protocol::violation(replies.front().message), std::nullopt) << message.address;
    return replies.front().message;
  }

  int cleared_ = 0;
  int quits_ = 0;
  bool muted_ = false;
  double q_ = 5.0;
  double now_ = 0.0;
  Control control_;
};

TEST_F(ControlTest, AllowsLoopbackAndThoseNamed) {
  EXPECT_TRUE(control_.allows(kLocal));
  EXPECT_TRUE(control_.allows(kFriend));
  EXPECT_FALSE(control_.allows(kStranger));
}

TEST_F(ControlTest, Mutes) {
  EXPECT_EQ(ask({"/mute", {1}}), (Message{"/done", {std::string("/mute")}}));
  EXPECT_TRUE(muted_);
  EXPECT_EQ(ask({"/mute", {0}}, kFriend).address, "/done");
  EXPECT_FALSE(muted_);
  EXPECT_EQ(ask({"/mute", {2}}).address, "/fail");
}

TEST_F(ControlTest, SetsAndGetsByName) {
  const auto value = [](float q) { return Message{"/value", {std::string("impact/q"), q}}; };
  EXPECT_EQ(ask({"/get", {std::string("impact/q")}}), value(5.0F));
  EXPECT_EQ(ask({"/set", {std::string("impact/q"), 2.5F}}), value(2.5F));
  EXPECT_EQ(ask({"/get", {std::string("impact/q")}}, kFriend), value(2.5F));
  EXPECT_EQ(ask({"/set", {std::string("impact"), 2.5F}}),
            (Message{"/fail", {std::string("/set"), std::string("no such row")}}));
  EXPECT_EQ(ask({"/get", {std::string("impact")}}).address, "/fail");
  EXPECT_EQ(ask({"/set", {std::string("impact/q"), 7}}).address, "/fail") << "an integer";
  EXPECT_EQ(ask({"/preset", {std::string("calibrated"), 2.0F}}),
            (Message{"/done", {std::string("/preset")}}));
  EXPECT_EQ(ask({"/preset", {std::string("loud"), 2.0F}}).address, "/fail");
  EXPECT_EQ(ask({"/preset", {std::string("calibrated"), 601.0F}}).address, "/fail");
}

TEST_F(ControlTest, TellsItsClientsWhatHasChanged) {
  std::vector<Reply> told;
  control_.tell_changes(told);
  EXPECT_TRUE(told.empty()) << "there are none";
  (void)ask({"/notify", {1}});
  (void)ask({"/notify", {1}}, kFriend);
  (void)ask({"/set", {std::string("impact/q"), 3.0F}}, kFriend);
  control_.tell_changes(told);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].to, kLocal);
  EXPECT_EQ(told[1].to, kFriend);
  EXPECT_EQ(told[0].message, (Message{"/value", {std::string("impact/q"), 3.0F}}));
}

TEST_F(ControlTest, StatusJoinsBothSides) {
  const auto status = protocol::to_synth_status(ask({"/status", {}}));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->events, 42U);
  EXPECT_EQ(status->voices, 7U);
}

TEST_F(ControlTest, AnswersLikeSuperCollider) {
  EXPECT_EQ(ask({"/version", {}}).address, "/version.reply");
  EXPECT_EQ(ask({"/sync", {77}}), (Message{"/synced", {77}}));
  EXPECT_EQ(ask({"/error", {0}}), (Message{"/done", {std::string("/error")}}));
  EXPECT_FALSE(control_.reports_failures());
  EXPECT_EQ(ask({"/dumpOSC", {3}}).address, "/done");
  EXPECT_EQ(control_.dump_level(), 3);
  EXPECT_EQ(ask({"/clearSched", {}}), (Message{"/done", {std::string("/clearSched")}}));
  EXPECT_EQ(cleared_, 1);
}

TEST_F(ControlTest, PongCarriesTheStamps) {
  const protocol::TimeTag sent{0x1234567800000001};
  const Message pong = ask({"/ping", {sent}});
  ASSERT_EQ(pong.address, "/pong");
  EXPECT_EQ(std::get<protocol::TimeTag>(pong.arguments[0]), sent);
  EXPECT_NEAR(protocol::to_unix_seconds(std::get<protocol::TimeTag>(pong.arguments[1])),
              1.8e9 + now_, 1e-5);
  EXPECT_NEAR(protocol::to_unix_seconds(std::get<protocol::TimeTag>(pong.arguments[2])),
              protocol::unix_now(), 1.0);
}

TEST_F(ControlTest, FailsWhatItDoesNotKnow) {
  for (const Message& message :
       {Message{"/unheard", {}}, Message{"/sync", {}}, Message{"/dumpOSC", {4}},
        Message{"/body/pose", {1}}, Message{"/force", {}}}) {
    const Message reply = ask(message);
    EXPECT_EQ(reply.address, "/fail");
    ASSERT_EQ(reply.arguments.size(), 2U);
    EXPECT_EQ(std::get<std::string>(reply.arguments[0]), message.address);
    EXPECT_FALSE(std::get<std::string>(reply.arguments[1]).empty());
  }
  EXPECT_EQ(control_.dump_level(), 0);
}

TEST_F(ControlTest, FailsCommandsForTheSimulator) {
  const Message pose = protocol::to_message(protocol::BodyPose{});
  EXPECT_EQ(ask(pose).address, "/fail");
}

TEST_F(ControlTest, QuitsOnlyForItsOwnHost) {
  EXPECT_EQ(ask({"/quit", {}}, kFriend).address, "/fail");
  EXPECT_EQ(quits_, 0);
  EXPECT_EQ(ask({"/quit", {}}), (Message{"/done", {std::string("/quit")}}));
  EXPECT_EQ(quits_, 1);
}

TEST_F(ControlTest, SaysGoodbyeToItsClients) {
  EXPECT_EQ(ask({"/notify", {1}}), (Message{"/done", {std::string("/notify"), 1}}));
  EXPECT_EQ(ask({"/notify", {1}}), (Message{"/done", {std::string("/notify"), 1}})) << "once each";
  EXPECT_EQ(ask({"/notify", {1}}, kFriend), (Message{"/done", {std::string("/notify"), 2}}));
  EXPECT_EQ(ask({"/notify", {0}}).address, "/done");
  std::vector<Reply> replies;
  control_.say_goodbye(replies);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].to, kFriend);
  EXPECT_EQ(replies[0].message, (Message{"/done", {std::string("/quit")}}));
}

TEST_F(ControlTest, LimitsRepliesAndPongsApart) {
  std::vector<Reply> replies;
  protocol::ReplyBudget budget(kLocal, 0);
  const Arrived arrived{kLocal, 1.0, 1.0, budget};
  for (int i = 0; i < 100; ++i) control_.handle({"/version", {}}, arrived, {}, replies);
  EXPECT_EQ(replies.size(), 10U);
  EXPECT_EQ(control_.withheld(), 90U);
  for (int i = 0; i < 200; ++i) {
    control_.handle({"/ping", {protocol::TimeTag{5}}}, arrived, {}, replies);
  }
  EXPECT_EQ(replies.size(), 110U);
  EXPECT_EQ(control_.withheld(), 190U);
}

}  // namespace
}  // namespace splash::synth
