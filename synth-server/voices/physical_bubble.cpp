// SPDX-License-Identifier: MIT
#include "synth-server/voices/physical_bubble.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace splash::synth {
namespace {

using Complex = std::complex<double>;

/// a b, without what std::complex does for infinities.
Complex product(Complex a, Complex b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Complex inverse(Complex a) noexcept {
  const double scale = 1.0 / (a.real() * a.real() + a.imag() * a.imag());
  return {a.real() * scale, -a.imag() * scale};
}

/// k = gamma / (1 - 3 (gamma - 1) i x [s coth s - 1]) with s = sqrt(i / x): the gas's pressure
/// follows its volume as p V^k. `x`: heat's diffusivity over w r^2 [1].
Complex polytropic(double x, double heat_ratio) noexcept {
  const double y = std::sqrt(0.5 / x);  // s = y (1 + i)
  Complex coth(1.0, 0.0);
  if (y < 20.0) {  // beyond, coth is 1 to the last bit
    const double scale = 1.0 / (std::cosh(2.0 * y) - std::cos(2.0 * y));
    coth = {std::sinh(2.0 * y) * scale, -std::sin(2.0 * y) * scale};
  }
  const Complex bracket = product({y, y}, coth) - 1.0;
  const Complex below = 1.0 - product({0.0, 3.0 * (heat_ratio - 1.0) * x}, bracket);
  return heat_ratio * inverse(below);
}

/// w0 depends on k, and k on w0: from Minnaert's value on, each round is some 30 times nearer.
constexpr int kRounds = 5;

}  // namespace

BubbleResonance resonance(double radius, double depth, const Water& water) noexcept {
  const double tension = 2.0 * water.surface_tension / radius;
  const double gas = water.atmosphere + water.density * water.gravity * depth + tension;
  const double inertia = water.density * radius * radius;
  const auto turning = [&](double k) { return std::sqrt((3.0 * k * gas - tension) / inertia); };
  Complex k(water.heat_ratio, 0.0);
  for (int round = 0; round < kRounds; ++round) {
    const double x = water.gas_diffusivity / (turning(k.real()) * radius * radius);
    k = polytropic(x, water.heat_ratio);
  }
  const double w = turning(k.real());
  return {w / (2.0 * std::numbers::pi), k.real(), 2.0 * water.viscosity / inertia,
          1.5 * gas * k.imag() / (inertia * w), w * w * radius / (2.0 * water.sound_speed)};
}

}  // namespace splash::synth
