// SPDX-License-Identifier: MIT
// What another host draws from the simulator's control is never longer than what it sent; this host
// is answered whatever it sends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "tests/sim-server/send/control_fixture.hpp"
#include "tests/support/own_address.hpp"

namespace splash::sim {
namespace {

using protocol::Message;
using testing::HasSubstr;

constexpr std::size_t kHeaders = 28;  // of IPv4 and UDP [bytes]

class ReplyLength : public test::ControlFixture {
 protected:
  void SetUp() override {
    const auto address = tests::own_address();
    if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
    start({.listen = {.address = *address, .port = 0}, .allowed = {*address}});
    friendly_.emplace(*address);
  }
  /// A message or a datagram.
  void say(const auto& what) {
    friendly_->send(server_->local(), what);
    wait_for_packets(++said_);
  }

  std::optional<test::Peer> friendly_;
  std::uint64_t said_ = 0;
};

TEST_F(ReplyLength, AShortQuestionIsObeyedButNotAnsweredAndItsAskerIsTold) {
  say(Message{"/clearSched", {}});
  say(Message{"/notify", {1}});
  say(Message{"/status", {}});
  say(protocol::filled_up({"/sync", {9}}, 16));
  EXPECT_EQ(friendly_->message(), protocol::synced(9)) << "and nothing came before it";
  EXPECT_EQ(server_->counts().withheld, 3U);
  EXPECT_EQ(server_->counts().replies, 1U);
  EXPECT_EQ(targets_.list().size(), 1U) << "obeyed";
  const auto told = lines();
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[2],
            protocol::to_string(friendly_->endpoint()) +
                " asked /status in a datagram of 12 bytes; the reply has 108 bytes and was "
                "not sent. Fill the question up with text to 108 bytes (protocol/README.md, "
                "'Who is answered')");
}

TEST_F(ReplyLength, AQuestionAsLongAsItsAnswerIsAnswered) {
  const Message status = protocol::to_message(protocol::SimStatus{});
  const auto filled = protocol::encode(protocol::filled_up({"/status", {}}, 108));
  ASSERT_EQ(filled.size(), protocol::encode(status).size());
  say(filled);
  EXPECT_EQ(friendly_->message().address, "/status.reply");
  say(protocol::filled_up(protocol::ping({5}), 40));
  EXPECT_EQ(friendly_->message().address, "/pong");
  EXPECT_EQ(server_->counts().withheld, 0U);
  EXPECT_TRUE(lines().empty());
}

TEST_F(ReplyLength, ThisHostIsAnsweredWhateverItSends) {
  start({.listen = {}});
  EXPECT_EQ(ask({"/status", {}}).address, "/status.reply");
  EXPECT_EQ(ask(protocol::ping({5})).address, "/pong");
  EXPECT_EQ(server_->counts().withheld, 0U);
}

TEST_F(ReplyLength, AReasonIsCutToTheQuestion) {
  say(Message{"/dumpOSC", {9, 9, 9, 9}});  // 36 bytes
  const Message cut = friendly_->message();
  ASSERT_EQ(cut.address, "/fail");
  EXPECT_EQ(protocol::encode(cut).size(), 36U);
  EXPECT_EQ(std::get<std::string>(cut.arguments.at(1)), "types are ,");
  EXPECT_THAT(lines().at(0), HasSubstr("types are ,iiii, expected ,i")) << "whole in the log";
}

TEST_F(ReplyLength, AllRepliesToABundleTogetherAreNoLonger) {
  std::vector<Message> commands(30, Message{"/sync", {1}});
  commands.push_back({"/status", {}});
  const auto bundle = protocol::encode({1}, commands);
  ASSERT_LT(commands.size(), protocol::kReplyBurst);
  say(bundle);
  std::size_t bytes = 0;
  std::size_t replies = 0;
  for (auto reply = friendly_->bytes(); reply; reply = friendly_->bytes(0.2)) {
    bytes += reply->size() + kHeaders;
    ++replies;
  }
  EXPECT_LE(bytes, bundle.size() + kHeaders);
  EXPECT_EQ(replies, (bundle.size() + kHeaders) / (16 + kHeaders))
      << "as many as there is room for";
  EXPECT_EQ(server_->counts().withheld, commands.size() - replies);
}

TEST_F(ReplyLength, AFloodOfShortQuestionsIsToldABoundedNumberOfTimes) {
  const double start = protocol::monotonic_now();
  for (int i = 0; i < 500; ++i) say(Message{"/status", {}});
  const double seconds = protocol::monotonic_now() - start;
  EXPECT_EQ(server_->counts().withheld, 500U);
  EXPECT_EQ(server_->counts().replies, 0U);
  EXPECT_LE(static_cast<double>(lines().size()),
            protocol::kReportBurst + protocol::kReportRate * seconds + 1.0);
}

}  // namespace
}  // namespace splash::sim
