// SPDX-License-Identifier: MIT
// The draws of radius, excitation and moment: their law, and what they depend on; and how many
// bubbles are told.
#include "sim-server/detect/bubble_draw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

namespace splash::sim {
namespace {

constexpr int kDraws = 100'000;

struct Law {
  const char* name;
  double low;
  double high;
  double exponent;
};

void PrintTo(const Law& law, std::ostream* out) {
  *out << law.name;
}

/// Share of x^-exponent on [low, high] below `x`.
double share_below(const Law& law, double x) {
  if (law.exponent == 1.0) return std::log(x / law.low) / std::log(law.high / law.low);
  const auto power = [&](double value) { return std::pow(value, 1.0 - law.exponent); };
  return (power(x) - power(law.low)) / (power(law.high) - power(law.low));
}

/// Kolmogorov and Smirnov's D: largest distance of the values' own distribution from the law.
double farthest_from(const Law& law, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double share = share_below(law, values[k]);
    const auto rank = static_cast<double>(k);
    worst = std::max({worst, std::abs(share - rank / count), std::abs(share - (rank + 1) / count)});
  }
  return worst;
}

class PowerLaw : public ::testing::TestWithParam<Law> {};

// 1 in 100 fair sets of 1e5 has D above 0.0052 (1.63 over the root of their number).
TEST_P(PowerLaw, IsWhatDrawsFollow) {
  const Law law = GetParam();
  std::vector<double> radii;
  std::vector<double> excitations;
  for (std::uint32_t k = 0; k < kDraws; ++k) {
    const Draws draws = draw(1, k % 300, k / 300);
    radii.push_back(power_law(draws.radius, law.low, law.high, law.exponent));
    excitations.push_back(power_law(draws.epsilon, law.low, law.high, law.exponent));
  }
  const double d_radius = farthest_from(law, radii);
  const double d_excitation = farthest_from(law, excitations);
  std::printf("%s: D = %.4f, %.4f\n", law.name, d_radius, d_excitation);
  EXPECT_LT(d_radius, 0.006);
  EXPECT_LT(d_excitation, 0.006);
}

TEST_P(PowerLaw, KeepsItsBounds) {
  const Law law = GetParam();
  EXPECT_NEAR(power_law(0.0, law.low, law.high, law.exponent), law.low, 1.0e-12 * law.low);
  EXPECT_NEAR(power_law(1.0, law.low, law.high, law.exponent), law.high, 1.0e-9 * law.high);
  double last = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const double value = power_law(k / 1000.0, law.low, law.high, law.exponent);
    ASSERT_GE(value, law.low);
    ASSERT_LE(value, law.high);
    ASSERT_GT(value, last);
    last = value;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, PowerLaw,
                         ::testing::Values(Law{"radius", 0.003, 0.030, 10.0 / 3.0},
                                           Law{"excitation", 0.01, 0.1, 2.0},
                                           Law{"reciprocal", 0.01, 0.1, 1.0},
                                           Law{"uniform", 0.5, 2.0, 0.0},
                                           Law{"flat", 1.0e-4, 1.0, 0.5}),
                         [](const auto& law) { return std::string(law.param.name); });

// The limit of exponent 1 is taken without a jump.
TEST(PowerLawLimit, IsContinuousAtOne) {
  for (const double share : {0.1, 0.5, 0.9}) {
    const double at = power_law(share, 0.01, 0.1, 1.0);
    for (const double off : {-1.0e-6, -1.0e-8, 1.0e-8, 1.0e-6}) {
      EXPECT_NEAR(power_law(share, 0.01, 0.1, 1.0 + off), at, 1.0e-5 * at);
    }
  }
}

TEST(PowerLawLimit, ABandOfNoWidthIsOneValue) {
  EXPECT_DOUBLE_EQ(power_law(0.7, 0.01, 0.01, 2.0), 0.01);
  EXPECT_DOUBLE_EQ(power_law(0.7, 0.01, 0.01, 1.0), 0.01);
}

std::array<double, 3> numbers(std::uint32_t seed, std::uint32_t step, std::uint32_t particle) {
  const Draws draws = draw(seed, step, particle);
  return {draws.radius, draws.epsilon, draws.moment};
}

TEST(Draw, DiffersBySeedStepAndParticle) {
  std::set<double> radii;
  int draws = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    for (std::uint32_t step = 0; step < 20; ++step) {
      for (std::uint32_t particle = 0; particle < 20; ++particle) {
        for (const double number : numbers(seed, step, particle)) radii.insert(number);
        draws += 3;
      }
    }
  }
  // Two of 24,000 among 2^32 are alike once in 15 times.
  EXPECT_GE(static_cast<int>(radii.size()), draws - 1);
}

