// SPDX-License-Identifier: MIT
#include "synth-server/voices/cloud.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {
namespace {

constexpr double kMostSum = 5.0;  ///< what S counts for at most [1]

}  // namespace

double lowered(double sum) noexcept {
  return 1.0 / std::sqrt(1.0 + sum / (1.0 + sum / kMostSum));
}

double Cloud::enter(const CloudSound& sound, const protocol::Vec3& place, double radius,
                    double frequency, std::int64_t sample) noexcept {
  if (sound.coupling <= 0.0) return 1.0;
  const auto span = static_cast<std::int64_t>(sound.company * sample_rate_);
  const auto x = static_cast<double>(place.x);
  const auto y = static_cast<double>(place.y);
  const auto z = static_cast<double>(place.z);
  const double square = frequency * frequency;
  while (count_ > 0 && sample - born_[(next_ + kMost - count_) % kMost] > span) --count_;
  double sum = 0.0;
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      const double dx = x_[j] - x;
      const double dy = y_[j] - y;
      const double dz = z_[j] - z;
      const double apart = dx * dx + dy * dy + dz * dz + 4.0 * radius * radius_[j];
      sum += radius_[j] * std::min(1.0, square_[j] / square) / std::sqrt(apart);
    }
  };
  // The ring in one or two pieces.
  if (count_ > next_) add(next_ + kMost - count_, kMost);
  add(next_ - std::min(next_, count_), next_);

  x_[next_] = x;
  y_[next_] = y;
  z_[next_] = z;
  radius_[next_] = radius;
  square_[next_] = square;
  born_[next_] = sample;
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
  return lowered(sound.coupling * sum);
}

}  // namespace splash::synth
