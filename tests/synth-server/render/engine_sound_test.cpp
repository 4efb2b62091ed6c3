// SPDX-License-Identifier: MIT
// What the engine makes of a sound: each component is played by its own part of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "synth-server/voices/cloud.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

/// Whether impacts, bubbles and cavities sound otherwise with this sound than with the paper's.
std::array<bool, 3> changes(const Sound& sound) {
  std::array<bool, 3> differ{};
  const std::array<protocol::Event, 3> events = {impact(1.0F), bubble(0.005F), cavity(0.03F)};
  for (std::size_t kind = 0; kind < events.size(); ++kind) {
    auto settings = file_settings();
    Engine paper(open_rig(), settings);
    settings.sound = sound;
    Engine other(open_rig(), settings);
    paper.schedule({events[kind], 0});
    other.schedule({events[kind], 0});
    differ[kind] = render(paper, 4800) != render(other, 4800);
  }
  return differ;
}

TEST(Engine, PlaysEachComponentByItsPartOfTheSound) {
  Sound sound;
  EXPECT_EQ(changes(sound), (std::array{false, false, false}));
  sound.impact.release = 0.1;
  EXPECT_EQ(changes(sound), (std::array{true, false, false}));
  sound.bubble.rise = kIntegratedRise;
  EXPECT_EQ(changes(sound), (std::array{true, true, false}));
  sound.cavity.damping = 2.0;
  EXPECT_EQ(changes(sound), (std::array{true, true, true}));
}

// A component's gain turns its voices up and down as they are, and no others.
TEST(Engine, TurnsEachComponentUpAndDown) {
  const std::array<protocol::Event, 3> events = {impact(1.0F), bubble(0.005F), cavity(0.03F)};
  for (std::size_t kind = 0; kind < events.size(); ++kind) {
    const auto played = [&](std::size_t turned, double decibels) {
      auto settings = file_settings();
      Sound& sound = settings.sound;
      const std::array gains = {&sound.impact.gain_db, &sound.bubble.gain_db,
                                &sound.cavity.gain_db};
      *gains[turned] = decibels;
      Engine engine(open_rig(), settings);
      engine.schedule({events[kind], 100});
      return render(engine, 4800)[0];
    };
    const auto whole = played(0, 0.0);
    const auto half = played(kind, -20.0 * std::log10(2.0));
    for (std::size_t n = 0; n < whole.size(); ++n) ASSERT_NEAR(half[n], 0.5F * whole[n], 2e-7F);
    for (std::size_t other = 0; other < 3; ++other) {
      if (other == kind) continue;
      EXPECT_EQ(played(other, -20.0), whole) << kind << " by the gain of " << other;
    }
  }
}

TEST(Engine, HearsDepthInPhysicalBubblesAlone) {
  const auto at_depth = [](double physical, double level) {
    auto settings = file_settings();
    settings.sound.bubble.physical = physical;
    settings.water_level = level;
    Engine engine(open_rig(), settings);
    engine.schedule({bubble(0.005F, 0.05F, {0.0F, 0.0F, 0.5F}), 0});
    return render(engine, 4800);
  };
  EXPECT_EQ(at_depth(0.0, 3.0), at_depth(0.0, kNoWaterLevel));
  EXPECT_NE(at_depth(1.0, 3.0), at_depth(1.0, kNoWaterLevel));
  EXPECT_EQ(at_depth(1.0, 0.5), at_depth(1.0, kNoWaterLevel)) << "at the surface";
  EXPECT_EQ(at_depth(1.0, 0.2), at_depth(1.0, kNoWaterLevel)) << "above it";
}

TEST(Engine, LetsPitchFollowPlaceWhereTheSoundSaysSo) {
  const auto played = [](double place, double level, double floor) {
    auto settings = file_settings();
    settings.sound.bubble.place = place;
    settings.water_level = level;
    settings.floor_level = floor;
    Engine engine(open_rig(), settings);
    engine.schedule({bubble(0.005F, 0.05F, {0.0F, 0.0F, 0.5F}), 0});
    return render(engine, 4800);
  };
  EXPECT_EQ(played(0.0, 0.506, 0.494), played(0.0, kNoWaterLevel, kNoFloor));
  EXPECT_NE(played(1.0, 0.506, kNoFloor), played(1.0, kNoWaterLevel, kNoFloor));
  EXPECT_NE(played(1.0, kNoWaterLevel, 0.494), played(1.0, kNoWaterLevel, kNoFloor));
}

// Five bubbles one after the other at one place: each is as much lower as the cloud says.
TEST(Engine, LowersBubblesByThoseAroundThem) {
  constexpr int kApart = 9600;
  auto settings = file_settings();
  settings.sound.cloud = {1.0, 1.0};
  settings.sound.bubble.rise = 0.0;
  Engine engine(open_rig(), settings);
  for (int i = 0; i < 5; ++i) engine.schedule({bubble(0.005F), i * kApart});
  for (int before = 0; before < 5; ++before) {
    const auto out = render(engine, kApart)[0];
    double power = 0.0;
    double steps = 0.0;
    for (std::size_t n = 1; n < out.size(); ++n) {
      power += std::pow(static_cast<double>(out[n]), 2);
      steps += std::pow(static_cast<double>(out[n]) - static_cast<double>(out[n - 1]), 2);
    }
    const double pitch = kRate / M_PI * std::asin(0.5 * std::sqrt(steps / power));
    EXPECT_NEAR(pitch, 600.0 * lowered(0.5 * before), 3.0) << before;  // each adds its half
  }
}

}  // namespace
}  // namespace splash::synth
