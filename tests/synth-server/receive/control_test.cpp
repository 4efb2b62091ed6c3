// SPDX-License-Identifier: MIT
#include "synth-server/receive/control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"

namespace splash::synth {
namespace {

using protocol::Message;

constexpr protocol::Endpoint kLocal{INADDR_LOOPBACK, 9000};
constexpr protocol::Endpoint kFriend{0x0A000005, 9000};

class ControlTest : public testing::Test {
 protected:
  ControlTest()
      : control_(actions(), {kFriend.address}, [] {
          protocol::SynthStatus status;
          status.events = 42;
          return status;
        }) {}

  ControlActions actions() {
    return {
        .status =
            [](protocol::SynthStatus status) {
              status.voices = 7;
              return status;
            },
        .clear_scheduled = [this] { ++cleared_; },
        .quit = [this] { ++quits_; },
        .mute = [this](bool on) { muted_ = on; },
        .set =
            [this](const std::string& name, double value) {
              if (name != "impact/q") return std::string("no such row");
              q_ = value;
              return std::string();
            },
        .preset =
            [](const std::string& name, double /*seconds*/) {
              return std::string(name == "calibrated" ? "" : "no sound is called so");
            },
        .get =
            [this](const std::string& name) {
              return name == "impact/q" ? std::optional(q_) : std::nullopt;
            },
        .changes =
            [this](std::size_t most) {
              std::vector<ControlActions::Value> all(std::min<std::size_t>(most, 1));
              all[0] = {"impact/q", q_};
              return all;
            },
        .tone = [](int channel) { return std::string(channel > 2 ? "there are 2 channels" : ""); }};
  }
  /// The one reply; a second later for each command, so that no limit of rate is met.
  Message ask(const Message& message, const protocol::Endpoint& from = kLocal) {
    std::vector<Reply> replies;
    now_ += 1.0;
    const Message question = from == kLocal ? message : protocol::filled_up(message, 256);
    protocol::Visit visit{from, now_, 1.8e9 + now_, {}, {from, protocol::encode(question).size()}};
    control_.port().take(question, visit, replies);
    EXPECT_EQ(replies.size(), 1U) << message.address;
    if (replies.empty()) return {};
    EXPECT_EQ(replies.front().to, from);
    EXPECT_EQ(protocol::violation(replies.front().message), std::nullopt) << message.address;
    return replies.front().message;
  }
  std::size_t subscribers() const {
    std::vector<Reply> goodbyes;
    control_.say_goodbye(goodbyes);
    return goodbyes.size();
  }

