// SPDX-License-Identifier: MIT
#include "synth-server/output/output_guard.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

/// Not for NaN, infinities and what is beyond kNonsense. By its bits, which order magnitudes as
/// the numbers themselves: holds whatever a compiler assumes about NaN.
bool is_signal(double value) noexcept {
  constexpr std::uint64_t kMagnitude = 0x7fffffffffffffffULL;
  return (std::bit_cast<std::uint64_t>(value) & kMagnitude) <
         std::bit_cast<std::uint64_t>(OutputGuard::kNonsense);
}

/// The largest float that does not exceed `value`.
double rounded_down(double value) noexcept {
  auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) > value) nearest = std::nextafter(nearest, 0.0F);
  return static_cast<double>(nearest);
}

constexpr double kSettled = 1.0e-12;  ///< states below this are nil: -240 dB

}  // namespace

OutputGuard::OutputGuard(const Output& output, double sample_rate, int channel)
    : band_(output.band, sample_rate),
      equaliser_(output, channel, sample_rate),
      heat_(output.heat, rounded_down(output.ceiling), sample_rate),
      limiter_(output.band.low, sample_rate),
      // A sine at the band's upper end and the ceiling changes by 2 pi f ceiling per second; twice
      // that never touches what the band lets through.
      slew_(2.0 * 2.0 * std::numbers::pi * std::min(output.band.high, 0.5 * sample_rate) *
            output.ceiling / sample_rate) {}

void OutputGuard::forget() noexcept {
  band_.reset();
  equaliser_.reset();
  limiter_.reset();
}

void OutputGuard::process(const double* in, const double* fade, float* out, int count,
                          const double* ceilings) noexcept {
  // What changes with every sample is kept out of memory meanwhile: each sample waits for the last.
  BandFilter band = band_;
  Limiter limiter = limiter_;
  HeatBudget heat = heat_;
  double last = last_;
  std::uint64_t resets = 0;
  std::uint64_t limited = 0;
  // The value, or nil and a fresh start when it is no signal.
  const auto checked = [&](double value) {
    if (is_signal(value)) return value;
    band.reset();
    equaliser_.reset();
    limiter.reset();
    ++resets;
    return 0.0;
  };
  for (int i = 0; i < count; ++i) {
    const double tame = std::clamp(checked(in[i]), -kMostInput, kMostInput);
    // Checked again: no filter of ours is unstable, but this is the place to be sure.
    const double even = checked(equaliser_.process(checked(band.process(tame))));
    double limit = heat.limit();
    if (ceilings != nullptr) limit = std::min(limit, rounded_down(ceilings[i]));
    const double quiet = limiter.process(even, limit);
    if (limiter.limiting()) ++limited;
    last += std::clamp(quiet - last, -slew_, slew_);
    const double played = std::clamp(last * fade[i], -limit, limit);
    heat.note(played);
    out[i] = static_cast<float>(played);
  }
  band_ = band;
  limiter_ = limiter;
  heat_ = heat;
  last_ = last;
  resets_ += resets;
  limited_ += limited;
}

bool OutputGuard::settle() noexcept {
  if (!band_.at_rest(kSettled) || !equaliser_.at_rest(kSettled) || limiter_.limiting() ||
      std::abs(last_) > kSettled || !heat_.at_rest(kSettled)) {
    return false;
  }
  forget();
  heat_.cool();
  last_ = 0.0;
  return true;
}

}  // namespace splash::synth
