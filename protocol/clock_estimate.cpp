// SPDX-License-Identifier: MIT
// Weighted least squares through the quarter of the samples with the shortest round trips.
#include "protocol/clock_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace splash::protocol {
namespace {

constexpr std::size_t kLeastSamples = 4;
constexpr double kDriftSpread = 3.0;  // closer together, samples say more of jitter than drift [s]
constexpr double kLeastError = 5e-5;  // of a sample: interrupts, time slices [s]
constexpr double kLargestDrift = 5e-4;  // crystals stay within 1e-4; adjtime slews 5e-4 [s/s]
constexpr double kSlack = 1e-3;         // for rounding of the stamps [s]

}  // namespace

ClockEstimate::ClockEstimate(std::size_t window) : window_(std::max(window, kLeastSamples)) {
  samples_.reserve(window_ + 1);
}

bool ClockEstimate::add(double t0, double t1, double t2, double t3) {
  const double round_trip = (t3 - t0) - (t2 - t1);
  const Sample sample{0.5 * (t0 + t3), 0.5 * ((t1 - t0) + (t2 - t3)), round_trip};
  if (!std::isfinite(sample.time) || !std::isfinite(sample.offset)) return false;
  if (!(round_trip >= 0.0) || t2 < t1) return false;

  if (!samples_.empty() && contradicts(sample)) {
    if (doubted_.empty()) {
      doubted_.push_back(sample);
      return false;
    }
    samples_ = doubted_;
    ++steps_;
  }
  doubted_.clear();
  samples_.push_back(sample);
  if (samples_.size() > window_) samples_.erase(samples_.begin());
  fit();
  return true;
}

// Each sample bounds the true offset to within half its round trip; two of them must agree.
bool ClockEstimate::contradicts(const Sample& sample) const noexcept {
  return std::any_of(samples_.begin(), samples_.end(), [&sample](const Sample& known) {
    const double bound = 0.5 * (sample.round_trip + known.round_trip) +
                         kLargestDrift * std::abs(sample.time - known.time) + kSlack;
    return std::abs(sample.offset - known.offset) > bound;
  });
}

void ClockEstimate::fit() {
  std::vector<Sample> best = samples_;
  const auto shorter = [](const Sample& a, const Sample& b) { return a.round_trip < b.round_trip; };
  std::stable_sort(best.begin(), best.end(), shorter);
  best.resize(std::min(best.size(), std::max(kLeastSamples, best.size() / 4)));
  const Sample origin = best.front();  // differences to it: Unix times are large
  shortest_ = origin.round_trip;

  // What a round trip has over the shortest may all lie on one way: half of it is the error.
  const auto weight = [&origin](const Sample& sample) {
    const double error = kLeastError + 0.5 * (sample.round_trip - origin.round_trip);
    return 1.0 / (error * error);
  };
  double weights = 0.0;
  double time = 0.0;
  double offset = 0.0;
  for (const auto& sample : best) {
    weights += weight(sample);
    time += weight(sample) * (sample.time - origin.time);
    offset += weight(sample) * (sample.offset - origin.offset);
  }
  centre_ = origin.time + time / weights;
  offset_ = origin.offset + offset / weights;

  double across = 0.0;
  double along = 0.0;
  for (const auto& sample : best) {
    const double away = sample.time - centre_;
    across += weight(sample) * away * (sample.offset - offset_);
    along += weight(sample) * away * away;
  }
  const double spread = std::sqrt(along / weights);
  drift_ = spread < kDriftSpread ? 0.0 : std::clamp(across / along, -kLargestDrift, kLargestDrift);
}

double ClockEstimate::offset_at(double local_time) const noexcept {
  return offset_ + drift_ * (local_time - centre_);
}

}  // namespace splash::protocol
