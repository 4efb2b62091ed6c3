// SPDX-License-Identifier: MIT
// The patches and synth-server render the same log: bubbles and cavities sample by sample.
// Pd computes in single precision with a table of 512 cosines; hence the tolerance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include "protocol/message.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::pd {
namespace {

constexpr double kTolerance = -75.0;  ///< largest difference re A0, radius from 5 mm [dB]

protocol::Vec3 middle_of(int column, int row) {
  constexpr float kTile = 0.305F;
  return {(static_cast<float>(column) + 0.5F) * kTile, (static_cast<float>(row) + 0.5F) * kTile,
          0.1F};
}

std::size_t channel_of(int column, int row) {
  return static_cast<std::size_t>(row) * 6U + static_cast<std::size_t>(column);
}

protocol::Bubble bubble(float radius, float epsilon, const protocol::Vec3& place) {
  return {1, -1, radius, epsilon, place, 0.0F};
}

struct Size {
  float radius = 0.0F;
  float epsilon = 0.0F;
};

void PrintTo(const Size& size, std::ostream* out) {
  *out << size.radius << "m";
}

class OneBubble : public testing::TestWithParam<Size> {};

void compare(const Size& size, const RigPair& rig, const protocol::Vec3& place) {
  const double damping = 0.13 / static_cast<double>(size.radius) +
                         0.0072 * std::pow(static_cast<double>(size.radius), -1.5);
  const std::int64_t onset = 4801;  // not on a block of Pd
  const auto frames = onset + static_cast<std::int64_t>(std::min(11.0 / damping, 6.0) * kRate);
  const auto log =
      make_log({{static_cast<double>(onset) / kRate, bubble(size.radius, size.epsilon, place)}});
  const double a0 = static_cast<double>(size.radius) * static_cast<double>(size.epsilon);
  // synth-server's replay fades out at the end of its file, not within these frames
  const double difference = render_both(log, rig, frames).apart(a0 / kFullScale);
  std::cout << rig.rig << ": r = " << size.radius << " m: " << difference << " dB re A0\n";
  EXPECT_LT(difference, kTolerance);
}

TEST_P(OneBubble, SoundsAlikeOnTheFloor) {
  compare(GetParam(), kTiles, {0.7F, 1.1F, 0.2F});
}
TEST_P(OneBubble, SoundsAlikeFromLoudspeakers) {
  compare(GetParam(), kStereo, {0.3F, 0.0F, 0.0F});
}

INSTANTIATE_TEST_SUITE_P(Sizes, OneBubble,
                         testing::Values(Size{0.005F, 0.1F}, Size{0.0123F, 0.03F},
                                         Size{0.03F, 0.05F}, Size{0.08F, 0.1F}));

TEST(Offline, OnsetsAreOnTheSample) {
  const std::vector<std::int64_t> samples = {0, 1, 63, 64, 65, 1000, 4799, 4800, 24001};
  std::vector<EventAt> events;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const protocol::Vec3 place =
        middle_of(static_cast<int>(k % 3) * 2, static_cast<int>(k / 3) * 2);
    protocol::Event event = bubble(0.006F, 0.1F, place);
    if (k % 3 == 1) event = protocol::Impact{1, 0, 1.0F, 1.0F, place, 0.0F};
    if (k % 3 == 2) event = protocol::Cavity{1, 0, 0.02F, 0.1F, place, 0.0F};
    events.push_back({static_cast<double>(samples[k]) / kRate, event});
  }
  const auto log = make_log(events);
  const auto [pd, synth] = render_both(log, kTiles, 26000);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::size_t c = channel_of(static_cast<int>(k % 3) * 2, static_cast<int>(k / 3) * 2);
    if (k % 3 == 1) {  // noise: both start from nil, the second sample is the first to be heard
      EXPECT_EQ(first_beyond(pd[c], 1e-12), samples[k] + 1) << "event " << k;
      EXPECT_EQ(first_beyond(synth[c], 1e-12), samples[k] + 1) << "event " << k;
    } else {  // same waveform: both leave nil on the same sample; Pd's sine of nil is at -117 dB
      const double level = 1e-4 * static_cast<double>(tests::peak(synth[c]));
      EXPECT_EQ(first_beyond(pd[c], level), first_beyond(synth[c], level)) << "event " << k;
      EXPECT_GT(first_beyond(pd[c], level), samples[k]);
      EXPECT_LT(first_beyond(pd[c], level), samples[k] + 24);
    }
  }
}

TEST(Offline, AHundredBubblesOverTheFloorAndBesideIt) {
  std::vector<EventAt> events;
  for (int k = 0; k < 100; ++k) {
    const auto spot = static_cast<float>(k);
    const protocol::Vec3 place = {-0.3F + std::fmod(spot * 0.377F, 2.4F),
                                  -0.3F + std::fmod(spot * 0.611F, 2.4F), -1e-5F};
    const float radius = 0.005F + 0.0004F * static_cast<float>(k % 41);
    events.push_back({0.01 + 0.0137 * k, bubble(radius, 0.02F + 0.0007F * spot, place)});
  }
  const auto log = make_log(events);
  const double a0 = 0.09 * 0.021;
  EXPECT_LT(render_both(log, kTiles, 96000).apart(a0 / kFullScale), kTolerance);
}

