// SPDX-License-Identifier: MIT
// What another host draws from the synth is never longer than what it sent, in one datagram or
// bundle, now or when the synth ends; this host is answered whatever it sends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "synth-server/receive/receiver.hpp"
#include "tests/support/own_address.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::Endpoint;
using protocol::Message;
using testing::HasSubstr;

constexpr Endpoint kHere{INADDR_LOOPBACK, 9000};
constexpr Endpoint kFriend{0x0A000005, 9000};
constexpr std::size_t kHeaders = 28;  // of IPv4 and UDP [bytes]

ControlActions actions(bool& muted, std::function<void(const std::string&)> print) {
  return {.clear_scheduled = [] {},
          .mute = [&muted](bool on) { muted = on; },
          .set = [](const std::string&, double) { return std::string(); },
          .preset = [](const std::string&, double) { return std::string(); },
          .get = [](const std::string&) { return std::optional(2.0); },
          .print = std::move(print)};
}

std::size_t bytes_of(const std::vector<Reply>& replies) {
  std::size_t bytes = 0;
  for (const Reply& reply : replies) bytes += protocol::encode(reply.message).size() + kHeaders;
  return bytes;
}

class SynthReplyLength : public testing::Test {
 protected:
  /// What the datagram draws; a second later, so that no limit of rate is met.
  std::vector<Reply> drawn_by(const std::vector<std::byte>& datagram,
                              const Endpoint& from = kFriend) {
    std::vector<Reply> replies;
    now_ += 1.0;
    intake_.datagram(datagram, from, now_, replies);
    if (from == kFriend) {
      EXPECT_LE(bytes_of(replies), datagram.size() + kHeaders);
    }
    return replies;
  }
  std::vector<Reply> drawn_by(const Message& message, const Endpoint& from = kFriend) {
    return drawn_by(protocol::encode(message), from);
  }

  bool muted_ = false;
  double now_ = 5000.0;
  CommandQueue queue_;
  std::vector<std::string> lines_;
  Intake intake_{queue_,
                 actions(muted_, [this](const std::string& line) { lines_.push_back(line); }),
                 {kFriend.address}};
};

TEST_F(SynthReplyLength, AShortQuestionIsObeyedButNotAnswered) {
  EXPECT_TRUE(drawn_by({"/mute", {1}}).empty());
  EXPECT_TRUE(muted_) << "obeyed";
  EXPECT_EQ(intake_.counters().withheld, 1U);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(
      lines_[0],
      "10.0.0.5:9000 asked /mute in a datagram of 16 bytes; the reply has 20 bytes and was not "
      "sent. Fill the question up with text to 20 bytes (protocol/README.md, 'Who is "
      "answered')");
}

TEST_F(SynthReplyLength, EachCommandIsAnsweredAsSoonAsItIsAsLongAsItsAnswer) {
  for (const Message& command :
       {Message{"/status", {}}, Message{"/version", {}}, Message{"/clearSched", {}},
        Message{"/sync", {1}}, Message{"/mute", {0}}, Message{"/dumpOSC", {0}},
        Message{"/error", {1}}, Message{"/notify", {0}}, Message{"/get", {std::string("impact/q")}},
        Message{"/set", {std::string("impact/q"), 2.0F}},
        Message{"/preset", {std::string("calibrated"), 1.0F}}, protocol::ping({5})}) {
    const auto at_home = drawn_by(command, kHere);
    ASSERT_EQ(at_home.size(), 1U) << command.address << " of this host";
    const std::size_t size = protocol::encode(at_home[0].message).size();
    const auto filled = drawn_by(protocol::filled_up(command, size));
    ASSERT_EQ(filled.size(), 1U) << command.address;
    EXPECT_EQ(protocol::encode(filled[0].message).size(), size) << command.address;
    if (size <= protocol::encode(command).size()) continue;
    EXPECT_TRUE(drawn_by(command).empty()) << command.address;
  }
}

TEST_F(SynthReplyLength, AllRepliesToABundleTogetherAreNoLonger) {
  std::vector<Message> commands(5, Message{"/sync", {1}});
  commands.push_back({"/status", {}});
  commands.push_back({"/sync", {2}});
  const auto bundle = protocol::encode(protocol::kImmediately, commands);
  ASSERT_EQ(bundle.size(), 152U);
  const auto replies = drawn_by(bundle);
  EXPECT_EQ(replies.size(), 4U) << "4 x 44 is 176, the bundle has 180 with its headers";
  EXPECT_EQ(intake_.counters().withheld, 3U);
}

TEST_F(SynthReplyLength, AFrameAndACommandShareTheirBundle) {
  const Message frame = protocol::to_message(protocol::Frame{1, 0, 0, 0.0F});
  const auto replies = drawn_by(protocol::encode(protocol::kImmediately, {frame, {"/status", {}}}));
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].message.address, "/ping");
}

// The goodbye counts when it is asked for: it would go to a forged address as any reply.
TEST_F(SynthReplyLength, WhoAsksTooShortlyForAGoodbyeGetsNone) {
  for (std::size_t bytes = 16; bytes < 20 + kHeaders + 24; bytes += 4) {
    EXPECT_TRUE(drawn_by(protocol::filled_up({"/notify", {1}}, bytes)).empty()) << bytes;
    ASSERT_FALSE(lines_.empty());
    EXPECT_THAT(lines_.back(), HasSubstr("with text to 72 bytes"));
  }
  std::vector<Reply> goodbyes;
  intake_.say_goodbye(goodbyes);
  EXPECT_TRUE(goodbyes.empty());
  EXPECT_EQ(drawn_by(protocol::filled_up({"/notify", {1}}, 72)).size(), 1U);
  intake_.say_goodbye(goodbyes);
  EXPECT_EQ(goodbyes.size(), 1U);
}

TEST(SynthTells, WhoseQuestionWasTooShortABoundedNumberOfTimes) {
  const auto address = tests::own_address();
  if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
  std::mutex mutex;
  std::vector<std::string> lines;
  bool muted = false;
  CommandQueue queue;
  protocol::UdpSocket asker({*address, 0});
  {
    const auto print = [&](const std::string& line) {
      const std::lock_guard lock(mutex);
      lines.push_back(line);
    };
    Receiver receiver(protocol::UdpSocket({*address, 0}), queue, actions(muted, print), {*address});
    const double start = protocol::monotonic_now();
    for (std::uint64_t i = 1; i <= 100; ++i) {
      asker.send_to(receiver.local(), protocol::encode(Message{"/status", {}}));
      ASSERT_TRUE(tests::eventually([&] { return receiver.counters().withheld >= i; }));
    }
    EXPECT_EQ(receiver.counters().withheld, 100U);
    const std::lock_guard lock(mutex);
    ASSERT_GE(lines.size(), 1U);
    EXPECT_LE(static_cast<double>(lines.size()),
              protocol::kReportBurst + protocol::kReportRate * (protocol::monotonic_now() - start));
    EXPECT_EQ(lines[0], protocol::to_string(asker.local()) +
                            " asked /status in a datagram of 12 bytes; the reply has 116 bytes and "
                            "was not sent. Fill the question up with text to 116 bytes "
                            "(protocol/README.md, 'Who is answered')");
  }
  std::byte buffer[64];
  EXPECT_FALSE(asker.receive(buffer, sizeof buffer, 0.1));
}

}  // namespace
}  // namespace splash::synth
