// SPDX-License-Identifier: MIT
// Running packs of bubbles against their closed form over whole lives; the same bits in any blocks
// and with any instruction set.
#include "synth-server/voices/bubble_pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {
namespace {

/// A pack and its samples.
class PackPlayer {
 public:
  explicit PackPlayer(const PackKernels& kernels) : kernels_(kernels) {}

  void seat(std::size_t lane, const BubbleTone& tone, double rate, int ahead) {
    set_lane(pack_, lane, tone, rate, ahead);
  }
  void render(int from, int to) {
    kernels_.turn(pack_, from, to, &rows_[static_cast<std::size_t>(from) * kPackVoices]);
  }
  [[nodiscard]] double at(std::size_t lane, int n) const {
    return rows_[static_cast<std::size_t>(n) * kPackVoices + lane];
  }

 private:
  PackKernels kernels_;
  BubblePack pack_{};
  alignas(64) std::array<double, kRows> rows_{};
};

constexpr double kEpsilon = 0.05;
constexpr ToneSound kIntegrated{.rise = kIntegratedRise};
constexpr ToneSound kPhysical{.rise = kIntegratedRise, .physical = 1.0};

/// Sixteen radii from 1 mm to 0.3 m, evenly in their logarithm.
std::vector<BubbleTone> tones(const ToneSound& sound) {
  std::vector<BubbleTone> all;
  for (int lane = 0; lane < kPackVoices; ++lane) {
    const double radius = 0.001 * std::pow(300.0, lane / (kPackVoices - 1.0));
    all.push_back(bubble_tone(sound, radius, kEpsilon, 0.0));
  }
  return all;
}

/// Each lane's largest error over its life to -120 dB [dB re its amplitude]; lane k starts 4 k
/// samples into the first cell.
std::vector<double> errors(const PackKernels& kernels, const std::vector<BubbleTone>& voices,
                           double rate) {
  std::vector<std::int64_t> lengths;
  PackPlayer player(kernels);
  for (std::size_t lane = 0; lane < voices.size(); ++lane) {
    player.seat(lane, voices[lane], rate, static_cast<int>(4 * lane));
    lengths.push_back(life_of(voices[lane], rate, 1e-6 * voices[lane].amplitude).length);
  }
  std::vector<double> worst(voices.size(), 0.0);
  const std::int64_t longest = *std::max_element(lengths.begin(), lengths.end());
  for (std::int64_t cell = 0; cell * kCell < longest; ++cell) {
    player.render(0, kCell);
    for (std::size_t lane = 0; lane < voices.size(); ++lane) {
      for (int n = 0; n < kCell; ++n) {
        const std::int64_t sample = cell * kCell + n - static_cast<std::int64_t>(4 * lane);
        if (sample < 0 || sample >= lengths[lane]) continue;
        const double expected = pressure(voices[lane], static_cast<double>(sample) / rate);
        const double error = std::abs(player.at(lane, n) - expected);
        worst[lane] = std::max(worst[lane], error / voices[lane].amplitude);
      }
    }
  }
  for (double& error : worst) error = 20.0 * std::log10(error);
  return worst;
}

struct Case {
  double rate;
  ToneSound sound;
};

class BubblePackError : public testing::TestWithParam<Case> {
 protected:
  void expect_under(const PackKernels& kernels, double limit) {
    const std::vector<BubbleTone> voices = tones(GetParam().sound);
    const std::vector<double> found = errors(kernels, voices, GetParam().rate);
    for (std::size_t lane = 0; lane < found.size(); ++lane) {
      EXPECT_LT(found[lane], limit) << "f0 = " << voices[lane].frequency << " Hz";
      EXPECT_GT(found[lane], -330.0) << "compared with itself?";
    }
    const auto [least, most] = std::minmax_element(found.begin(), found.end());
    std::printf("%.0f Hz: largest error %.1f dB, smallest %.1f dB\n", GetParam().rate, *most,
                *least);
    RecordProperty("largest_error_db", std::to_string(*most));
  }
};

TEST_P(BubblePackError, IsUnderMinus140Decibels) {
  expect_under(pack_kernels(InstructionSet::best), -140.0);
}

INSTANTIATE_TEST_SUITE_P(All, BubblePackError,
                         testing::Values(Case{44100.0, {}}, Case{48000.0, {}}, Case{96000.0, {}},
                                         Case{44100.0, kIntegrated}, Case{48000.0, kPhysical}));

std::vector<double> render(const PackKernels& kernels, const std::vector<int>& pieces) {
  const std::vector<BubbleTone> voices = tones({});
  PackPlayer player(kernels);
  for (std::size_t lane = 0; lane < voices.size(); ++lane) {
    player.seat(lane, voices[lane], 48000.0, static_cast<int>(lane));
  }
  std::vector<double> out;
  for (int cell = 0; cell < 50; ++cell) {
    int done = 0;
    for (std::size_t p = 0; done < kCell; ++p) {
      const int end = std::min(kCell, done + pieces[p % pieces.size()]);
      player.render(done, end);
      done = end;
    }
    for (std::size_t lane = 0; lane < voices.size(); ++lane) {
      for (int n = 0; n < kCell; ++n) out.push_back(player.at(lane, n));
    }
  }
  return out;
}

TEST(BubblePack, IsTheSameInAnyPieces) {
  for (const InstructionSet set :
       {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    const auto whole = render(pack_kernels(set), {kCell});
    for (const std::vector<int>& pieces :
         std::vector<std::vector<int>>{{1}, {3, 17}, {16}, {31, 2}, {5, 1, 40}}) {
      EXPECT_EQ(render(pack_kernels(set), pieces), whole) << name_of(set) << " " << pieces[0];
    }
  }
}

TEST(BubblePack, GivesTheSameBitsOnEveryProcessor) {
  const auto portable = render(pack_kernels(InstructionSet::portable), {kCell});
  EXPECT_EQ(render(pack_kernels(InstructionSet::avx2), {kCell}), portable);
  EXPECT_EQ(render(pack_kernels(InstructionSet::avx512), {kCell}), portable);
  if (available(InstructionSet::best) == InstructionSet::portable) {
    std::printf("only the portable loops run on this processor\n");
  }
}

TEST(BubblePack, NeverGrows) {
  // A minute of the lowest voices: the envelope bounds every sample.
  const double rate = 44100.0;
  PackPlayer player(pack_kernels(InstructionSet::best));
  std::vector<BubbleTone> voices;
  for (int lane = 0; lane < kPackVoices; ++lane) {
    voices.push_back(paper_bubble(0.02 + 0.02 * lane, 1.0));
    player.seat(static_cast<std::size_t>(lane), voices.back(), rate, 0);
  }
  for (int cell = 0; cell < 60 * 44100 / kCell; ++cell) {
    player.render(0, kCell);
    for (std::size_t lane = 0; lane < voices.size(); ++lane) {
      const double bound =
          voices[lane].amplitude * std::exp(-voices[lane].damping * cell * kCell / rate) * 1.0001 +
          1e-36;
      for (int n = 0; n < kCell; ++n) {
        ASSERT_LE(std::abs(player.at(lane, n)), bound) << "cell " << cell;
      }
    }
  }
}

/// What lanes without a voice give: nil, whatever was in them.
TEST(BubblePack, IsSilentWhereALaneIsFree) {
  PackPlayer player(pack_kernels(InstructionSet::best));
  player.seat(3, paper_bubble(0.01, kEpsilon), 48000.0, 0);
  player.render(0, kCell);
  for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
    EXPECT_EQ(player.at(lane, 40) != 0.0, lane == 3) << lane;
  }
}

}  // namespace
}  // namespace splash::synth
