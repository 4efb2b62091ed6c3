// SPDX-License-Identifier: MIT
#include "synth-server/render/audibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

struct Point {
  double frequency = 0.0;     ///< [Hz]
  double threshold_db = 0.0;  ///< displacement [dB re 1 um peak]
};
constexpr std::array kTouch = {Point{1, 29},    Point{4, 23},    Point{10, 15},   Point{20, 11},
                               Point{40, 3},    Point{80, -9},   Point{150, -17}, Point{200, -19.5},
                               Point{250, -20}, Point{300, -20}, Point{400, -15}, Point{500, -9}};
constexpr double kTouchReference = 250.0;     // [Hz]
constexpr double kHearingReference = 1000.0;  // [Hz]

double displacement_threshold_db(double frequency) noexcept {
  std::size_t next = 1;
  while (next + 1 < kTouch.size() && kTouch[next].frequency < frequency) ++next;
  const Point& a = kTouch[next - 1];
  const Point& b = kTouch[next];
  const double part = std::log(frequency / a.frequency) / std::log(b.frequency / a.frequency);
  return a.threshold_db + (b.threshold_db - a.threshold_db) * std::clamp(part, 0.0, 1.0);
}

double acceleration_threshold_db(double frequency) noexcept {
  const double within = std::clamp(frequency, kTouch.front().frequency, kTouch.back().frequency);
  return displacement_threshold_db(within) + 40.0 * std::log10(within);
}

double quiet_threshold_db(double frequency) noexcept {
  const double khz = frequency / 1000.0;
  const double off = khz - 3.3;
  return 3.64 * std::pow(khz, -0.8) - 6.5 * std::exp(-0.6 * off * off) +
         1e-3 * khz * khz * khz * khz;
}

/// A voice's pitch at -120 dB, in parts of that at its start: 1 + 0.2 ln 10^6 with the literal
/// chirp.
constexpr double kRiseAtMost = 3.77 * 1.06;  // and a twelfth of an octave, to the next entry
constexpr int kSteps = 64;                   // on the way there

}  // namespace

double touch_threshold_db(double frequency) noexcept {
  return acceleration_threshold_db(frequency) - acceleration_threshold_db(kTouchReference);
}

double hearing_threshold_db(double frequency) noexcept {
  return quiet_threshold_db(frequency) - quiet_threshold_db(kHearingReference);
}

double cut_db(const Band& band, double frequency) noexcept {
  return 10.0 * std::log10(1.0 + std::pow(band.low / frequency, 8.0)) +
         10.0 * std::log10(1.0 + std::pow(frequency / band.high, 8.0));
}

Audibility::Audibility(const Output& output, bool by_threshold) {
  const double least_db = -kFloorDecibels;
  floors_.fill(std::pow(10.0, least_db / 20.0));
  if (by_threshold && output.threshold.sense != Sense::none) {
    const auto curve =
        output.threshold.sense == Sense::touch ? touch_threshold_db : hearing_threshold_db;
    for (std::size_t i = 0; i < floors_.size(); ++i) {
      const double from = kLowest * std::exp2(static_cast<double>(i) / kPerOctave);
      double lowest_db = 0.0;
      for (int step = 0; step <= kSteps; ++step) {
        const double f = from * std::pow(kRiseAtMost, step / static_cast<double>(kSteps));
        const double felt_db = output.threshold.level_db + curve(f) + cut_db(output.band, f);
        lowest_db = std::min(lowest_db, felt_db - kMarginDecibels);
      }
      floors_[i] = std::pow(10.0, std::max(lowest_db, least_db) / 20.0);
    }
  }
  least_ = *std::min_element(floors_.begin(), floors_.end());
}

double Audibility::floor(double frequency) const noexcept {
  if (!(frequency >= kLowest)) return least_;
  const auto index = static_cast<std::size_t>(std::log2(frequency / kLowest) * kPerOctave);
  return index < floors_.size() ? floors_[index] : least_;
}

}  // namespace splash::synth
