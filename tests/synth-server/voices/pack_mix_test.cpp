// SPDX-License-Identifier: MIT
// How packs get into channels: the plain sum, and two channels at once as each alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>

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
    for (auto& channel : feeds) {
      for (auto& feed : channel) {
        for (double& gain : feed.gains) gain = draw(random);
      }
    }
  }
  /// The first `count` of them, as `channel` gets them.
  [[nodiscard]] PackMix packs(std::size_t channel, int count) const {
    PackMix mix;
    mix.count = count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      mix.rows[k] = rows[k].data();
      mix.feeds[k] = &feeds[channel][k];
    }
    return mix;
  }
  /// What sample `n` of the piece should add to the channel.
  [[nodiscard]] double sum(std::size_t channel, int count, int n) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
        sum += feeds[channel][k].gains[lane] *
               rows[k][static_cast<std::size_t>(n) * kPackVoices + lane];
      }
    }
    return sum;
  }

  alignas(64) std::array<std::array<double, kRows>, kMixedPacks> rows;
  std::array<std::array<PackFeed, kMixedPacks>, 2> feeds;
};

struct Sums {
  alignas(64) std::array<double, kRows> values{};
};

class PackMixing : public testing::TestWithParam<InstructionSet> {};

void expect_sums(const PackKernels& kernels, double bound) {
  const auto drawn = std::make_unique<Drawn>(3);
  for (int count = 1; count <= kMixedPacks; ++count) {
    for (const auto& [from, to] : {std::pair{0, kCell}, std::pair{3, 40}, std::pair{61, 64}}) {
      Sums one;
      Sums other;
      Sums together;
      Sums with_it;
      kernels.mix(drawn->packs(0, count), from, to, one.values.data());
      kernels.mix(drawn->packs(1, count), from, to, other.values.data());
      kernels.mix_two(drawn->packs(0, count), drawn->packs(1, count), from, to,
                      together.values.data(), with_it.values.data());
      ASSERT_EQ(together.values, one.values) << count << " packs, from " << from;
      ASSERT_EQ(with_it.values, other.values) << count << " packs, from " << from;
      std::array<double, kCell> out{};
      kernels.collect(with_it.values.data(), from, to, out.data());
      for (int n = 0; n < kCell; ++n) {
        const bool inside = n >= from && n < to;
        const double expected = inside ? drawn->sum(1, count, n - from) : 0.0;
        ASSERT_NEAR(out[static_cast<std::size_t>(n)], expected, bound) << count << ", " << n;
      }
    }
  }
}

TEST_P(PackMixing, AddsUpAllLanesAndTwoChannelsAtOnceAsEachAlone) {
  if (available(GetParam()) != GetParam()) GTEST_SKIP() << "this processor has no such set";
  expect_sums(pack_kernels(GetParam()), 1e-12);
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
