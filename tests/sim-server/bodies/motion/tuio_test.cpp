// SPDX-License-Identifier: MIT
// Packets as TUIO's senders send them, to feet: where they stand, when they leave, and what lost,
// late and foreign packets do to them.
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "sim-server/bodies/motion/tuio_feet.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"

namespace splash::sim {
namespace {

using protocol::Message;

Scene surface_scene(const std::string& sources) {
  return parse_scene(R"(fluid: {particles: 500}
tank: {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 0.1]}
bodies:
  - name: left
    shape: {size: [0.29, 0.1, 0.07]}
    motion: {kind: touch}
    rest: {position: [0.2, 1.2, 0.035]}
  - name: right
    shape: {size: [0.29, 0.1, 0.07]}
    motion: {kind: touch}
    rest: {position: [0.2, 0.8, 0.035]}
tracking:
  position: [0, 2, 0]
  sources:
)" + sources,
                     "surface.yaml");
}

const std::string kBoth = R"(    - {preset: tuio, body: left, floor: [3, 2]}
    - {preset: tuio, body: right, floor: [3, 2]}
)";

struct Cursor {
  int id;
  float x, y;
};

/// A frame as the reference implementations write it.
std::vector<Message> frame_of(const std::vector<Cursor>& changed, const std::vector<int>& alive,
                              int number, const std::string& source = "") {
  const std::string address = "/tuio/2Dcur";
  std::vector<Message> messages;
  if (!source.empty()) messages.push_back({address, {std::string("source"), source}});
  Message lives = {address, {std::string("alive")}};
  for (const int id : alive) lives.arguments.emplace_back(id);
  messages.push_back(lives);
  for (const Cursor& cursor : changed) {
    messages.push_back(
        {address, {std::string("set"), cursor.id, cursor.x, cursor.y, 0.0F, 0.0F, 0.0F}});
  }
  messages.push_back({address, {std::string("fseq"), number}});
  return messages;
}

class Surface {
 public:
  explicit Surface(const std::string& sources = kBoth) : feet_(surface_scene(sources)) {}

  void take(const std::vector<Message>& messages, double arrival = 0.0) {
    told = 0;
    for (const Message& message : messages) {
      EXPECT_TRUE(feet_.take(message, arrival, [this](const FloorTouch& touch) {
        ++told;
        now[touch.body] = touch;
      }));
    }
  }
  void expect_at(std::size_t body, double x, double y) {
    ASSERT_TRUE(now[body].down) << body;
    EXPECT_LT(length(now[body].place - Vector3{x, y, 0.0}), 1.0e-4) << body;
  }

  std::map<std::size_t, FloorTouch> now;
  int told = 0;

 private:
  TuioFeet feet_;
};

// Cursors 12 at (0.25, 0.5) and 13 at (0.5, 0.75), frame 7 of a source TuioPad@10.0.0.2, at once.
const std::string kBundle =
    "2362756e646c650000000000000000010000002c2f7475696f2f3244637572002c737300736f7572636500005475"
    "696f5061644031302e302e302e3200000000000000242f7475696f2f3244637572002c73696900000000616c6976"
    "650000000000000c0000000d000000342f7475696f2f3244637572002c7369666666666600000000736574000000"
    "000c3e8000003f000000000000000000000000000000000000342f7475696f2f3244637572002c73696666666666"
    "00000000736574000000000d3f0000003f4000000000000000000000000000000000001c2f7475696f2f32446375"
    "72002c736900667365710000000000000007";

std::vector<std::byte> bytes(const std::string& hexadecimal) {
  std::vector<std::byte> packet;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    packet.push_back(static_cast<std::byte>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16)));
  }
  return packet;
}

// The surface is 3 m wide and 2 m deep, its upper left corner at (0, 2).
TEST(Tuio, ReadsAPacketAsItIsSent) {
  Surface surface;
  const auto decoded = protocol::decode(bytes(kBundle));
  ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
  surface.take(decoded.packet.messages);
  surface.expect_at(0, 0.75, 1.0);
  surface.expect_at(1, 1.5, 0.5);
}

TEST(Tuio, ACursorIsAFootWhileItLives) {
  Surface surface;
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 1));
  surface.expect_at(1, 0.3, 0.8);  // the right one waited nearest
  surface.take(frame_of({{4, 0.1F, 0.4F}, {5, 0.5F, 0.6F}}, {4, 5}, 2));
  surface.expect_at(1, 0.3, 1.2);  // it slides, and stays the right one
  surface.expect_at(0, 1.5, 0.8);
  surface.take(frame_of({}, {5}, 3));
  EXPECT_FALSE(surface.now[1].down);
  surface.expect_at(0, 1.5, 0.8);
  surface.take(frame_of({}, {}, 4));
  EXPECT_FALSE(surface.now[0].down);
}

TEST(Tuio, TheFootThatWaitsNearestComesDown) {
  for (const auto& [y, body] : {std::pair{0.45F, 0U}, std::pair{0.55F, 1U}}) {
    Surface surface;
    surface.take(frame_of({{4, 0.1F, y}}, {4}, 1));
    EXPECT_EQ(surface.told, 1);
    EXPECT_TRUE(surface.now[body].down) << body;
  }
}

