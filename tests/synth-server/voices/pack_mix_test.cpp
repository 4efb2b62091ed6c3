// SPDX-License-Identifier: MIT
// How packs get into a channel: the plain sum of their lanes.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {
namespace {

/// As many packs as are ever mixed together, with rows and gains drawn at random.
struct Drawn {
  explicit Drawn(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    for (auto& pack : rows) {
      for (double& value : pack) value = draw(random);
    }
    for (auto& feed : feeds) {
      for (double& gain : feed.gains) gain = draw(random);
    }
  }
  [[nodiscard]] PackMix first(int count) const {
    PackMix mix;
    mix.count = count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      mix.rows[k] = rows[k].data();
      mix.feeds[k] = &feeds[k];
    }
    return mix;
  }
  /// What sample `n` of the piece should add to the channel.
  [[nodiscard]] double sum(int count, int n) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
        sum += feeds[k].gains[lane] * rows[k][static_cast<std::size_t>(n) * kPackVoices + lane];
      }
    }
    return sum;
  }

  alignas(64) std::array<std::array<double, kRows>, kMixedPacks> rows;
  std::array<PackFeed, kMixedPacks> feeds;
};

class PackMixing : public testing::TestWithParam<InstructionSet> {};

TEST_P(PackMixing, AddsUpAllLanes) {
  if (available(GetParam()) != GetParam()) GTEST_SKIP() << "this processor has no such set";
  const PackKernels kernels = pack_kernels(GetParam());
  const auto drawn = std::make_unique<Drawn>(3);
  for (int count = 1; count <= kMixedPacks; ++count) {
    for (const auto& [from, to] : {std::pair{0, kCell}, std::pair{3, 40}, std::pair{61, 64}}) {
      alignas(64) std::array<double, kRows> sums{};
      kernels.mix(drawn->first(count), from, to, sums.data());
      std::array<double, kCell> out{};
      kernels.collect(sums.data(), from, to, out.data());
      for (int n = 0; n < kCell; ++n) {
        const double expected = n >= from && n < to ? drawn->sum(count, n - from) : 0.0;
        ASSERT_NEAR(out[static_cast<std::size_t>(n)], expected, 1e-12) << count << ", " << n;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PackMixing,
                         testing::Values(InstructionSet::portable, InstructionSet::avx2,
                                         InstructionSet::avx512),
                         [](const auto& set) {
                           std::string name = name_of(set.param);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace splash::synth
