// SPDX-License-Identifier: MIT
// The control port without a program: what it answers itself, whom, how often and in how many
// bytes, and what it says in the log.
#include "protocol/control_port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "protocol/control.hpp"
#include "protocol/event.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/status.hpp"

namespace splash::protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Endpoint kHere{INADDR_LOOPBACK, 9000};
constexpr Endpoint kFriend{0x0A000005, 9000};
constexpr Endpoint kStranger{0x0A000006, 9000};

class ControlPortTest : public testing::Test {
 protected:
  ControlPortTest()
      : port_({.program = kSimProgram,
               .allowed = {kFriend.address},
               .print = [this](const std::string& line) { lines_.push_back(line); }},
              [this] { ++quits_; }) {
    port_.on("/pause", [this](const Message& message, const Visit&) {
      if (broken_) throw std::runtime_error("the device is gone");
      paused_ = std::get<std::int32_t>(message.arguments.front()) != 0;
      return done_unless(refusal_, message);
    });
    port_.on("/body/pose", [this](const Message&, const Visit&) {
      ++poses_;
      return Outcome{};
    });
  }

  /// All replies to a datagram that holds one message; a second later, so that no rate is met.
  std::vector<Reply> ask_all(const Message& message, const Endpoint& from = kHere) {
    now_ += 1.0;
    const std::vector<std::byte> bytes = encode(message);
    std::vector<Reply> replies;
    if (!port_.inspect(bytes, decode(bytes), from, now_)) return replies;
    Visit visit{from, now_, 1.8e9 + now_, {}, {from, bytes.size()}};
    port_.take(message, visit, replies);
    return replies;
  }
  /// The only reply; a message without an address when there is none.
  Message ask(const Message& message, const Endpoint& from = kHere) {
    const auto replies = ask_all(message, from);
    EXPECT_LE(replies.size(), 1U);
    if (replies.empty()) return {};
    EXPECT_EQ(replies[0].to, from);
    EXPECT_FALSE(violation(replies[0].message)) << message.address;
    return replies[0].message;
  }
  static std::string reason(const Message& reply) {
    return reply.address == "/fail" ? std::get<std::string>(reply.arguments.at(1)) : "no /fail";
  }

  double now_ = 100.0;
  std::vector<std::string> lines_;
  std::string refusal_;
  bool broken_ = false;
  bool paused_ = false;
  int poses_ = 0;
  int quits_ = 0;
  ControlPort port_;
};

TEST_F(ControlPortTest, AnswersWhatEveryProgramAnswersAlike) {
  EXPECT_EQ(ask({"/version", {}}), version_reply(kSimProgram));
  EXPECT_EQ(ask({"/sync", {-5}}), synced(-5));
  EXPECT_EQ(ask({"/dumpOSC", {0}}), done("/dumpOSC"));
  EXPECT_EQ(ask({"/error", {1}}), done("/error"));
}

TEST_F(ControlPortTest, PongCarriesTheStamps) {
  const TimeTag sent{0x1234567800000001};
  const Message pong = ask(ping(sent));
  ASSERT_EQ(pong.address, "/pong");
  EXPECT_EQ(std::get<TimeTag>(pong.arguments[0]), sent);
  EXPECT_NEAR(to_unix_seconds(std::get<TimeTag>(pong.arguments[1])), 1.8e9 + now_, 1e-5);
  EXPECT_NEAR(to_unix_seconds(std::get<TimeTag>(pong.arguments[2])), unix_now(), 1.0);
}

TEST_F(ControlPortTest, OnlyItsOwnHostEndsTheProgram) {
  const auto from_afar = ask(filled_up({"/quit", {}}, kFilledQuestion), kFriend);
  EXPECT_EQ(from_afar, fail("/quit", "only from the program's own host"));
  EXPECT_EQ(quits_, 0);
  EXPECT_EQ(ask({"/quit", {}}), done("/quit"));
  EXPECT_EQ(quits_, 1);
}