  int cleared_ = 0;
  int quits_ = 0;
  bool muted_ = false;
  double q_ = 5.0;
  double now_ = 0.0;
  Control control_;
};

TEST_F(ControlTest, HasEachCommandOfTheTable) {
  EXPECT_THAT(control_.port().missing(), testing::IsEmpty());
}

TEST_F(ControlTest, WhatNothingIsThereForIsRefused) {
  Control control({}, {}, [] { return protocol::SynthStatus{}; });
  for (const Message& message :
       {Message{"/clearSched", {}}, Message{"/mute", {1}}, Message{"/tone", {1}},
        Message{"/quit", {}}, Message{"/get", {std::string("impact/q")}},
        Message{"/set", {std::string("impact/q"), 1.0F}},
        Message{"/preset", {std::string("calibrated"), 1.0F}}}) {
    std::vector<Reply> replies;
    protocol::Visit visit{kLocal, 1.0, 1.0, {}, {kLocal, 0}};
    control.port().take(message, visit, replies);
    ASSERT_EQ(replies.size(), 1U) << message.address;
    EXPECT_EQ(replies[0].message.address, "/fail") << message.address;
  }
}

TEST_F(ControlTest, PlaysTestTones) {
  EXPECT_EQ(ask({"/tone", {2}}), protocol::done("/tone"));
  EXPECT_EQ(ask({"/tone", {3}}), protocol::fail("/tone", "there are 2 channels"));
}

TEST_F(ControlTest, Mutes) {
  EXPECT_EQ(ask({"/mute", {1}}), protocol::done("/mute"));
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
  EXPECT_EQ(ask({"/set", {std::string("impact"), 2.5F}}), protocol::fail("/set", "no such row"));
  EXPECT_EQ(ask({"/get", {std::string("impact")}}).address, "/fail");
  EXPECT_EQ(ask({"/set", {std::string("impact/q"), 7}}).address, "/fail") << "an integer";
  EXPECT_EQ(ask({"/preset", {std::string("calibrated"), 2.0F}}), protocol::done("/preset"));
  EXPECT_EQ(ask({"/preset", {std::string("loud"), 2.0F}}).address, "/fail");
  EXPECT_EQ(ask({"/preset", {std::string("calibrated"), 601.0F}}).address, "/fail");
}

TEST_F(ControlTest, TellsItsSubscribersWhatHasChanged) {
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

TEST_F(ControlTest, ClearsWhatWaits) {
  EXPECT_EQ(ask({"/clearSched", {}}), protocol::done("/clearSched"));
  EXPECT_EQ(cleared_, 1);
}

TEST_F(ControlTest, FailsCommandsForTheSimulator) {
  const Message pose = protocol::to_message(protocol::BodyPose{});
  EXPECT_EQ(ask(pose), protocol::fail("/body/pose", "not a command of synth-server"));
}

TEST_F(ControlTest, QuitsOnlyForItsOwnHost) {
  EXPECT_EQ(ask({"/quit", {}}, kFriend).address, "/fail");
  EXPECT_EQ(quits_, 0);
  EXPECT_EQ(ask({"/quit", {}}), protocol::done("/quit"));
  EXPECT_EQ(quits_, 1);
}

TEST_F(ControlTest, SaysGoodbyeToItsSubscribers) {
  EXPECT_EQ(ask({"/notify", {1}}), protocol::done("/notify", 1));
  EXPECT_EQ(ask({"/notify", {1}}), protocol::done("/notify", 1)) << "once each";
  EXPECT_EQ(ask({"/notify", {1}}, kFriend), protocol::done("/notify", 1))
      << "the streams, as from the simulator";
  EXPECT_EQ(ask({"/notify", {0}}), protocol::done("/notify", 0));
  EXPECT_EQ(ask({"/notify", {2}}).address, "/fail");
  std::vector<Reply> replies;
  control_.say_goodbye(replies);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].to, kFriend);
  EXPECT_EQ(replies[0].message, protocol::done("/quit"));
}

TEST_F(ControlTest, ASubscriptionEndsUnlessItIsRenewed) {
  static_cast<void>(ask({"/notify", {1}}));
  static_cast<void>(ask({"/notify", {1}}, kFriend));
  const double half = now_ + 0.5 * protocol::kSubscriptionLease;
  control_.expire(half);
  EXPECT_EQ(subscribers(), 2U);
  control_.renew(kFriend, half);
  control_.expire(now_ + protocol::kSubscriptionLease + 1.0);
  EXPECT_EQ(subscribers(), 1U) << "one has said nothing since";
  control_.expire(half + protocol::kSubscriptionLease + 1.0);
  EXPECT_EQ(subscribers(), 0U);
}

TEST_F(ControlTest, SubscribersThatAreGoneMakeRoomForOthers) {
  const auto notify = [&](std::uint16_t port) {
    std::vector<Reply> replies;
    const protocol::Endpoint from{INADDR_LOOPBACK, port};
    protocol::Visit visit{from, now_, 1.8e9, {}, {from, 0}};
    control_.port().take({"/notify", {1}}, visit, replies);
    return replies.at(0).message;
  };
  for (std::uint16_t port = 1; port <= protocol::kMaxSubscribers; ++port) {
    EXPECT_EQ(notify(port).address, "/done");
  }
  EXPECT_EQ(notify(99), protocol::fail("/notify", "full: 16 subscribers"));
  now_ += protocol::kSubscriptionLease + 1.0;
  control_.expire(now_);
  EXPECT_EQ(notify(99).address, "/done");
}

}  // namespace
}  // namespace splash::synth
