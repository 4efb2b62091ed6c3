// SPDX-License-Identifier: MIT
#include "synth-server/play/sample_clock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
/// The loop is told the earliest callback of so long a time [s], which holds this many at least.
constexpr double kSpan = 0.25;
constexpr int kLeastCallbacks = 8;
/// In the first seconds, of this part of the time since the start.
constexpr double kOpeningSpan = 0.2;
/// A block lasts until the next one is asked for; half of one is for late callbacks [blocks].
constexpr double kLatencyBlocks = 1.5;
constexpr double kLeastLatency = 0.005;  ///< [s]

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
  first_ = first;
  next_first_ = first + frames;
  elapsed_ = 0.0;
  outliers_ = 0;
  running_ = true;
  begin_span();
}

void SampleClock::begin_span() noexcept {
  earliest_ = std::numeric_limits<double>::infinity();
  span_ = 0;
}

/// Natural frequency of the loop times the `seconds` between two corrections [rad].
double SampleClock::omega(double seconds) const noexcept {
  const double bandwidth = std::max(kBandwidth, kOpening / std::max(elapsed_, seconds));
  return std::min(kLargestOmega, 2.0 * std::numbers::pi * bandwidth * seconds);
}

void SampleClock::update(double now, std::int64_t first, int frames) noexcept {
  if (running_ && first != next_first_) reset();
  if (!running_) return start(now, first, frames);

  time_ += static_cast<double>(first - first_) * seconds_per_sample_;
  span_ += first - first_;
  elapsed_ += static_cast<double>(first - first_) * nominal_;
  first_ = first;
  next_first_ = first + frames;
  const double error = now - time_;
  if (std::abs(error) > kLargestError) {
    if (++outliers_ >= kOutliersBeforeReset) {
      reset();
      return start(now, first, frames);
    }
    return;  // one late callback says nothing about the device's clock: coast through it
  }
  outliers_ = 0;
  earliest_ = std::min(earliest_, error);
  const double wanted = std::max(kSpan, kLeastCallbacks * frames * nominal_);
  if (static_cast<double>(span_) * nominal_ >= std::min(wanted, kOpeningSpan * elapsed_)) correct();
}

/// The loop itself, once in a span.
void SampleClock::correct() noexcept {
  const double w = omega(static_cast<double>(span_) * nominal_);
  seconds_per_sample_ =
      std::clamp(seconds_per_sample_ + w * w * earliest_ / static_cast<double>(span_),
                 nominal_ * (1.0 - kLargestDrift), nominal_ * (1.0 + kLargestDrift));
  time_ += std::numbers::sqrt2 * w * earliest_;
  begin_span();
}

double SampleClock::sample_at(double moment) const noexcept {
  return static_cast<double>(first_) + (moment - time_) / seconds_per_sample_;
}

double latency_for(double wanted, int block, double sample_rate) noexcept {
  const double block_seconds = block / sample_rate;
  if (wanted >= 0.0) return wanted;
  return std::max(kLeastLatency, kLatencyBlocks * block_seconds);
}

Placement place_at_once(double offset, std::int64_t block_start, double sample_rate,
                        const ScheduleSettings& settings) noexcept {
  const double ahead = std::clamp(offset, 0.0, settings.horizon);
  return {offset > settings.horizon ? Timing::early : Timing::on_time,
          block_start + std::llround(ahead * sample_rate)};
}

Placement place(double moment, double by_arrival, const SampleClock& clock,
                std::int64_t block_start, const ScheduleSettings& settings) noexcept {
  const double furthest = clock.block_time() + settings.horizon;
  Timing timing = Timing::on_time;
  if (moment > furthest) {
    timing = Timing::early;
    moment = std::min(by_arrival, furthest);  // the delay an event names may be as wrong
  }
  const double sample = clock.sample_at(moment + settings.latency);
  const double late = static_cast<double>(block_start) - sample;  // [samples]
  if (late > settings.late_window * clock.rate()) return {Timing::too_late, block_start};
  const std::int64_t rounded = std::llround(sample);
  if (rounded >= block_start) return {timing, rounded};
  return {timing == Timing::early ? timing : Timing::late, block_start};
}

}  // namespace splash::synth
