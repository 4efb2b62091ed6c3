// SPDX-License-Identifier: MIT
#include "synth-server/receive/sample_clock.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

/// Bandwidth of the settled loop [Hz]; supercollider's scsynth uses 0.012, JACK2 its own period's.
constexpr double kBandwidth = 0.1;
/// The bandwidth narrows as kOpening / elapsed, so that the first seconds converge fast [1].
constexpr double kOpening = 0.4;
/// Above this the discrete loop would ring [rad].
constexpr double kLargestOmega = 0.5;
/// Sound cards keep their rate within 100 ppm; what passes this is jitter, not drift [1].
constexpr double kLargestDrift = 500e-6;
/// A callback later or earlier than this is not jitter [s] ...
constexpr double kLargestError = 0.02;
/// ... and when so many follow each other, the samples themselves have moved.
constexpr int kOutliersBeforeReset = 3;

}  // namespace

SampleClock::SampleClock(double sample_rate) noexcept
    : nominal_(1.0 / sample_rate), seconds_per_sample_(nominal_) {}

void SampleClock::reset() noexcept {
  if (running_) ++resets_;
  running_ = false;
}

void SampleClock::start(double now, std::int64_t first, int frames) noexcept {
  seconds_per_sample_ = nominal_;
  time_ = now;
  next_time_ = now + frames * nominal_;
  first_ = first;
  next_first_ = first + frames;
  elapsed_ = 0.0;
  outliers_ = 0;
  running_ = true;
}

double SampleClock::omega(double block_seconds) const noexcept {
  const double bandwidth = std::max(kBandwidth, kOpening / std::max(elapsed_, block_seconds));
  return std::min(kLargestOmega, 2.0 * std::numbers::pi * bandwidth * block_seconds);
}

void SampleClock::update(double now, std::int64_t first, int frames) noexcept {
  if (running_ && first != next_first_) reset();
  if (!running_) return start(now, first, frames);

  double error = now - next_time_;
  if (std::abs(error) > kLargestError) {
    if (++outliers_ >= kOutliersBeforeReset) {
      reset();
      return start(now, first, frames);
    }
    error = 0.0;  // one late callback says nothing about the device's clock: coast through it
  } else {
    outliers_ = 0;
  }

  const double block_seconds = frames * nominal_;
  const double w = omega(block_seconds);
  time_ = next_time_;
  seconds_per_sample_ =
      std::clamp(seconds_per_sample_ + w * w * error / frames, nominal_ * (1.0 - kLargestDrift),
                 nominal_ * (1.0 + kLargestDrift));
  next_time_ += std::numbers::sqrt2 * w * error + frames * seconds_per_sample_;
  first_ = first;
  next_first_ = first + frames;
  elapsed_ += block_seconds;
}

double SampleClock::sample_at(double moment) const noexcept {
  return static_cast<double>(first_) + (moment - time_) / seconds_per_sample_;
}

}  // namespace splash::synth
