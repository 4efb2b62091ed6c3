// SPDX-License-Identifier: MIT
// Packets that crash or hang the libraries, floods and strangers: the control goes on answering.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "tests/protocol/killers.hpp"
#include "tests/sim-server/send/control_fixture.hpp"
#include "tests/support/own_address.hpp"

namespace splash::sim {
namespace {

using protocol::Refusal;

class ControlAbuse : public test::ControlFixture {
 protected:
  /// As settle(), but takes the /fail of what is no command out of the way.
  void settle_after_failures() {
    while (peer_.bytes(0.05)) {
    }
    settle();
  }
};

TEST_F(ControlAbuse, KillersAreRefusedByName) {
  const auto& all = protocol::test::killers();
  decltype(ControlCounts::refused) expected{};
  for (const protocol::test::Killer& killer : all) {
    peer_.send(server_->local(), killer.bytes);
    if (killer.why != Refusal::none) ++expected[static_cast<std::size_t>(killer.why)];
  }
  wait_for_packets(all.size());
  settle_after_failures();
  EXPECT_EQ(server_->counts().refused, expected);
  EXPECT_TRUE(poses().empty());
}

TEST_F(ControlAbuse, AFloodDrawsABoundedNumberOfRepliesAndHarmsNoOther) {
  constexpr int kFlood = 2000;
  test::Peer flooder;
  const double start = protocol::monotonic_now();
  for (int i = 0; i < kFlood; ++i) {
    flooder.send(server_->local(), protocol::Message{"/nosuch", {}});
    if (i % 100 == 0) settle();  // paces the flood to what the server takes; fewer than kBurst
    if (testing::Test::HasFatalFailure()) return;
  }
  settle();
  const double seconds = protocol::monotonic_now() - start;
  int answers = 0;
  while (flooder.bytes(0.0)) ++answers;
  EXPECT_GE(answers, 1);
  EXPECT_LE(answers, protocol::kReplyBurst + protocol::kReplyRate * seconds + 1.0);
  EXPECT_EQ(server_->counts().failed, static_cast<std::uint64_t>(kFlood));
  EXPECT_LE(static_cast<double>(lines().size()),
            protocol::kReportBurst + protocol::kReportRate * seconds + 1.0);
}

TEST_F(ControlAbuse, PosesAreNotLimited) {
  const auto pose = protocol::to_message(protocol::BodyPose{});
  for (int i = 0; i < 500; ++i) tell(pose);
  wait_for_packets(500);
  settle();
  EXPECT_EQ(poses().size(), 500U);
}

class ControlStranger : public ControlAbuse {
 protected:
  void SetUp() override {
    const auto address = tests::own_address();
    if (!address) GTEST_SKIP() << "this machine has no address besides loopback";
    address_ = *address;
  }
  std::uint32_t address_ = 0;
};

TEST_F(ControlStranger, IsNeitherAnsweredNorObeyed) {
  start({.listen = {.address = address_, .port = 0}});
  test::Peer stranger(address_);
  for (const auto& message :
       {protocol::to_message(protocol::BodyPose{}), protocol::Message{"/status", {}},
        protocol::Message{"/quit", {}}, protocol::Message{"/notify", {1}}}) {
    stranger.send(server_->local(), message);
  }
  wait_for_packets(4);
  server_.reset();  // nothing more is under way
  EXPECT_TRUE(stranger.silent());
  EXPECT_TRUE(poses().empty());
  EXPECT_TRUE(targets_.list().empty());
  EXPECT_EQ(quits(), 0);
}

TEST_F(ControlStranger, WhoIsAllowedIsHeardButMayNotQuit) {
  start({.listen = {.address = address_, .port = 0}, .allowed = {address_}});
  test::Peer friendly(address_);
  const auto ask_friendly = [&](const protocol::Message& message) {
    friendly.send(server_->local(), protocol::filled_up(message, protocol::kFilledQuestion));
    return friendly.message();
  };
  EXPECT_EQ(ask_friendly({"/status", {}}).address, "/status.reply");
  EXPECT_EQ(ask_friendly({"/quit", {}}),
            protocol::fail("/quit", "only from the program's own host"));
  EXPECT_EQ(quits(), 0);
}

}  // namespace
}  // namespace splash::sim
