// SPDX-License-Identifier: MIT
// Water under the foot: how strong by the law, where, in which band, and that it ends.
#include "synth-server/render/underfoot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "synth-server/output/biquad.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

/// The texture alone: impacts and bubbles themselves are 60 dB down.
EngineSettings foot_settings(double texture, double wash) {
  auto settings = file_settings();
  settings.sound.foot.texture = texture;
  settings.sound.foot.wash = wash;
  settings.sound.impact.amplitude = 1e-6;
  settings.sound.bubble.gain_db = -60.0;
  return settings;
}

/// Mean over many, as noise has it.
double energy_of(const protocol::Event& event, const EngineSettings& settings) {
  constexpr int kTimes = 40;
  Engine engine(open_rig(), settings);
  for (int i = 0; i < kTimes; ++i) engine.schedule({event, i * 48000});
  return energy(render(engine, kTimes * 48000)[0]) / kTimes;
}

TEST(Underfoot, ChangesOfForceHaveTheirSize) {
  // 0.17 kg of water come up to 1 m/s within 5 ms, those of a bubble of 1 cm to 0.31 m/s in 32 ms.
  EXPECT_NEAR(force_rate(impact(1.0F)), 2.0 * 0.1663 * 1.0 / (0.005 * 0.005), 20.0);
  EXPECT_NEAR(force_rate(impact(2.0F)) / force_rate(impact(1.0F)), 8.0, 1e-9);
  EXPECT_NEAR(force_rate(bubble(0.01F)), 2.0 * 0.00418 * 0.3132 / (0.0319 * 0.0319), 0.05);
  protocol::Impact told = impact(1.0F);
  told.momentum = 0.5F;
  told.rise = 0.01F;
  EXPECT_NEAR(force_rate(told), 2.0 * 0.5 / (0.01 * 0.01), 0.01) << "what the simulator knows";
}

TEST(Underfoot, IsLessForAHandThatSlidesThanForOneThatSlaps) {
  protocol::Impact slides = impact(2.0F);
  slides.approach = 0.2F;
  EXPECT_LT(force_rate(slides), 0.01 * force_rate(impact(2.0F)));
  slides.approach = 0.0F;
  EXPECT_EQ(force_rate(slides), 0.0);
}

TEST(Underfoot, GrowsAsTheForcesChangeToItsPower) {
  const auto settings = foot_settings(1e-4, 0.0);
  const auto level_db = [&](float speed) {
    return 10.0 * std::log10(energy_of(impact(speed), settings));
  };
  // |dF/dt| ~ v^3, to a third: 6 dB for each doubling.
  EXPECT_NEAR(level_db(2.0F) - level_db(1.0F), 20.0 * std::log10(2.0), 0.2);
  // At its top the amplitude is texture (13.3 kN/s)^(1/3), and its square falls with release / 2.
  const double top = 1e-4 * std::cbrt(13.31) / open_rig().outputs[0].full_scale;
  const double wanted = top * top * 48000.0 * 0.5 * settings.sound.foot.release;
  EXPECT_NEAR(level_db(1.0F), 10.0 * std::log10(wanted), 1.0);
}

TEST(Underfoot, IsFeltOnTheTilesUnderTheEventAlone) {
  const auto settings = foot_settings(1e-4, 1e-4);
  Engine engine(floor_rig(), settings);
  const protocol::Vec3 place{0.305F * 2.5F, 0.305F * 3.5F, 0.0F};
  engine.schedule({bubble(0.003F, 0.05F, place), 0});  // above the band, and felt all the same
  const Channels out = render(engine, 24000);
  for (std::size_t tile = 0; tile < 36; ++tile) {
    const bool near = tile % 6 >= 1 && tile % 6 <= 3 && tile / 6 >= 2 && tile / 6 <= 4;
    if (!near) {
      EXPECT_EQ(energy(out[tile]), 0.0) << tile;
    }
  }
  EXPECT_GT(energy(out[3 * 6 + 2]), 0.0);
}

/// Forces every 6.25 ms and every 2 ms that change alike: the texture's amplitude is the law's.
TEST(Underfoot, FollowsToldForcesByTheLawHoweverOftenTheyCome) {
  auto settings = foot_settings(1e-4, 0.0);
  settings.sound.foot.least = 50.0;
  settings.sound.foot.power = 0.5;
  const auto played = [&](float rate, int apart) {
    Engine engine(open_rig(), settings);
    constexpr int kFrames = 96000;
    std::vector<float> out;
    for (int at = 0; at < kFrames; at += apart) {
      engine.push({{{0.0F, 0.0F, 0.0F}, 0, rate}, at});
      const auto more = render(engine, apart)[0];
      out.insert(out.end(), more.begin(), more.end());
    }
    return std::sqrt(energy({out.begin() + kFrames / 4, out.begin() + kFrames}) / (0.75 * kFrames));
  };
  const double wanted = 1e-4 * std::sqrt(4.0) / open_rig().outputs[0].full_scale;
  EXPECT_NEAR(played(4050.0F, 96) / wanted, 1.0, 0.1);
  // Within 300 samples it falls by 6 %, of which the mean is seen, and comes up again in 5 ms.
  EXPECT_NEAR(played(4050.0F, 300) / wanted, 1.0, 0.1);
  EXPECT_EQ(played(50.0F, 300), 0.0) << "no more than the solver's noise";
}

