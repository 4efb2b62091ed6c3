// SPDX-License-Identifier: MIT
#include "tests/synth-server/sound/sensation_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth-server/render/audibility.hpp"

namespace splash::synth {
namespace {

double middle_of(std::size_t third) {
  return 1000.0 * std::exp2((static_cast<double>(third) - 17.0) / 3.0);
}

/// Mean square of the sine of `turns` turns in the window (Goertzel 1958).
double bin_power(std::span<const float> window, int turns) {
  const auto count = static_cast<double>(window.size());
  const double w = 2.0 * std::numbers::pi * turns / count;
  const double twice = 2.0 * std::cos(w);
  double last = 0.0;
  double before = 0.0;
  for (const float sample : window) {
    const double now = static_cast<double>(sample) + twice * last - before;
    before = last;
    last = now;
  }
  return 2.0 * (last * last + before * before - twice * last * before) / (count * count);
}

}  // namespace

ThirdPowers third_powers(std::span<const float> window, double sample_rate) {
  ThirdPowers powers{};
  const double width = sample_rate / static_cast<double>(window.size());  // of a bin [Hz]
  const double edge = std::exp2(1.0 / 6.0);
  const int last = static_cast<int>(middle_of(kThirds - 1) * edge / width) + 1;
  for (int turns = 1; turns <= last; ++turns) {
    const double power = bin_power(window, turns);
    const double low = (turns - 0.5) * width;
    for (std::size_t third = 0; third < kThirds; ++third) {
      const double from = std::max(low, middle_of(third) / edge);
      const double to = std::min(low + width, middle_of(third) * edge);
      powers[third] += power * std::max(0.0, to - from) / width;
    }
  }
  return powers;
}

double sensation_level_db(const ThirdPowers& powers, double level_db) {
  double loudest = -300.0;
  for (std::size_t third = 0; third < kThirds; ++third) {
    const double level = 10.0 * std::log10(powers[third] + 1e-30);
    loudest = std::max(loudest, level - level_db - touch_threshold_db(middle_of(third)));
  }
  return loudest;
}

std::vector<double> sensation_levels(std::span<const float> signal, double sample_rate,
                                     double level_db) {
  const auto count = static_cast<std::size_t>(kSensationWindow * sample_rate);
  std::vector<double> levels;
  for (std::size_t at = 0; at + count <= signal.size(); at += count / 2) {
    levels.push_back(
        sensation_level_db(third_powers(signal.subspan(at, count), sample_rate), level_db));
  }
  return levels;
}

}  // namespace splash::synth
