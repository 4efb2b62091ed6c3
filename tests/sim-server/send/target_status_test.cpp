// SPDX-License-Identifier: MIT
// Questions and answers with synths of the test's own making: present, silent, restarted, lying.
#include "sim-server/send/target_status.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "protocol/message.hpp"
#include "tests/sim-server/send/peer.hpp"
#include "tests/support/own_address.hpp"

namespace splash::sim {
namespace {

using protocol::SynthStatus;
using test::Peer;

class TargetStatusTest : public testing::Test {
 protected:
  /// Takes the question that lies in the synth's socket and answers it.
  static void answer(Peer& synth, const SynthStatus& status) {
    ASSERT_EQ(synth.message(), (protocol::Message{"/status", {}}));
    synth.send(synth.last_sender(), protocol::to_message(status));
  }
  double now = 100.0;
  Peer synth;
};

TEST_F(TargetStatusTest, AsksOnceASecondAndKeepsTheLastAnswer) {
  TargetStatus status({synth.endpoint()}, [this] { return now; });
  status.poll();
  answer(synth, {.voices = 3, .late = 1, .lost = 2});
  status.poll();
  EXPECT_TRUE(synth.silent());
  now += 0.9;
  status.poll();
  EXPECT_TRUE(synth.silent());
  now += 0.2;
  status.poll();
  answer(synth, {.voices = 5, .late = 4, .lost = 2});
  status.poll();
  EXPECT_EQ(status.answers().at(0).last.value().voices, 5U);
  EXPECT_EQ(status.answers().at(0).answers, 2U);
  EXPECT_EQ(status.late(), 4U);
  EXPECT_EQ(status.lost(), 2U);
}

TEST_F(TargetStatusTest, SilenceIsNotZero) {
  TargetStatus status({synth.endpoint()});
  status.begin(0.01);
  status.poll();
  status.finish(0.01);
  EXPECT_EQ(status.late(), std::nullopt);
  EXPECT_EQ(status.lost(), std::nullopt);
}

TEST_F(TargetStatusTest, ReportsOnceThatATargetIsSilentAndThatItAnswersAgain) {
  std::vector<std::string> lines;
  TargetStatus status(
      {synth.endpoint()}, [this] { return now; },
      [&](const std::string& line) { lines.push_back(line); });
  const auto poll_after_a_second = [&] {
    now += 1.1;
    status.poll();
  };
  const std::string where = protocol::to_string(synth.endpoint());
  status.poll();
  poll_after_a_second();
  EXPECT_TRUE(lines.empty()) << "one answer may be lost on the way";
  for (int i = 0; i < 5; ++i) poll_after_a_second();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "no answer from " + where +
                          ": start synth-server or a Pd patch there; unless told otherwise both "
                          "listen on port 57310");
  answer(synth, {.voices = 1});
  status.poll();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1], where + " answers");
}

TEST_F(TargetStatusTest, WhatWasCountedBeforeTheRunIsNotTheRuns) {
  TargetStatus status({synth.endpoint()});
  std::thread synth_thread([&] {
    answer(synth, {.late = 100, .lost = 50});
    answer(synth, {.late = 103, .lost = 50});
  });
  status.begin(test::kTimeout);
  status.finish(test::kTimeout);
  synth_thread.join();
  EXPECT_EQ(status.late(), 3U);
  EXPECT_EQ(status.lost(), 0U);
}

TEST_F(TargetStatusTest, ARestartedSynthLosesNothingItHadTold) {
  TargetStatus status({synth.endpoint()}, [this] { return now; });
  for (const std::uint64_t late : {5U, 9U, 2U, 3U}) {  // restarted after 9
    status.poll();
    answer(synth, {.late = late});
    status.poll();
    now += 1.1;
  }
  EXPECT_EQ(status.late(), 9U + 3U);
}

// Only then may it answer: its reply must not be longer than the question.
TEST(TargetStatusAfar, AsksInAsManyBytesAsAnyReplyHas) {
  const auto address = tests::own_address();
  if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
  Peer synth(*address);
  TargetStatus status({synth.endpoint()});
  status.poll();
  const auto datagram = synth.bytes();
  ASSERT_TRUE(datagram);
  EXPECT_GE(datagram->size(), protocol::encode(protocol::to_message(SynthStatus{})).size());
  const auto questions = protocol::decode(*datagram).packet.messages;
  ASSERT_EQ(questions.size(), 1U);
  EXPECT_EQ(questions[0].address, "/status");
  EXPECT_EQ(protocol::violation(questions[0]), std::nullopt);
}

TEST_F(TargetStatusTest, SumsOverThoseWhoAnswer) {
  Peer second;
  Peer mute;
  TargetStatus status({synth.endpoint(), second.endpoint(), mute.endpoint(), synth.endpoint()});
  status.poll();
  answer(synth, {.late = 1, .lost = 10});
  answer(second, {.late = 2, .lost = 20});
  status.poll();
  EXPECT_EQ(status.answers().size(), 3U);
  EXPECT_EQ(status.late(), 3U);
  EXPECT_EQ(status.lost(), 30U);
}

TEST_F(TargetStatusTest, StrangersAndNonsenseAreNotBelieved) {
  TargetStatus status({synth.endpoint()});
  status.poll();
  ASSERT_EQ(synth.message().address, "/status");
  const auto asker = synth.last_sender();
  Peer stranger;
  stranger.send(asker, protocol::to_message(SynthStatus{.late = 9}));
  synth.send(asker, std::vector<std::byte>(7));
  synth.send(asker, std::vector<std::byte>{});
  synth.send(asker, protocol::encode(protocol::TimeTag{1}, {}));
  synth.send(asker, protocol::Message{"/status.reply", {1}});
  synth.send(asker, protocol::to_message(protocol::SimStatus{}));
  status.poll();
  EXPECT_EQ(status.late(), std::nullopt);
}

}  // namespace
}  // namespace splash::sim
