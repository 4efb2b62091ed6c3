// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubble_draw.hpp"

#include <algorithm>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace splash::sim {

double power_law(double share, double low, double high, double exponent) {
  const double power = 1.0 - exponent;
  if (std::abs(power) < 1e-9) return low * std::pow(high / low, share);
  const double a = std::pow(low, power);
  const double b = std::pow(high, power);
  return std::clamp(std::pow(a + share * (b - a), 1.0 / power), low, high);
}

Draws draw(std::uint32_t seed, std::uint32_t step, std::uint32_t particle) {
  const r123::Philox4x32 generator;
  const r123::Philox4x32::key_type key = {{seed, 0x62756262U}};  // "bubb"
  const r123::Philox4x32::ctr_type counter = {{step, particle, 0U, 0U}};
  const auto bits = generator(counter, key);
  constexpr double kUnit = 1.0 / 4294967296.0;  // 2^-32
  return {bits[0] * kUnit, bits[1] * kUnit, bits[2] * kUnit};
}

}  // namespace splash::sim
