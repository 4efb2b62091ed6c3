// SPDX-License-Identifier: MIT
#include "synth-server/voices/cloud.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace splash::synth {
namespace {

constexpr double kMostSum = 5.0;  ///< what S counts for at most [1]

/// Four bubbles at once, with the compiler's vectors: 500 others of 10,000 births a second are five
/// million terms, each with a root and a division by it.
using Four __attribute__((vector_size(16))) = float;
using FourWords __attribute__((vector_size(16))) = std::int32_t;
constexpr std::size_t kFour = 4;

Four load(const float* from) noexcept {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

/// x^(-1/2) of positive numbers, to the last bits: halving the exponent gives it within 4 %, and
/// each of Newton's rounds squares what is missing. No root, no division.
Four inverse_root(const Four& x) noexcept {
  auto y = std::bit_cast<Four>(0x5f375a86 - (std::bit_cast<FourWords>(x) >> 1));
  for (int round = 0; round < 3; ++round) y = y * (1.5F - 0.5F * x * y * y);
  return y;
}

}  // namespace

double lowered(double sum) noexcept {
  return 1.0 / std::sqrt(1.0 + sum / (1.0 + sum / kMostSum));
}

double Cloud::enter(const CloudSound& sound, const protocol::Vec3& place, double radius,
                    double frequency, std::int64_t sample) noexcept {
  if (sound.coupling <= 0.0) return 1.0;
  const auto span = static_cast<std::int64_t>(sound.company * sample_rate_);
  while (count_ > 0 && sample - born_[oldest()] > span) {
    radius_[oldest()] = 0.0F;  // counts for nothing
    --count_;
  }
  const auto square = static_cast<float>(frequency * frequency);
  const auto own_radius = static_cast<float>(radius);
  const float softness = 1.0F / square;
  Four sums{};
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from / kFour * kFour; j < to; j += kFour) {
      const Four dx = load(&x_[j]) - place.x;
      const Four dy = load(&y_[j]) - place.y;
      const Four dz = load(&z_[j]) - place.z;
      const Four r = load(&radius_[j]);
      const Four apart = dx * dx + dy * dy + dz * dz + 4.0F * own_radius * r;
      const Four part = load(&square_[j]) * softness;
      sums += r * (part < 1.0F ? part : Four{} + 1.0F) * inverse_root(apart);
    }
  };
  // Who is not there has no radius, so that whole fours may be added, and a ring that goes round
  // the end as a whole.
  count_ > next_ ? add(0, kMost) : add(oldest(), next_);
  const double sum = static_cast<double>(sums[0]) + static_cast<double>(sums[1]) +
                     static_cast<double>(sums[2]) + static_cast<double>(sums[3]);

  x_[next_] = place.x;
  y_[next_] = place.y;
  z_[next_] = place.z;
  radius_[next_] = own_radius;
  square_[next_] = square;
  born_[next_] = sample;
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
  return lowered(sound.coupling * sum);
}

}  // namespace splash::synth