// One breaks long before it has died away, one just before, one not at all; and a bubble takes the
// place of none of them.
TEST(Offline, CavitiesFadeAfterTheirLife) {
  const auto cavity = [](float life, const protocol::Vec3& place) {
    return protocol::Cavity{1, 0, 0.06F, 0.1F, place, 0.0F, life};
  };
  const auto log = make_log({{0.1, cavity(0.1372F, middle_of(0, 0))},
                             {0.1, cavity(1.0F, middle_of(5, 0))},
                             {0.1, cavity(0.0F, middle_of(0, 5))},
                             {0.4, bubble(0.03F, 0.05F, middle_of(0, 0))}});
  const Both both = render_both(log, kTiles, 96000);
  const double a0 = 0.06 * 0.1;
  const double difference = both.apart(a0 / kFullScale);
  std::cout << "cavities that break: " << difference << " dB re A0\n";
  EXPECT_LT(difference, kTolerance);
  // Broken by 0.1 + 0.1372 + 0.05 s, but for what the band's filter still swings.
  const auto loudest = [&](const Channels& all, std::size_t channel) {
    const std::vector<float>& one = all[channel];
    return static_cast<double>(tests::peak(one, 16800, 19000));
  };
  for (const Channels& all : {both.pd, both.synth}) {
    EXPECT_LT(loudest(all, channel_of(0, 0)), 0.05 * loudest(all, channel_of(0, 5)));
    EXPECT_GT(loudest(all, channel_of(5, 0)), 0.9 * loudest(all, channel_of(0, 5)));
  }
}

TEST(Offline, SmallBubblesAreLeftOutWhereTheRigEnds) {
  const auto log = make_log({{0.0, bubble(0.0039F, 0.1F, middle_of(0, 0))},
                             {0.0, bubble(0.0041F, 0.1F, middle_of(5, 5))}});
  const auto [pd, synth] = render_both(log, kTiles, 9600);
  EXPECT_EQ(first_beyond(pd[0], 0.0), -1);
  EXPECT_EQ(first_beyond(synth[0], 0.0), -1);
  EXPECT_GT(first_beyond(pd[35], 1e-3), 0);
  EXPECT_GT(first_beyond(synth[35], 1e-3), 0);
}

TEST(Offline, RenderingTwiceGivesTheSameBits) {
  const auto log = make_log({{0.1, protocol::Impact{1, 0, 1.5F, 1.5F, middle_of(2, 2), 0.0F}},
                             {0.2, bubble(0.01F, 0.1F, middle_of(3, 2))}});
  EXPECT_EQ(render_with_pd(log, kTiles, 48000), render_with_pd(log, kTiles, 48000));
}

TEST(Offline, EveryPatchOpensWithoutAComplaint) {
  for (const char* name : {"splash-tiles.pd", "splash-stereo.pd", "splash-synth-help.pd",
                           "offline.pd", "offline-stereo.pd"}) {
    const std::string patch = std::string(SPLASH_SOURCE_DIR) + "/pd-patches/" + name;
    tests::ChildProcess pd(batch({"-open", patch, "-send", "pd quit"}));
    EXPECT_EQ(pd.wait(60.0), 0) << name;
    EXPECT_EQ(pd.output(), "") << name;
  }
}

TEST(Offline, TheProgramConvertsALogFile) {
  const tests::TemporaryFolder folder;
  const auto osc = folder / "log.osc";
  const auto list = folder / "list.txt";
  {
    protocol::LogWriter writer(osc);
    for (const auto& entry : make_log({{0.25, bubble(0.0078125F, 0.0625F, {1.0F, 0.5F, 0.0F})}})) {
      writer.append(entry.seconds, entry.messages);
    }
  }
  const std::string program = std::string(SPLASH_BINARY_DIR) + "/log-to-pd";
  tests::ChildProcess good({program, osc.string(), list.string()});
  EXPECT_EQ(good.wait(30.0), 0) << good.output();
  EXPECT_THAT(good.output(), testing::HasSubstr("1 events in 1 bundles, 108000 frames"));
  std::string line;
  std::ifstream text(list);
  std::getline(text, line);
  EXPECT_EQ(line, "250 bubble 1 -1 0.0078125 0.0625 1 0.5 0;");
  tests::ChildProcess bad({program, "missing.osc", list.string()});
  EXPECT_EQ(bad.wait(30.0), 1);
  EXPECT_THAT(bad.output(), testing::HasSubstr("missing.osc"));
}

}  // namespace
}  // namespace splash::pd
