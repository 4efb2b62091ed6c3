// SPDX-License-Identifier: MIT
// Least squares through the quarter of the samples with the shortest round trips.
#include "protocol/clock_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace splash::protocol {
namespace {

constexpr std::size_t kLeastSamples = 4;
constexpr double kDriftSpan = 10.0;     // shorter spans say more about jitter than drift [s]
constexpr double kLargestDrift = 5e-4;  // crystals stay within 1e-4; adjtime slews 5e-4 [s/s]
constexpr double kSlack = 1e-3;         // for rounding and asymmetry of the fit itself [s]

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

// A sample bounds the true offset to within half its round trip, and so did the shortest one.
bool ClockEstimate::contradicts(const Sample& sample) const noexcept {
  const double age = std::abs(sample.time - samples_.back().time);
  const double bound = 0.5 * (sample.round_trip + shortest_) + kLargestDrift * age + kSlack;
  return std::abs(sample.offset - offset_at(sample.time)) > bound;
}

void ClockEstimate::fit() {
  std::vector<Sample> best = samples_;
  const auto shorter = [](const Sample& a, const Sample& b) { return a.round_trip < b.round_trip; };
  std::stable_sort(best.begin(), best.end(), shorter);
  shortest_ = best.front().round_trip;
  best.resize(std::min(best.size(), std::max(kLeastSamples, best.size() / 4)));

  const auto earlier = [](const Sample& a, const Sample& b) { return a.time < b.time; };
  const auto [first, last] = std::minmax_element(best.begin(), best.end(), earlier);
  const double span = last->time - first->time;
  const auto count = static_cast<double>(best.size());
  double time = 0.0;
  double offset = 0.0;
  for (const auto& sample : best) {
    time += (sample.time - first->time) / count;  // differences: Unix times are large
    offset += (sample.offset - first->offset) / count;
  }
  centre_ = first->time + time;
  offset_ = first->offset + offset;

  double across = 0.0;
  double along = 0.0;
  for (const auto& sample : best) {
    across += (sample.time - centre_) * (sample.offset - offset_);
    along += (sample.time - centre_) * (sample.time - centre_);
  }
  drift_ = span < kDriftSpan ? 0.0 : std::clamp(across / along, -kLargestDrift, kLargestDrift);
}

double ClockEstimate::offset_at(double local_time) const noexcept {
  return offset_ + drift_ * (local_time - centre_);
}

}  // namespace splash::protocol