TEST(Underfoot, OfABodyWhoseForcesAreToldItsEventsDriveNothing) {
  const auto settings = foot_settings(1e-4, 0.0);
  const auto played = [&](int body, int at, bool told) {
    Engine engine(open_rig(), settings);
    if (told) engine.push({{{0.0F, 0.0F, 0.0F}, 2, 0.0F}, 0});
    protocol::Impact event = impact(1.0F);
    event.body = body;
    engine.schedule({event, at});
    return energy(render(engine, 48000)[0]);
  };
  EXPECT_LT(played(2, 4800, true), 1e-3 * played(2, 4800, false));
  EXPECT_GT(played(3, 4800, true), 0.5 * played(3, 4800, false)) << "another body";
  EXPECT_GT(played(2, 24000, true), 0.5 * played(2, 24000, false)) << "they come no more";
}

TEST(Underfoot, IsFeltUnderThePushedBodyAtItsMoment) {
  const auto settings = foot_settings(1e-4, 0.0);
  Engine engine(floor_rig(), settings);
  engine.push({{{0.305F * 2.5F, 0.305F * 3.5F, 0.1F}, 0, 1000.0F}, 9600});
  const Channels out = render(engine, 24000);
  EXPECT_EQ(energy(out[0]), 0.0);
  const auto& under = out[3 * 6 + 2];
  EXPECT_GT(energy(under), 0.0);
  // A tile's width away the weight is 1 - (0.305 / 0.4)^2 of that under it.
  const double beside = energy(out[3 * 6 + 1]) + energy(out[3 * 6 + 3]) + energy(out[2 * 6 + 2]) +
                        energy(out[4 * 6 + 2]);
  EXPECT_NEAR(beside / 4.0 / energy(under), 0.175, 0.06);
  for (std::size_t n = 0; n < 9600 - 64; ++n) ASSERT_EQ(under[n], 0.0F) << n;
  EXPECT_GT(energy({under.begin() + 9600, under.begin() + 12000}), 0.1 * energy(under));
}

TEST(Underfoot, WashesBelowSixtyHertz) {
  const auto settings = foot_settings(0.0, 1e-3);
  Engine engine(open_rig(), settings);
  for (int i = 0; i < 20; ++i) engine.schedule({impact(1.0F, i), i * 24000});
  const auto out = render(engine, 20 * 24000)[0];
  Biquad first = high_pass(120.0, 0.5411961, kRate);
  Biquad second = high_pass(120.0, 1.3065630, kRate);
  double above = 0.0;
  for (const float s : out)
    above += std::pow(second.process(first.process(static_cast<double>(s))), 2);
  EXPECT_GT(energy(out), 0.0);
  EXPECT_LT(above, 0.02 * energy(out)) << "an octave above";
}

TEST(Underfoot, IsTheSameInBlocksOfAnySizeAndEnds) {
  const auto played = [](const std::vector<int>& blocks) {
    Rig rig = open_rig();
    rig.outputs[0].band.low = 40.0;
    auto settings = foot_settings(1e-4, 1e-4);
    settings.sound.foot.wash_release = 0.05;
    Engine engine(rig, settings);
    for (const TimedEvent& event : splashes(300, 20000)) {
      if (!std::holds_alternative<protocol::Cavity>(event.event)) engine.schedule(event);
    }
    return render(engine, 200000, blocks);
  };
  const Channels whole = played({512});
  EXPECT_EQ(played({64}), whole);
  EXPECT_EQ(played({1, 7, 100, 333}), whole);
  for (std::size_t n = 190000; n < whole[0].size(); ++n) ASSERT_EQ(whole[0][n], 0.0F) << n;
}

TEST(Underfoot, IsNoneUnlessTheSoundHasIt) {
  const auto played = [](double attack) {
    auto settings = file_settings();
    settings.sound.foot.attack = attack;
    Engine engine(open_rig(), settings);
    engine.schedule({impact(1.0F), 0});
    return render(engine, 4800);
  };
  EXPECT_EQ(played(0.005), played(0.1));
}

}  // namespace
}  // namespace splash::synth