TEST(Draw, HasThreeNumbersThatDoNotKnowEachOther) {
  std::array<double, 3> mean = {};
  std::array<std::array<double, 3>, 3> product = {};
  for (std::uint32_t k = 0; k < kDraws; ++k) {
    const auto n = numbers(3, k, 11);
    for (std::size_t a = 0; a < 3; ++a) {
      ASSERT_GE(n[a], 0.0);
      ASSERT_LT(n[a], 1.0);
      mean[a] += n[a] / kDraws;
      for (std::size_t b = 0; b < 3; ++b) product[a][b] += (n[a] - 0.5) * (n[b] - 0.5) / kDraws;
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(mean[a], 0.5, 4.0e-3);
    for (std::size_t b = 0; b < 3; ++b) {
      EXPECT_NEAR(product[a][b], a == b ? 1.0 / 12.0 : 0.0, 1.2e-3);
    }
  }
}

/// Philox 4x32 with ten rounds, from the formulas of Salmon et al. 2011.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53U} * c[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ key[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return c;
}

// Logs made with another version must not sound different: the generator and its key stay.
TEST(Draw, IsPhilox) {
  // Known answer of the generator's authors for all zeros.
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0})[0], 0x6627E8D5U);
  for (std::uint32_t k = 0; k < 50; ++k) {
    const auto bits = philox({1000 + k, 17 * k, 0, 0}, {k, 0x62756262U});
    const auto n = numbers(k, 1000 + k, 17 * k);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(n[a], bits[a] / 4294967296.0);
  }
}

TEST(PowerLaw, MomentsAreThoseOfTheDraws) {
  for (const Law& law : {Law{"radius", 0.003, 0.030, 10.0 / 3.0}, Law{"fourth", 0.001, 0.01, 4.0},
                         Law{"uniform", 1.0, 2.0, 0.0}}) {
    SCOPED_TRACE(law.name);
    double sum = 0.0;  // midpoint rule over the shares
    for (int k = 0; k < kDraws; ++k) {
      sum += std::pow(power_law((k + 0.5) / kDraws, law.low, law.high, law.exponent), 3.0);
    }
    EXPECT_NEAR(power_law_moment(law.low, law.high, law.exponent, 3.0), sum / kDraws,
                2.0e-3 * sum / kDraws);
  }
  EXPECT_DOUBLE_EQ(power_law_moment(0.01, 0.01, 2.0, 3.0), 1.0e-6);
}

// For each volume between that of the scene's law and that of its largest bubbles.
TEST(LeastRadius, GivesTheLawsBubblesTheVolumeThatIsWanted) {
  const DetectSettings settings;
  for (const double times : {1.0, 1.5, 4.0, 10.0, 20.0}) {
    const double volume = times * mean_volume(settings);
    EXPECT_NEAR(mean_volume(settings, least_radius(settings, volume)), volume, 1e-6 * volume);
  }
  EXPECT_EQ(least_radius(settings, 0.0), settings.radius_min);
  EXPECT_EQ(least_radius(settings, 1.0), 0.5 * settings.radius_max);
}

TEST(LeastRadius, IsTheOnlyRadiusThereIs) {
  DetectSettings settings;
  settings.radius_min = settings.radius_max = 0.004;
  EXPECT_EQ(least_radius(settings, 1.0), 0.004);
  EXPECT_EQ(least_radius(settings, 0.0), 0.004);
}

// Of any 64 in a row one is in each 64th; other seeds give others.
TEST(EvenShares, FillTheirRangeEvenly) {
  for (const std::uint32_t seed : {0U, 1U, 77U}) {
    for (const std::uint32_t from : {0U, 17U, 6400U}) {
      std::vector<int> in(64, 0);
      for (std::uint32_t k = from; k < from + 64U; ++k) {
        ++in[static_cast<std::size_t>(64.0 * even_share(seed, k))];
      }
      EXPECT_EQ(in, std::vector<int>(64, 1)) << "seed " << seed << ", from " << from;
    }
  }
  EXPECT_NE(even_share(1, 5), even_share(2, 5));
}

TEST(BubbleBudget, IsSoManyASecond) {
  BubbleBudget budget(300.0);
  int told = 0;
  for (int k = 1; k <= 2000; ++k) {
    const int open = budget.open(0.005 * k);
    budget.spend(open);
    told += open;
  }
  EXPECT_GE(told, 3000);
  EXPECT_LE(told, 3015);
}

TEST(BubbleBudget, KeepsWhatFiftyMillisecondsLeft) {
  BubbleBudget budget(4000.0);
  EXPECT_EQ(budget.open(10.0), 200);
  budget.spend(200);
  EXPECT_EQ(budget.open(10.0051), 20);
  EXPECT_EQ(budget.open(10.0301), 120);
  EXPECT_EQ(budget.open(99.0), 200);
}

TEST(BubbleBudget, LetsOneThroughNowAndThenHoweverSmall) {
  BubbleBudget budget(2.0);
  EXPECT_EQ(budget.open(0.0), 1);
  budget.spend(1);
  EXPECT_EQ(budget.open(0.4), 0);
  EXPECT_EQ(budget.open(0.6), 1);
}

}  // namespace
}  // namespace splash::sim
