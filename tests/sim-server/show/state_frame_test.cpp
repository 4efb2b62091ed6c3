// SPDX-License-Identifier: MIT
// The state's encoding, bit for bit against view-server/README.md, as a reader would take it apart.
#include "sim-server/show/state_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "protocol/control_port.hpp"

namespace splash::sim {
namespace {

using protocol::frame_number;

/// Five particles in a stride of eight, in no order.
ShownWater few() {
  constexpr float kFar = 1e6F;  // beyond the particles: not to be shown
  ShownWater water;
  water.count = 3;
  water.stride = 4;
  water.least_density = 700.0F;
  water.position = {0.0F, 1.0F, 0.5F, kFar, 0.0F, 2.0F, 1.0F, kFar, 0.25F, 0.5F, 0.25F};
  water.velocity = {0.0F, 2.0F, 3.0F, kFar, 0.0F, 0.0F, 4.0F, kFar, 0.0F, 0.0F, 12.0F};
  water.id = {2, 0, 1};
  water.density = {998.0F, 700.0F, 699.0F};
  water.moving = {0, 1, 1};
  return water;
}

ShownState state() {
  ShownState state;
  state.moment = 1764000000.25;
  state.seconds = 1.5;
  state.steps = (1 << 24) + 7;
  state.bodies.resize(2);
  state.bodies[1].state.position = {0.5, -1.0, 2.0};
  state.bodies[1].state.rotation = {0.0, 0.0, 1.0, 0.0};
  state.bodies[1].flags = kBodyTracked | kBodyGrabbed;
  state.bubbles = {{0.5, 2.0, 0.25}};
  return state;
}

std::string hex(const protocol::ViewFrame& frame, std::size_t from, std::size_t size) {
  return protocol::to_hexadecimal(protocol::Bytes(frame).subspan(from, size));
}

TEST(StateFrame, IsWhatTheReadmeSaysBitForBit) {
  const protocol::ViewFrame frame = state_frame(few(), state());
  ASSERT_EQ(frame.size(), 56U + 2 * 32 + 4 * 8);
  EXPECT_EQ(hex(frame, 0, 8), "53 50 53 31 98 00 00 00");
  EXPECT_EQ(frame_number<double>(&frame[8]), 1764000000.25);
  EXPECT_EQ(frame_number<double>(&frame[16]), 1.5);
  EXPECT_EQ(hex(frame, 24, 16), "07 00 00 00 03 00 00 00 01 00 00 00 02 00 00 00");
  // Lower corner (0, 0, 0.25), unit 2 / 65535.
  EXPECT_EQ(hex(frame, 40, 12), "00 00 00 00 00 00 00 00 00 00 80 3e");
  EXPECT_EQ(frame_number<float>(&frame[52]), static_cast<float>(2.0 / 65535.0));
  EXPECT_EQ(hex(frame, 56 + 32, 32),
            "00 00 00 3f "
            "00 00 80 bf "
            "00 00 00 40 "
            "00 00 00 00 "
            "00 00 00 00 "
            "00 00 80 3f "
            "00 00 00 00 "
            "06 00 00 00");
  // By id, each its place, speed and kind: the second (x 1, y 2, z 0.5; 2 m/s: half of 255), the
  // third (13 m/s: 255, spray), the first (asleep), and the bubble.
  EXPECT_EQ(hex(frame, 120, 8), "00 80 ff ff 00 20 80 00");
  EXPECT_EQ(hex(frame, 128, 8), "00 40 00 80 00 00 ff 04");
  EXPECT_EQ(hex(frame, 136, 8), "00 00 00 00 00 00 00 02");
  EXPECT_EQ(hex(frame, 144, 8), "00 40 ff ff 00 00 00 01");
}

TEST(StateFrame, PlacesAndSpeedsComeBackWithinHalfACount) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-3.0F, 4.0F);
  std::uniform_real_distribution<float> speed(-4.0F, 4.0F);
  ShownWater water;
  water.count = water.stride = 1000;
  for (std::size_t i = 0; i < 3 * water.count; ++i) {
    water.position.push_back(place(random));
    water.velocity.push_back(speed(random));
  }
  water.density.assign(water.count, 1000.0F);
  water.moving.assign(water.count, 1);
  for (int i = 0; i < 1000; ++i) water.id.push_back(999 - i);
  const protocol::ViewFrame frame = state_frame(water, {});
  const auto unit = static_cast<double>(frame_number<float>(&frame[52]));
  for (std::size_t i = 0; i < water.count; ++i) {
    const std::byte* particle = &frame[56 + 8 * (999 - i)];
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto corner = static_cast<double>(frame_number<float>(&frame[40 + 4 * axis]));
      const double shown = corner + unit * frame_number<std::uint16_t>(particle + 2 * axis);
      ASSERT_NEAR(shown, static_cast<double>(water.position[axis * 1000 + i]), 0.51 * unit);
      square += std::pow(static_cast<double>(water.velocity[axis * 1000 + i]), 2.0);
    }
    const double root = frame_number<std::uint8_t>(particle + 6) / 255.0;
    ASSERT_NEAR(root, std::sqrt(std::sqrt(square) / kShownSpeed), 0.501 / 255.0);
  }
}

TEST(StateFrame, WhatIsNoNumberStaysInsideTheBox) {
  ShownWater water = few();
  water.position[0] = std::numeric_limits<float>::quiet_NaN();
  water.position[5] = std::numeric_limits<float>::infinity();
  water.velocity[0] = std::numeric_limits<float>::quiet_NaN();
  const protocol::ViewFrame frame = state_frame(water, {});
  for (std::size_t offset = 40; offset < 56; offset += 4) {
    EXPECT_TRUE(std::isfinite(frame_number<float>(&frame[offset])));
  }
  EXPECT_EQ(frame_number<std::uint16_t>(&frame[56 + 2 * 8]), 0);
  EXPECT_EQ(frame_number<std::uint16_t>(&frame[56 + 0 * 8 + 2]), 65535);
  EXPECT_EQ(std::to_integer<int>(frame[56 + 2 * 8 + 6]), 0);
}

TEST(StateFrame, OneParticleAloneHasAPlace) {
  ShownWater water = few();
  water.count = 1;
  water.id = {0};
  const protocol::ViewFrame frame = state_frame(water, {});
  EXPECT_GT(frame_number<float>(&frame[52]), 0.0F);
  EXPECT_EQ(hex(frame, 56, 6), "00 00 00 00 00 00");
}

}  // namespace
}  // namespace splash::sim
