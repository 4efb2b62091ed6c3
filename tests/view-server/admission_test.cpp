// SPDX-License-Identifier: MIT
#include "view-server/admission.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/address.hpp"

namespace splash::view {
namespace {

TEST(Admission, OnlyPagesOfItsOwnAreHeard) {
  const std::vector<std::string> ours = {"splash.example:8080"};
  EXPECT_TRUE(is_own("127.0.0.1:8080", "", ours));
  EXPECT_TRUE(is_own("localhost:9000", "http://localhost:9000", ours));
  EXPECT_TRUE(is_own("192.168.0.7", "http://192.168.0.7", ours));
  EXPECT_TRUE(is_own("splash.example:8080", "https://splash.example:8080", ours));
  EXPECT_FALSE(is_own("", "", ours));
  EXPECT_FALSE(is_own("evil.example:8080", "", ours)) << "a name that leads to this host";
  EXPECT_FALSE(is_own("evil.example:8080", "http://evil.example:8080", ours));
  EXPECT_FALSE(is_own("127.0.0.1:8080", "http://evil.example", ours));
  EXPECT_FALSE(is_own("127.0.0.1:8080", "http://127.0.0.1:8081", ours));
  EXPECT_FALSE(is_own("127.0.0.1:8080", "null", ours));
  EXPECT_FALSE(is_own("127.0.0.1.evil.example:8080", "", ours));
}

Way way_of(const protocol::Message& message) {
  return admit(protocol::encode(message)).way;
}

TEST(Admission, CommandsGoWhereTheyBelong) {
  using protocol::BodyPose;
  EXPECT_EQ(way_of(protocol::to_message(BodyPose{0, {0.0F, 0.0F, 0.0F}, 0.0F, 0.0F, 0.0F, 1.0F})),
            Way::sim);
  EXPECT_EQ(way_of({"/body/grab", {3, 1}}), Way::sim);
  EXPECT_EQ(way_of({"/mute", {1}}), Way::synth);
  EXPECT_EQ(way_of({"/tone", {7}}), Way::synth);
  EXPECT_EQ(way_of({"/pause", {1}}), Way::sim);
  EXPECT_EQ(way_of({"/reset", {}}), Way::sim);
  EXPECT_EQ(way_of({"/param", {"detect/bubble_speed", 0.7F}}), Way::sim);
  EXPECT_EQ(way_of({"/param", {"detect/bubble_speed"}}), Way::sim);
  EXPECT_EQ(way_of({"/scene", {"pool"}}), Way::sim);
  EXPECT_EQ(way_of({"/rig", {"tiles36"}}), Way::synth);
  EXPECT_EQ(way_of({"/clearSched", {}}), Way::both);
  EXPECT_EQ(way_of({"/ping", {protocol::TimeTag{5}}}), Way::here);
}

TEST(Admission, APoseMaySayWhenItWasMade) {
  const protocol::Message pose =
      protocol::to_message(protocol::BodyPose{0, {0.0F, 0.0F, 0.0F}, 0.0F, 0.0F, 0.0F, 1.0F});
  const Admitted admitted = admit(protocol::encode(protocol::TimeTag{77}, {pose}));
  EXPECT_EQ(admitted.way, Way::sim);
  ASSERT_TRUE(admitted.made);
  EXPECT_EQ(admitted.made->value, 77U);
  EXPECT_EQ(admit(protocol::encode(protocol::TimeTag{77}, {pose, pose})).way, Way::refused);
}

TEST(Admission, EverythingElseStaysOut) {
  for (const protocol::AddressRow& row : protocol::address_table()) {
    const std::string name(row.address);
    const bool allowed = name == "/body/grab" || name == "/body/pose" || name == "/mute" ||
                         name == "/set" || name == "/get" || name == "/preset" ||
                         name == "/clearSched" || name == "/pause" || name == "/reset" ||
                         name == "/tone" || name == "/ping" || name == "/param" ||
                         name == "/scene" || name == "/rig";
    EXPECT_TRUE(allowed || way_of({name, {}}) == Way::refused) << name;
  }
  EXPECT_EQ(way_of({"/mute", {2}}), Way::refused) << "out of range";
  EXPECT_EQ(way_of({"/mute", {1.0F}}), Way::refused) << "another type";
  EXPECT_EQ(admit({}).way, Way::refused);
  const auto bundle = protocol::encode(protocol::kImmediately, {{"/mute", {1}}});
  EXPECT_EQ(admit(bundle).way, Way::refused);
}

}  // namespace
}  // namespace splash::view