TEST_F(ControlPortTest, CarriesOutTheProgramsOwnCommands) {
  EXPECT_EQ(ask({"/pause", {1}}), done("/pause"));
  EXPECT_TRUE(paused_);
  refusal_ = "there is no water";
  EXPECT_EQ(ask({"/pause", {0}}), fail("/pause", "there is no water"));
  EXPECT_THAT(ask_all(to_message(BodyPose{})), IsEmpty()) << "poses have no reply";
  EXPECT_EQ(poses_, 1);
}

TEST_F(ControlPortTest, AnExceptionIsAnsweredAndSurvived) {
  broken_ = true;
  EXPECT_EQ(reason(ask({"/pause", {1}})), "the device is gone");
  broken_ = false;
  EXPECT_EQ(ask({"/pause", {1}}), done("/pause"));
}

TEST_F(ControlPortTest, RefusesWhatBreaksTheTableAndCountsIt) {
  EXPECT_EQ(reason(ask({"/dumpOSC", {7}})), "level 7, allowed 0 to 3");
  EXPECT_THAT(reason(ask({"/sync", {1.5F}})), HasSubstr("expected ,i"));
  EXPECT_THAT(reason(ask({"/statsu", {}})), "unknown command");
  EXPECT_EQ(reason(ask({"/pasue", {1}})), "unknown command, did you mean /pause?");
  EXPECT_EQ(port_.counts().out_of_table, 4U);
  EXPECT_EQ(port_.counts().failed, 4U);
  EXPECT_EQ(port_.violations("/dumpOSC"), 1U);
  EXPECT_EQ(port_.violations("/statsu"), 0U);
}

TEST_F(ControlPortTest, NamesTheOtherProgramsCommandsAsSuch) {
  EXPECT_EQ(reason(ask({"/mute", {1}})), "not a command of sim-server");
  EXPECT_EQ(port_.counts().failed, 1U);
  EXPECT_EQ(port_.counts().out_of_table, 0U);
}

TEST_F(ControlPortTest, NeverAnswersRepliesAndEvents) {
  for (const Message& message :
       {done("/x"), fail("/x", "y"), synced(1), version_reply(kSynthProgram),
        to_message(SimStatus{}), to_message(Frame{.session = 1}), to_message(Bubble{}),
        Message{"/force", {0, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}}}) {
    EXPECT_THAT(ask_all(message), IsEmpty()) << message.address;
  }
  EXPECT_EQ(port_.counts().unasked, 8U);
  EXPECT_EQ(port_.counts().failed, 0U);
}

TEST_F(ControlPortTest, OffersOtherAddressesToTheProgram) {
  port_.on_others([](const Message& message, const Visit&) { return message.address == "/hand"; });
  EXPECT_THAT(ask_all({"/hand", {1.0F}}), IsEmpty());
  EXPECT_EQ(port_.counts().failed, 0U);
  EXPECT_EQ(reason(ask({"/foot", {1.0F}})), "unknown command");
}

TEST_F(ControlPortTest, KnowsWhichCommandsOfTheTableAreMissing) {
  EXPECT_THAT(port_.missing(), ElementsAre("/body/grab", "/notify", "/status", "/clearSched",
                                           "/reset", "/param", "/scene"));
  EXPECT_THROW(port_.on("/nosuch", {}), std::logic_error);
}

TEST_F(ControlPortTest, HearsItsOwnHostAndThoseNamed) {
  EXPECT_TRUE(port_.allows(kHere));
  EXPECT_TRUE(port_.allows({0x7F000102, 1})) << "127.0.1.2";
  EXPECT_TRUE(port_.allows(kFriend));
  EXPECT_FALSE(port_.allows(kStranger));
  port_.turn_away(kStranger, now_);
  EXPECT_EQ(port_.counts().not_allowed, 1U);
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("10.0.0.6:9000 not heard")));
}

