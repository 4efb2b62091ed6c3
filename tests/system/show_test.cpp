// SPDX-License-Identifier: MIT
// The real programs and viewers that come, look and go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/frame.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

using Json = nlohmann::json;
using protocol::frame_kind;
using protocol::frame_number;
using protocol::ViewFrame;

Json told_by(const ViewFrame& frame) {
  return Json::parse(reinterpret_cast<const char*>(&frame[16]),
                     reinterpret_cast<const char*>(frame.data() + frame.size()));
}

/// Of the report that the simulator leaves at its end.
int shown_frames(Simulator& simulator, const std::string& report) {
  EXPECT_EQ(simulator.end(), 0) << simulator.process().output();
  return Json::parse(text_of(report)).at("shown_frames");
}

TEST(Show, TheWaterIsWhereItIsAndTheBodyMoves) {
  const SmallScene scene(plunging());
  const TemporaryFolder folder;
  const std::string report = folder / "shown.json";
  Simulator simulator({"--scene", scene.path(), "--show", "127.0.0.1:0", "--report", report});
  const protocol::Endpoint where = simulator.viewers();
  const FrameViewer viewer(where);
  const ViewFrame first = viewer.read();
  ASSERT_EQ(frame_kind(first.data()), protocol::kSceneFrame);
  EXPECT_EQ(told_by(first).at("scene"), "small");
  const auto particles = told_by(first).at("particles").get<std::uint32_t>();
  double lowest = 1.0;
  double highest = 0.0;
  double last = 0.0;
  for (int i = 0; i < 60; ++i) {
    viewer.ask();
    const ViewFrame frame = viewer.read();
    ASSERT_FALSE(frame.empty());
    ASSERT_EQ(frame_kind(frame.data()), protocol::kStateFrame);
    ASSERT_EQ(frame_number<std::uint32_t>(&frame[28]), particles);
    const auto bubbles = frame_number<std::uint32_t>(&frame[32]);
    ASSERT_EQ(frame.size(), 56U + 32U + 8U * (particles + bubbles));
    ASSERT_GT(frame_number<double>(&frame[16]), last);
    last = frame_number<double>(&frame[16]);
    EXPECT_LT(std::abs(frame_number<double>(&frame[8]) - protocol::unix_now()), 1.0);
    const auto height = static_cast<double>(frame_number<float>(&frame[64]));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    // All water lies in the tank, but for what splashes; its mean depth is half the level.
    const auto z = static_cast<double>(frame_number<float>(&frame[48]));
    const auto unit = static_cast<double>(frame_number<float>(&frame[52]));
    double sum = 0.0;
    for (std::uint32_t p = 0; p < particles; ++p) {
      sum += z + unit * frame_number<std::uint16_t>(&frame[88 + 8 * p + 4]);
    }
    EXPECT_NEAR(sum / particles, 0.5 * SmallScene::kLevel, 0.02);
  }
  EXPECT_GT(highest - lowest, 0.1) << "the disc plunges once a second";
  EXPECT_GE(shown_frames(simulator, report), 60);
}

TEST(Show, NothingIsReadBackWhileNobodyAsks) {
  const SmallScene scene(plunging());
  const TemporaryFolder folder;
  const std::string report = folder / "unseen.json";
  Simulator simulator({"--scene", scene.path(), "--show", "127.0.0.1:0", "--report", report});
  const FrameViewer idle(simulator.viewers());
  EXPECT_EQ(frame_kind(idle.read().data()), protocol::kSceneFrame);
  {
    const FrameViewer once(simulator.viewers());
    once.ask(500);
    EXPECT_FALSE(once.read().empty());
    EXPECT_FALSE(once.read().empty());
  }
  EXPECT_TRUE(simulator.process().wait_for_text("\n    2."));
  EXPECT_LE(shown_frames(simulator, report), 3);
}

/// One impact of 2 m/s, at once.
std::vector<std::byte> splash_now() {
  protocol::Impact impact;
  impact.body = 0;
  impact.speed = 2.0F;
  impact.approach = 2.0F;
  return protocol::encode(protocol::kImmediately, {protocol::to_message(impact)});
}

TEST(Show, LevelsAndSoundAreThoseOfTheDevice) {
  Synth synth({"--rig", rig_path("tiles36.yaml"), "--device", "null", "--show", "127.0.0.1:0"});
  const protocol::Endpoint where = synth.viewers();
  { const FrameViewer gone(where); }
  const FrameViewer viewer(where);
  const ViewFrame rig = viewer.read();
  ASSERT_EQ(frame_kind(rig.data()), protocol::kRigFrame);
  const auto channels = told_by(rig).at("channels").size();
  EXPECT_GE(channels, 36U);
  sleep(2.5);  // the synth opens within two seconds
  viewer.ask(16);
  synth.send(splash_now());
  double next = -1.0;
  float loudest_level = 0.0F;
  float loudest_sample = 0.0F;
  int levels = 0;
  for (int i = 0; i < 228; ++i) {  // of two seconds
    const ViewFrame frame = viewer.read();
    ASSERT_FALSE(frame.empty());
    viewer.ask();
    EXPECT_LT(std::abs(frame_number<double>(&frame[8]) - protocol::unix_now()), 1.0);
    if (frame_kind(frame.data()) == protocol::kLevelsFrame) {
      ++levels;
      ASSERT_EQ(frame_number<std::uint32_t>(&frame[16]), channels);
      ASSERT_EQ(frame.size(), 24 + 4 * channels);
      for (std::size_t c = 0; c < channels; ++c) {
        loudest_level = std::max(loudest_level, frame_number<float>(&frame[24 + 4 * c]));
      }
      continue;
    }
    ASSERT_EQ(frame_kind(frame.data()), protocol::kSoundFrame);
    const auto frames = frame_number<std::uint32_t>(&frame[20]);
    ASSERT_EQ(frame.size(), 32 + 8 * frames);
    const double number = frame_number<double>(&frame[24]);
    EXPECT_TRUE(next < 0.0 || number == next) << "frames of sound are missing";
    next = number + frames;
    for (std::size_t k = 0; k < 2 * std::size_t{frames}; ++k) {
      const float sample = frame_number<float>(&frame[32 + 4 * k]);
      ASSERT_TRUE(std::isfinite(sample));
      loudest_sample = std::max(loudest_sample, std::abs(sample));
    }
  }
  EXPECT_NEAR(levels, 40, 5) << "20 a second, beside 94 of sound";
  EXPECT_GT(loudest_level, 1e-3F);
  EXPECT_GT(loudest_sample, 1e-3F);
}

}  // namespace
}  // namespace splash::tests
