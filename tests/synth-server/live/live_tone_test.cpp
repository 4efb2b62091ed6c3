// SPDX-License-Identifier: MIT
#include "synth-server/play/live_tone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;  // [Hz]
constexpr float kWater = 0.5F;     // a constant, so that what is left of it can be told

/// Two channels of water that tones are laid over, a block at a time.
class Played {
 public:
  explicit Played(LiveTone& tone) : tone_(tone) {}
  void go(double seconds) {
    constexpr int kPart = 64;
    for (int done = 0; done < static_cast<int>(seconds * kRate); done += kPart) {
      for (auto& channel : channels_) channel.resize(channel.size() + kPart, kWater);
      const std::array<float*, 2> block = {channels_[0].data() + channels_[0].size() - kPart,
                                           channels_[1].data() + channels_[1].size() - kPart};
      tone_.process(block.data(), kPart);
    }
  }
  [[nodiscard]] const std::vector<float>& channel(std::size_t c) const { return channels_[c]; }
  /// Whether only water sounds from one moment to another [s].
  [[nodiscard]] bool is_water(std::size_t c, double from, double to) const {
    const auto at = [&](double t) {
      return channels_[c].begin() + static_cast<std::ptrdiff_t>(t * kRate);
    };
    return std::all_of(at(from), at(to), [](float x) { return x == kWater; });
  }

 private:
  LiveTone& tone_;
  std::array<std::vector<float>, 2> channels_;
};

std::vector<Tone> tones() {
  return {{2.0 * M_PI * 100.0 / kRate, 0.09}, {2.0 * M_PI * 200.0 / kRate, 0.05}};
}

TEST(LiveTone, SoundsForASecondInPlaceOfTheWater) {
  LiveTone tone(tones(), kRate);
  Played played(tone);
  played.go(0.1);
  tone.choose(1);
  played.go(1.5);
  EXPECT_TRUE(played.is_water(0, 0.0, 1.6)) << "the other channel";
  EXPECT_TRUE(played.is_water(1, 0.0, 0.1));
  EXPECT_TRUE(played.is_water(1, 1.15, 1.6)) << "it ends by itself";
  const auto& heard = played.channel(1);
  float least = 1.0F;
  float most = -1.0F;
  for (std::size_t i = 9600; i < 48000; ++i) {
    least = std::min(least, heard[i]);
    most = std::max(most, heard[i]);
  }
  EXPECT_NEAR(most, 0.05F, 1e-3F) << "no water beside it";
  EXPECT_NEAR(least, -0.05F, 1e-3F);
  for (std::size_t i = 1; i < heard.size(); ++i) {
    EXPECT_LE(heard[i], kWater) << "never more than the louder of both";
    EXPECT_LT(std::abs(heard[i] - heard[i - 1]), 0.003F) << "no click at " << i;
  }
}

TEST(LiveTone, StaysUnderACeilingThatWasLowered) {
  LiveTone tone(tones(), kRate);
  Played played(tone);
  tone.choose(1, 0.2);
  played.go(0.5);
  const auto& heard = played.channel(1);
  EXPECT_NEAR(*std::max_element(heard.begin() + 9600, heard.end()), 0.01F, 1e-3F);
}

TEST(LiveTone, AnotherChannelOrNoneEndsItSoftly) {
  LiveTone tone(tones(), kRate);
  Played played(tone);
  tone.choose(0);
  played.go(0.3);
  tone.choose(1);
  played.go(0.3);
  EXPECT_TRUE(played.is_water(0, 0.35, 0.6));
  EXPECT_FALSE(played.is_water(1, 0.35, 0.6));
  tone.choose(LiveTone::kNone);
  played.go(0.3);
  EXPECT_TRUE(played.is_water(1, 0.65, 0.9));
  tone.choose(7);
  played.go(0.1);
  EXPECT_TRUE(played.is_water(0, 0.9, 1.0)) << "there is no such channel";
}

}  // namespace
}  // namespace splash::synth
