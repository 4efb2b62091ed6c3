// SPDX-License-Identifier: MIT
#include "synth-server/voices/bubble_pack.hpp"

#include <complex>
#include <initializer_list>

namespace splash::synth {
namespace {

void set(ComplexLanes& lanes, std::size_t lane, std::complex<double> value) noexcept {
  lanes.re[lane] = value.real();
  lanes.im[lane] = value.imag();
}

void copy(const ComplexLanes& from, ComplexLanes& to, std::size_t lane) noexcept {
  to.re[lane] = from.re[lane];
  to.im[lane] = from.im[lane];
}

/// a b, without what std::complex does for infinities.
std::complex<double> product(std::complex<double> a, std::complex<double> b) noexcept {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// A tone by samples: phase(n) = turn n + rise n^2, both of a sample.
struct Steps {
  Steps(const BubbleTone& tone, double sample_rate, int ahead) noexcept
      : turn(2.0 * std::numbers::pi * tone.frequency / sample_rate),
        curve(turn * tone.rise / sample_rate),
        decay(tone.damping / sample_rate),
        first(-ahead) {}

  /// z(n) / A at sample n = first, seen from the tone's start.
  [[nodiscard]] std::complex<double> start() const noexcept {
    return std::polar(std::exp(-decay * first), (turn + curve * first) * first);
  }
  /// z(first + count) / z(first)
  [[nodiscard]] std::complex<double> leap(double count) const noexcept {
    return std::polar(std::exp(-decay * count), (turn + curve * (2.0 * first + count)) * count);
  }
  /// What leap(count) is multiplied by, once for every `later` samples that it begins later.
  [[nodiscard]] std::complex<double> rise(double count, double later) const noexcept {
    return std::polar(1.0, 2.0 * curve * count * later);
  }

  double turn;   ///< [rad]
  double curve;  ///< [rad]
  double decay;  ///< [1]
  double first;  ///< [samples], not positive
};

}  // namespace

void set_lane(BubblePack& pack, std::size_t lane, const BubbleTone& tone, double sample_rate,
              int ahead) noexcept {
  const Steps steps(tone, sample_rate, ahead);
  const std::complex<double> first = tone.amplitude * steps.start();
  const std::complex<double> rise = steps.rise(2.0, 1.0);
  const std::complex<double> turn = steps.leap(2.0);
  set(pack.sound[0], lane, first);
  set(pack.sound[1], lane, product(first, steps.leap(1.0)));
  set(pack.turn[0], lane, turn);
  set(pack.turn[1], lane, product(turn, rise));
  set(pack.rise, lane, product(rise, rise));
}

void copy_lane(const BubblePack& from, BubblePack& to, std::size_t lane) noexcept {
  for (const std::size_t parity : {std::size_t{0}, std::size_t{1}}) {
    copy(from.sound[parity], to.sound[parity], lane);
    copy(from.turn[parity], to.turn[parity], lane);
  }
  copy(from.rise, to.rise, lane);
}

}  // namespace splash::synth
