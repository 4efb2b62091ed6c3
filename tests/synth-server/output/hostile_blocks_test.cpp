// SPDX-License-Identifier: MIT
// A million blocks of whatever could come out of a broken mix, through guards of all kinds: each
// sample that leaves is finite, within the ceiling and no steeper than allowed, heats no transducer
// beyond what it bears, and one block after
// the last bad sample the guard plays as if there had been none.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "synth-server/output/output_guard.hpp"

namespace splash::synth {
namespace {

constexpr int kBlock = 32;
constexpr int kBlocks = 1'000'000;
constexpr int kGuards = 8;
using Block = std::array<double, kBlock>;

enum class Kind { nan, sparse_nan, infinite, huge, largest, denormal, constant, step, loud, count };

double bad_number(std::uint32_t draw) {
  constexpr std::array<double, 6> kBad = {std::numeric_limits<double>::quiet_NaN(),
                                          -std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity(),
                                          -std::numeric_limits<double>::infinity(),
                                          1e30,
                                          -1e30};
  return kBad[draw % kBad.size()];
}

double sample_of(Kind kind, int n, double level, std::uint32_t draw) {
  switch (kind) {
    case Kind::nan:
      return std::numeric_limits<double>::quiet_NaN();
    case Kind::sparse_nan:
      return draw % 16 == 0 ? bad_number(draw / 16) : level * std::sin(0.02 * n);
    case Kind::infinite:
      return draw % 2 == 0 ? bad_number(2) : bad_number(3);
    case Kind::huge:
      return draw % 3 == 0 ? 1e30 : -1e30;
    case Kind::largest:
      return std::numeric_limits<double>::max();
    case Kind::denormal:
      return draw % 2 == 0 ? 1e-310 : -1e-310;
    case Kind::constant:
      return level;
    case Kind::step:
      return n < static_cast<int>(draw % kBlock) ? -level : level;
    default:
      return level * (static_cast<double>(draw % 2001) - 1000.0) * 1e-3;
  }
}

bool is_bad(double value) {
  return !(std::abs(value) < OutputGuard::kNonsense);
}

Output transducer(int kind) {
  Output output;
  output.name = "x";
  output.ceiling = 0.1 + 0.125 * kind;
  if (kind % 2 == 1) output.band = {12.0, 20000.0};
  if (kind % 4 < 2) output.heat = {std::max(0.05, 0.4 * output.ceiling), 0.2};
  if (kind % 4 >= 2) {
    output.equalisers.emplace_back();
    output.equalisers[0].most_boost_db = 24.0;
    output.equalisers[0].response = {{25, 60, 150, 400}, {-30, 12, -9, 20}, 40.0};
  }
  return output;
}

/// A guard under fire, and what it has to hold to.
struct Target {
  explicit Target(int kind)
      : output(transducer(kind)),
        rate(kind % 3 == 0 ? 44100.0 : 96000.0),
        fresh(output, rate),
        guard(fresh),
        slew(4.0 * std::numbers::pi * std::min(output.band.high, 0.5 * rate) * output.ceiling /
             rate) {}

  Output output;
  double rate;
  OutputGuard fresh;
  OutputGuard guard;
  double slew;
  double last = 0.0;
  double heat = 0.0;  ///< mean square, forgotten within 0.2 s
  double hottest = 0.0;

  /// True when all of the block may leave.
  [[nodiscard]] bool holds(const std::array<float, kBlock>& out) {
    bool good = true;
    for (const float sample : out) {
      const auto value = static_cast<double>(sample);
      good = good && std::isfinite(sample) && std::abs(value) <= output.ceiling &&
             std::abs(value - last) <= slew * (1.0 + 1e-6) + 1e-7;
      last = value;
      heat += (value * value - heat) / (0.2 * rate);
    }
    hottest = std::max(hottest, heat);
    const double bears = output.heat.rms;
    return good && (bears == 0.0 || heat <= bears * bears * (1.0 + 1e-6));
  }
};

class HostileBlocks : public testing::Test {
 protected:
  HostileBlocks() {
    open_.fill(1.0);
    for (int kind = 0; kind < kGuards; ++kind) targets_.emplace_back(kind);
  }

  /// A block of `kind`; where its last bad sample is, or -1.
  int fill(Kind kind, Block& block) {
    const double level = std::exp2(static_cast<double>(random_() % 24) - 12.0);
    int bad = -1;
    for (int n = 0; n < kBlock; ++n) {
      const auto at = static_cast<std::size_t>(n);
      block[at] = sample_of(kind, n, level, static_cast<std::uint32_t>(random_()));
      if (is_bad(block[at])) bad = n;
    }
    return bad;
  }

  bool play(Target& target, const Block& in) {
    target.guard.process(in.data(), open_.data(), out_.data(), kBlock);
    return target.holds(out_);
  }

  /// Two clean blocks after bad samples; the second is that of a guard that never saw them.
  void expect_recovered(Target& target, const Block& hostile, int bad) {
    OutputGuard spared = target.fresh;
    std::vector<double> since(hostile.begin() + bad + 1, hostile.end());
    for (int n = 0; n < 2 * kBlock; ++n) since.push_back(0.05 * std::sin(0.02 * n));
    std::vector<float> should_be(since.size());
    const std::vector<double> open(since.size(), 1.0);
    spared.process(since.data(), open.data(), should_be.data(), static_cast<int>(since.size()));
    Block clean{};
    for (int pass = 0; pass < 2; ++pass) {
      std::copy_n(since.end() - (2 - pass) * kBlock, kBlock, clean.begin());
      ASSERT_TRUE(play(target, clean));
    }
    ++recoveries_;
    if (target.output.heat.rms > 0.0) return;  // heat is not forgotten
    for (int n = 0; n < kBlock; ++n) {
      ASSERT_EQ(out_[static_cast<std::size_t>(n)],
                should_be[should_be.size() - static_cast<std::size_t>(kBlock - n)]);
    }
  }

  std::mt19937_64 random_{11};
  Block open_{};
  std::array<float, kBlock> out_{};
  std::vector<Target> targets_;
  int recoveries_ = 0;
};

TEST_F(HostileBlocks, AMillionOfThemDoNoHarm) {
  Block hostile{};
  for (int b = 0; b < kBlocks; ++b) {
    Target& target = targets_[static_cast<std::size_t>(b % kGuards)];
    const auto kind = static_cast<Kind>(random_() % static_cast<std::uint64_t>(Kind::count));
    const int bad = fill(kind, hostile);
    ASSERT_TRUE(play(target, hostile)) << "block " << b << ", kind " << static_cast<int>(kind);
    if (bad >= kBlock / 2 && random_() % 64 == 0) {
      expect_recovered(target, hostile, bad);
      ASSERT_FALSE(HasFatalFailure()) << "block " << b << ", kind " << static_cast<int>(kind);
    }
  }
  EXPECT_GT(recoveries_, 1000);
  for (const Target& target : targets_) {
    if (target.output.heat.rms == 0.0) continue;
    EXPECT_GT(std::sqrt(target.hottest), 0.7 * target.output.heat.rms) << "it never got warm";
  }
}

TEST_F(HostileBlocks, ConstantsAreGoneAfterASecond) {
  for (Target& target : targets_) {
    Block constant{};
    constant.fill(8.0);
    for (int b = 0; b < static_cast<int>(target.rate) / kBlock; ++b) (void)play(target, constant);
    ASSERT_TRUE(play(target, constant));
    for (const float sample : out_) ASSERT_LT(std::abs(sample), 1e-3F * 8.0F);
  }
}

}  // namespace
}  // namespace splash::synth