TEST_F(ControlPortTest, LimitsRepliesAndPongsApart) {
  std::vector<Reply> replies;
  Visit visit{kHere, 1.0, 1.0, {}, {kHere, 0}};
  for (int i = 0; i < 100; ++i) port_.take({"/version", {}}, visit, replies);
  EXPECT_EQ(replies.size(), 40U);
  for (int i = 0; i < 200; ++i) port_.take(ping(TimeTag{5}), visit, replies);
  EXPECT_EQ(replies.size(), 140U);
  EXPECT_EQ(port_.counts().replies, 140U);
  EXPECT_EQ(port_.counts().withheld, 160U);
}

TEST_F(ControlPortTest, AShortRequestOfAnotherHostIsObeyedButNotAnswered) {
  EXPECT_THAT(ask_all({"/pause", {1}}, kFriend), IsEmpty());
  EXPECT_TRUE(paused_);
  EXPECT_EQ(port_.counts().withheld, 1U);
  EXPECT_THAT(lines_, ElementsAre("10.0.0.5:9000 asked /pause in a datagram of 16 bytes; the reply "
                                  "has 20 bytes and was not sent. Fill the question up with text "
                                  "to 20 bytes (protocol/README.md, 'Who is answered')"));
  EXPECT_EQ(ask(filled_up({"/pause", {0}}, 20), kFriend), done("/pause"));
}

TEST_F(ControlPortTest, DumpsWhatComes) {
  EXPECT_EQ(ask({"/dumpOSC", {3}}), done("/dumpOSC"));
  EXPECT_THAT(lines_, IsEmpty());
  static_cast<void>(ask({"/sync", {7}}));
  EXPECT_THAT(lines_, ElementsAre("127.0.0.1:9000 2f 73 79 6e 63 00 00 00 2c 69 00 00 00 00 00 07",
                                  "127.0.0.1:9000 /sync ,i 7"));
  lines_.clear();
  EXPECT_EQ(ask({"/dumpOSC", {1}}), done("/dumpOSC"));
  lines_.clear();
  const std::vector<std::byte> broken(3);
  EXPECT_FALSE(port_.inspect(broken, decode(broken), kHere, now_));
  EXPECT_THAT(lines_, ElementsAre(HasSubstr(" refused: "), HasSubstr(" datagram refused: ")));
  EXPECT_EQ(port_.counts().refused[static_cast<std::size_t>(Refusal::not_aligned)], 1U);
}

TEST_F(ControlPortTest, ErrorTurnsReportsOffAndOn) {
  static_cast<void>(ask({"/nosuch", {}}));
  EXPECT_EQ(lines_.size(), 1U);
  EXPECT_EQ(ask({"/error", {0}}), done("/error"));
  static_cast<void>(ask({"/nosuch", {}}));
  EXPECT_EQ(lines_.size(), 1U);
  EXPECT_EQ(ask({"/error", {1}}), done("/error"));
  static_cast<void>(ask({"/nosuch", {}}));
  EXPECT_EQ(lines_.size(), 2U);
}

TEST_F(ControlPortTest, ReportsAFloodABoundedNumberOfTimes) {
  for (int i = 0; i < 1000; ++i) port_.report(kFriend, "is wrong", now_ + 1e-2 * i);
  EXPECT_NEAR(static_cast<double>(lines_.size()), kReportBurst + 10.0 * kReportRate, 1.0);
}

TEST(PacketText, ShowsEveryTypeWithAllItsDigits) {
  EXPECT_EQ(
      to_text({"/x", {std::int32_t{-3}, 0.000610F, std::string("a b"), TimeTag{0x100000002}}}),
      "/x ,ifst -3 0.000609999988 \"a b\" 00000001.00000002");
  EXPECT_EQ(to_text({"/status", {}}), "/status ,");
}

TEST(PacketText, ShowsTheTimeOfItsBundle) {
  EXPECT_EQ(to_text({"/x", {}}, TimeTag{1}), "00000000.00000001 /x ,");
}

TEST(PacketText, ShowsBytes) {
  const std::array<std::byte, 3> bytes{std::byte{0x2F}, std::byte{0}, std::byte{0xFA}};
  EXPECT_EQ(to_hexadecimal(bytes), "2f 00 fa");
  EXPECT_EQ(to_hexadecimal({}), "");
}

}  // namespace
}  // namespace splash::protocol
