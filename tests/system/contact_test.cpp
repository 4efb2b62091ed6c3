// SPDX-License-Identifier: MIT
// Contact is predicted: the impact is told before the surfaces meet, its time lies in the future,
// and it sounds when they meet. The real simulator's log, through the synth.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <string>

#include "protocol/event_log.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/replay/replay.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

constexpr double kRate = 48000.0;
constexpr double kStarts = 0.3;     ///< to fall [s]
constexpr double kFrom = 0.35;      ///< the disc's centre [m]
constexpr double kTo = 0.10;        ///< [m]
constexpr double kMeets = 0.225;    ///< 2.5 cm over the water's level of 0.2 [m]
constexpr double kBreathes = 0.01;  ///< half a spacing of this coarse water's particles [m]

std::string falling(double speed) {
  const auto key = [](double time, double z) {
    return "{time: " + std::to_string(time) + ", position: [0, 0, " + std::to_string(z) + "]}";
  };
  return "{kind: script, smooth: false, keyframes: [" + key(0.0, kFrom) + ", " +
         key(kStarts, kFrom) + ", " + key(kStarts + (kFrom - kTo) / speed, kTo) + "]}";
}

/// The first impact of a log.
struct Told {
  double frame = 0.0;   ///< when the simulator knew [s]
  double moment = 0.0;  ///< when it is to sound [s]
  double speed = 0.0;   ///< [m/s]
};

std::optional<Told> first_impact(const std::vector<protocol::LogEntry>& log) {
  for (const auto& entry : log) {
    double delay = 0.0;
    for (const auto& message : entry.messages) {
      if (const auto frame = protocol::to_frame(message)) {
        delay = 1e-3 * static_cast<double>(frame->delay_ms);
      }
      const auto event = protocol::to_event(message);
      const auto* impact = event ? std::get_if<protocol::Impact>(&*event) : nullptr;
      if (impact == nullptr) continue;
      return Told{entry.seconds - delay,
                  entry.seconds + 1e-3 * static_cast<double>(impact->offset_ms),
                  static_cast<double>(impact->speed)};
    }
  }
  return std::nullopt;
}

/// First sample of the log's impacts alone.
std::int64_t heard(const std::vector<protocol::LogEntry>& log) {
  synth::ReplaySettings settings;
  settings.engine.sample_rate = kRate;
  settings.engine.components = synth::kImpacts;
  std::vector<float> left;
  synth::replay(log, synth::read_rig(rig_path("handheld.yaml")), settings,
                [&](const float* const* channels, int frames) {
                  left.insert(left.end(), channels[0], channels[0] + frames);
                });
  return onset(left, 1e-12F);
}

class Contact : public testing::TestWithParam<double> {};

TEST_P(Contact, IsToldAheadAndSoundsWhenTheSurfacesMeet) {
  const double speed = GetParam();
  const SmallScene scene(falling(speed));
  const TemporaryFolder folder;
  const std::string path = folder / "contact.osc";
  const auto [code, text] =
      simulate(scene.path(), kStarts + 0.25 / speed + 0.1, {"--record", path});
  ASSERT_EQ(code, 0) << text;
  const auto log = protocol::read_log(path);
  const auto told = first_impact(log);
  ASSERT_TRUE(told) << "no impact:\n" << text;
  const double meets = kStarts + (kFrom - kMeets) / speed;
  std::cout << speed << " m/s: told " << 1e3 * (told->moment - told->frame) << " ms ahead, "
            << 1e3 * (told->moment - meets) << " ms from where it meets the level at rest\n";
  EXPECT_NEAR(told->speed, speed, 0.05 * speed);
  EXPECT_NEAR(told->moment, meets, kBreathes / speed);
  EXPECT_GT(told->moment, told->frame) << "in the future when it was told";
  // Noise begins with its second sample.
  EXPECT_EQ(heard(log), std::llround(told->moment * kRate) + 1);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Contact, testing::Values(0.5, 1.0, 2.0));

}  // namespace
}  // namespace splash::tests
