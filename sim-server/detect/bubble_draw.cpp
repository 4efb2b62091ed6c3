// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubble_draw.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/fluid/random_draw.hpp"

namespace splash::sim {

double power_law(double share, double low, double high, double exponent) {
  const double power = 1.0 - exponent;
  if (std::abs(power) < 1e-9) return low * std::pow(high / low, share);
  const double a = std::pow(low, power);
  const double b = std::pow(high, power);
  return std::clamp(std::pow(a + share * (b - a), 1.0 / power), low, high);
}

double power_law_moment(double low, double high, double exponent, double power) {
  // The integral of x^p from low to high.
  const auto integral = [low, high](double p) {
    if (std::abs(p + 1.0) < 1e-9) return std::log(high / low);
    return (std::pow(high, p + 1.0) - std::pow(low, p + 1.0)) / (p + 1.0);
  };
  if (high <= low) return std::pow(low, power);
  return integral(power - exponent) / integral(-exponent);
}

double mean_volume(const DetectSettings& settings) {
  return mean_volume(settings, settings.radius_min);
}

double mean_volume(const DetectSettings& settings, double least) {
  return 4.0 / 3.0 * std::numbers::pi *
         power_law_moment(least, settings.radius_max, settings.radius_exponent, 3.0);
}

double least_radius(const DetectSettings& settings, double volume) {
  constexpr int kHalvings = 40;
  double low = settings.radius_min;
  double high = std::max(low, 0.5 * settings.radius_max);
  if (mean_volume(settings, high) <= volume) return high;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_volume(settings, middle) < volume ? low : high) = middle;
  }
  return low;
}

double even_share(std::uint32_t seed, std::uint32_t k) {
  // Laine & Karras' permutation: a bit depends on those below it alone. Burley 2020, listing 2.
  std::uint32_t x = k + seed;
  for (const std::uint32_t factor : {0x6c50b47cU, 0xb82f1e52U, 0xc7afe638U, 0x8d22f6e6U}) {
    x ^= x * factor;
  }
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (x >> bit & 1U) << (31 - bit);
  return reversed / 4294967296.0;
}

Draws draw(std::uint32_t seed, std::uint32_t step, std::uint32_t particle, int bubble) {
  const auto shares = random_draw({step, particle, static_cast<std::uint32_t>(bubble), 0U},
                                  {seed, 0x62756262U});  // "bubb"
  return {shares[0], shares[1], shares[2], shares[3]};
}

namespace {

/// What is left serves for so long [s].
constexpr double kBurst = 0.050;

double most(double rate) {
  return std::max(1.0, kBurst * rate);
}

}  // namespace

BubbleBudget::BubbleBudget(double rate) : rate_(rate), left_(most(rate)) {}

int BubbleBudget::open(double time) {
  left_ = std::min(most(rate_), left_ + rate_ * std::max(0.0, time - filled_));
  filled_ = time;
  return static_cast<int>(left_);
}

}  // namespace splash::sim