TEST(Tuio, TheOrderInABundleDoesNotMatter) {
  Surface surface;
  std::vector<Message> messages = frame_of({{4, 0.1F, 0.6F}}, {4}, 1);
  std::swap(messages[0], messages[1]);
  surface.take(messages);
  surface.expect_at(1, 0.3, 0.8);
}

TEST(Tuio, LostAndLatePacketsLeaveNoFootBehind) {
  Surface surface;
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 1));
  // Frame 2, in which 4 left, is lost; frame 3 tells of 5 alone.
  surface.take(frame_of({{5, 0.5F, 0.2F}}, {5}, 3));
  EXPECT_TRUE(surface.now[1].down != surface.now[0].down) << "one foot stands";
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 2));
  EXPECT_EQ(surface.told, 0) << "overtaken by frame 3";
  // The frame in which 6 appeared is lost: where it is, is told when it moves.
  surface.take(frame_of({}, {5, 6}, 5));
  EXPECT_TRUE(surface.now[1].down != surface.now[0].down);
  surface.take(frame_of({{6, 0.5F, 0.9F}}, {5, 6}, 6));
  EXPECT_TRUE(surface.now[1].down && surface.now[0].down);
  surface.take(frame_of({}, {5}, -1));
  EXPECT_TRUE(surface.now[1].down != surface.now[0].down) << "a frame said again has no number";
}

TEST(Tuio, ASenderMayBeStartedAnew) {
  Surface surface;
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 5000));
  surface.take(frame_of({{0, 0.9F, 0.1F}}, {0}, 1));
  EXPECT_EQ(surface.told, 2) << "one is lifted, one is down";
  surface.take(frame_of({{1, 0.9F, 0.1F}}, {1}, 1), 5.0);
  EXPECT_EQ(surface.told, 2) << "after a while any number is the next";
}

TEST(Tuio, ASourceThatHasGoneLeavesItsFeetToOthers) {
  Surface surface;
  surface.take(frame_of({{1, 0.2F, 0.5F}}, {1}, 1, "one"));
  surface.take(frame_of({{1, 0.7F, 0.5F}}, {1}, 1, "two"));
  EXPECT_TRUE(surface.now[0].down && surface.now[1].down);
  surface.take(frame_of({{1, 0.5F, 0.5F}}, {1}, 1, "three"), 2.0);
  EXPECT_EQ(surface.told, 0) << "both feet stand";
  surface.take(frame_of({{2, 0.5F, 0.5F}}, {2}, 2, "three"), 10.0);
  EXPECT_EQ(surface.told, 1) << "nobody has spoken for them since";
}

TEST(Tuio, SourcesAreKeptApart) {
  Surface surface;
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 900, "one"));
  surface.take(frame_of({{4, 0.5F, 0.2F}}, {4}, 3, "two"));
  EXPECT_TRUE(surface.now[1].down && surface.now[0].down);
  surface.take(frame_of({}, {}, 901, "one"));
  EXPECT_FALSE(surface.now[1].down);
  surface.expect_at(0, 1.5, 1.6);
}

TEST(Tuio, AFootMayBelongToOneSource) {
  Surface surface(
      "    - {preset: tuio, body: left, name: pad, floor: [3, 2]}\n"
      "    - {preset: tuio, body: right, name: mat, floor: [3, 2]}\n");
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 1, "other"));
  EXPECT_TRUE(surface.now.empty());
  surface.take(frame_of({{4, 0.1F, 0.6F}}, {4}, 1, "pad"));
  surface.expect_at(0, 0.3, 0.8);
}

// Angles grow from the surface's x to its y, which runs against the scene's.
TEST(Tuio, AnObjectTurnsItsFoot) {
  Surface surface(
      "    - {preset: tuio, body: left, floor: [3, 2], address: /tuio/2Dobj, mount: {position: "
      "[0.1, 0, 0]}}\n"
      "    - {preset: tuio, body: right, floor: [3, 2]}\n");
  const std::string address = "/tuio/2Dobj";
  const auto quarter = static_cast<float>(0.5 * std::numbers::pi);
  surface.take(
      {{address, {std::string("alive"), 3}},
       {address, {std::string("set"), 3, 40, 0.5F, 0.5F, quarter, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}},
       {address, {std::string("fseq"), 1}}});
  surface.expect_at(0, 1.5, 0.9);
  const Vector3 ahead = rotate(*surface.now[0].rotation, {1.0, 0.0, 0.0});
  EXPECT_LT(length(ahead - Vector3{0.0, -1.0, 0.0}), 1.0e-6);
}

TEST(Tuio, WhatIsNoFrameChangesNothing) {
  Surface surface;
  const std::string address = "/tuio/2Dcur";
  surface.take({{address, {}},
                {address, {7}},
                {address, {std::string("set"), 1}},
                {address, {std::string("set"), std::string("1"), 0.5F, 0.5F}},
                {address, {std::string("alive"), std::string("1")}},
                {address, {std::string("fseq")}},
                {address, {std::string("what"), 1}}});
  EXPECT_TRUE(surface.now.empty());
  for (int k = 0; k < 100; ++k) {
    surface.take(frame_of({{k, 0.5F, 0.5F}}, {k}, 1, "source" + std::to_string(k)));
  }
  EXPECT_EQ(surface.now.size(), 2U) << "there are two feet, however many sources";
}

}  // namespace
}  // namespace splash::sim
