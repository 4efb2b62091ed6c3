// SPDX-License-Identifier: MIT
// What a person may change, by name, and what no change may do.
#include "synth-server/serve/desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "synth-server/sound/sound_rows.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

using testing::HasSubstr;

TEST(Desk, HasAKnobForEveryRowAndLevel) {
  const Desk desk(shipped_rig("tiles36"), {});
  std::set<std::string> names;
  for (const Knob& knob : desk.knobs()) {
    EXPECT_TRUE(names.insert(knob.name).second) << knob.name;
    EXPECT_LE(knob.name.size(), 64U) << "longer than the wire's texts";
    EXPECT_LT(knob.min, knob.max) << knob.name;
  }
  for (const char* name :
       {"impact/gain_db", "impact/sensation", "bubble/rise", "cavity/damping", "cavity/solo",
        "rig/floor/gain_db", "rig/floor/ceiling", "rig/floor/mute", "rig/floor/tile/07/trim_db",
        "rig/floor/tile/35/solo"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_EQ(names.size(), kSoundNumbers + 6 + 4 + 3 * 36);
}

TEST(Desk, TakesWhatIsInRangeAndSaysWhatIsAllowed) {
  Desk desk(shipped_rig("shoes"), {});
  EXPECT_EQ(desk.set("impact/q", 2.0), "");
  EXPECT_EQ(desk.get("impact/q"), 2.0);
  EXPECT_EQ(desk.set("impact/q", 51.0), "51, allowed 0.6 to 50");
  EXPECT_NE(desk.set("impact/q", std::nan("")), "");
  EXPECT_EQ(desk.get("impact/q"), 2.0);
  EXPECT_THAT(desk.set("impct/q", 2.0), HasSubstr("did you mean impact/q?"));
  EXPECT_EQ(desk.get("impct/q"), std::nullopt);
  EXPECT_EQ(desk.set("rig/left shoe/heel/trim_db", -3.0), "");
  EXPECT_EQ(desk.set("rig/left shoe/ceiling", 0.5), "");
  EXPECT_NE(desk.set("rig/left shoe/ceiling", 0.95), "") << "downwards only: the rig says 0.9";
  EXPECT_EQ(desk.set("rig/left shoe/ceiling", static_cast<double>(0.9F)), "")
      << "as the wire has it";
  EXPECT_LE(desk.get("rig/left shoe/ceiling").value(), 0.9);
}

TEST(Desk, TellsWhatHasChangedOnce) {
  Desk desk(shipped_rig("handheld"), {});
  EXPECT_TRUE(desk.take_changes(64).empty());
  EXPECT_EQ(desk.set("bubble/pitch", 0.5), "");
  EXPECT_EQ(desk.set("bubble/pitch", 0.25), "");
  const auto changes = desk.take_changes(64);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].name, "bubble/pitch");
  EXPECT_EQ(changes[0].value, 0.25);
  Sound other;
  other.impact.q = 7.0;
  other.cavity.gain_db = -3.0;
  desk.play(other, 2.0);
  EXPECT_EQ(desk.take_changes(2).size(), 2U);
  EXPECT_EQ(desk.take_changes(2).size(), 1U) << "q, gain and the pitch that goes back";
  EXPECT_EQ(desk.get("bubble/pitch"), 1.0);
}

/// A rig of a hand and two loudspeakers under changes, and what must hold of each sample.
class DeskUnderHand : public testing::Test {
 protected:
  DeskUnderHand() : rig_(shipped_rig("handheld+stereo")), desk_(rig_, {}) {
    settings_ = file_settings();
    settings_.controls = &desk_.box();
    engine_ = std::make_unique<Engine>(rig_, settings_);
    for (const Output& output : rig_.outputs) {
      const double slew = 4.0 * std::numbers::pi * output.band.high * output.ceiling / kRate;
      for (int c = 0; c < channel_count(output); ++c) {
        ceilings_.push_back(output.ceiling);
        slews_.push_back(std::min(slew, 4.0));
      }
    }
    last_.resize(ceilings_.size());
  }

  void splash() {
    const auto place = protocol::Vec3{static_cast<float>(draw_() % 100) * 0.02F - 1.0F, 0.0F, 0.0F};
    if (draw_() % 8 == 0)
      engine_->schedule({bubble(0.002F + 0.0001F * static_cast<float>(draw_() % 100), 0.1F, place),
                         engine_->clock()});
    if (draw_() % 100 == 0) engine_->schedule({impact(3.0F, 0, place), engine_->clock()});
    if (draw_() % 400 == 0) engine_->schedule({cavity(0.05F, place), engine_->clock()});
  }
  /// Whether 64 samples keep to ceiling and slew.
  bool holds() {
    const Channels out = render(*engine_, kCell, {kCell});
    bool good = true;
    for (std::size_t c = 0; c < out.size(); ++c) {
      for (const float sample : out[c]) {
        const auto value = static_cast<double>(sample);
        good = good && std::isfinite(sample) && std::abs(value) <= ceilings_[c] &&
               std::abs(value - last_[c]) <= slews_[c] * (1.0 + 1e-6) + 1e-7;
        last_[c] = value;
        loudest_ = std::max(loudest_, std::abs(value));
      }
    }
    return good;
  }

  Rig rig_;
  Desk desk_;
  EngineSettings settings_;
  std::unique_ptr<Engine> engine_;
  std::vector<double> ceilings_, slews_, last_;
  double loudest_ = 0.0;
  std::mt19937 draw_{7};
};

TEST_F(DeskUnderHand, AMillionSettingsPassNeitherCeilingNorSlew) {
  constexpr int kSettings = 1'000'000;
  constexpr int kPerCell = 20;
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto& knobs = desk_.knobs();
  for (int done = 0; done < kSettings; done += kPerCell) {
    for (int i = 0; i < kPerCell; ++i) {
      const Knob& knob = knobs[draw_() % knobs.size()];
      const bool is_switch = knob.min == 0.0 && knob.max == 1.0;
      const double value = is_switch ? static_cast<double>(draw_() % 8 == 0)
                                     : knob.min + (knob.max - knob.min) * part(draw_);
      ASSERT_EQ(desk_.set(knob.name, value), "") << knob.name << ' ' << value;
    }
    splash();
    ASSERT_TRUE(holds()) << "after " << done << " settings";
  }
  EXPECT_GT(loudest_, 0.5) << "it was loud enough to tell";
  EXPECT_EQ(engine_->counters().resets, 0U);
}

TEST_F(DeskUnderHand, SoundsMorphIntoEachOtherWithoutClicks) {
  const Sound calibrated =
      read_sound(std::string(SPLASH_SOURCE_DIR) + "/configs/sounds/calibrated.yaml").sound;
  for (int turn = 0; turn < 6; ++turn) {
    desk_.play(turn % 2 == 0 ? calibrated : Sound{}, 0.5);
    for (int cell = 0; cell < 750; ++cell) {
      splash();
      ASSERT_TRUE(holds());
    }
  }
  EXPECT_GT(loudest_, 0.05);
}

}  // namespace
}  // namespace splash::synth
