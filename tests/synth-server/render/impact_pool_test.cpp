// SPDX-License-Identifier: MIT
// The impacts' pool: the same rules as the bubbles', for voices that are not formulas.
#include "synth-server/render/impact_pool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr Route kRoute{0, 1.0};

ImpactPool::Start start(ImpactPool& pool, double amplitude, std::uint64_t id, std::int64_t sample) {
  return pool.start(ImpactVoice({}, amplitude, Noise(1, id), kRate),
                    impact_life({}, amplitude, kRate, 1e-8), {&kRoute, 1}, sample);
}

std::vector<double> mix(ImpactPool& pool, std::int64_t from, std::int64_t to) {
  std::vector<double> out;
  for (std::int64_t at = from; at < to; at += kCell) {
    Mix cell(1);
    pool.mix(at, at + kCell, cell);
    pool.release(at + kCell);
    out.insert(out.end(), cell.samples.begin(), cell.samples.end());
  }
  return out;
}

TEST(ImpactPool, StealsTheQuietestRefusesTheQuieterAndFreesItsPlaces) {
  using Start = ImpactPool::Start;
  ImpactPool pool(2, 1, kRate);
  EXPECT_EQ(start(pool, 0.02, 1, 0), Start::started);
  EXPECT_EQ(start(pool, 0.01, 2, 0), Start::started);
  EXPECT_EQ(start(pool, 0.005, 3, 0), Start::refused);
  EXPECT_EQ(start(pool, 0.03, 4, 0), Start::stole);
  const auto both = mix(pool, 0, 4800);
  ImpactVoice first({}, 0.02, Noise(1, 1), kRate);
  ImpactVoice second({}, 0.03, Noise(1, 4), kRate);
  std::vector<double> a(4800);
  std::vector<double> b(4800);
  first.render(a.data(), 4800);
  second.render(b.data(), 4800);
  for (std::size_t n = 241; n < both.size(); ++n) ASSERT_NEAR(both[n], a[n] + b[n], 1e-15) << n;
  EXPECT_EQ(pool.size(), 2U);
  mix(pool, 4800, 4800 + 100800);
  EXPECT_EQ(pool.size(), 0U);
}

TEST(ImpactPool, FadesAllOutWithoutAClick) {
  ImpactPool pool(4, 1, kRate);
  start(pool, 0.02, 1, 0);
  mix(pool, 0, 640);
  pool.fade_all(640);
  const auto rest = mix(pool, 640, 640 + 320);
  for (std::size_t n = 240; n < rest.size(); ++n) EXPECT_EQ(rest[n], 0.0);
  EXPECT_NE(rest[100], 0.0);
  EXPECT_EQ(pool.size(), 0U);
}

}  // namespace
}  // namespace splash::synth
