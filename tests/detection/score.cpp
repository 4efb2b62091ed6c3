// SPDX-License-Identifier: MIT
#include "tests/detection/score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "program/text.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/support/detections.hpp"

namespace splash::detection {
namespace {

constexpr double kWindow = 0.03;         ///< [s]
constexpr double kWaveHeight = 0.01;     ///< [m]
constexpr double kWidestWindow = 0.15;   ///< [s]
constexpr double kCavityWindow = 0.5;    ///< after an entry [s]
constexpr double kClosing = 0.15;        ///< of its time [1]
constexpr double kShallow = 0.8;         ///< of half the body's depth [1]
constexpr double kDeep = 2.2;            ///< same [1]
constexpr double kStandsStill = 0.001;   ///< a slower body does [m/s]
constexpr double kSmallestSpeed = 0.01;  ///< [m/s]

/// An entry and an impact that may be one.
struct Pair {
  std::size_t entry = 0;
  std::size_t impact = 0;
  double apart = 0.0;  ///< [s]
};

class Judge {
 public:
  Judge(const std::vector<Entry>& entries, const Heard& heard, const Wishes& wishes)
      : entries_(entries),
        heard_(heard),
        wishes_(wishes),
        told_(entries.size()),
        used_(heard.found.impacts.size()) {}

  Score judge() {
    result_.bubbles = static_cast<int>(heard_.found.bubbles.size());
    match(true);
    match(false);
    look_at_entries();
    look_at_the_rest();
    look_at_cavities();
    return std::move(result_);
  }

 private:
  /// The nearest pairs first, each entry and each impact once.
  void match(bool wanted) {
    std::vector<Pair> pairs;
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      if (entries_[e].wanted != wanted) continue;
      for (std::size_t k = 0; k < used_.size(); ++k) {
        const sim::DetectedImpact& impact = heard_.found.impacts[k];
        if (static_cast<std::size_t>(impact.body) != entries_[e].body) continue;
        const double apart =
            std::max({entries_[e].time - impact.time, impact.time - entries_[e].until, 0.0});
        if (apart <= window_of(entries_[e])) pairs.push_back({e, k, apart});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.apart < b.apart; });
    for (const Pair& pair : pairs) {
      if (told_[pair.entry] || used_[pair.impact]) continue;
      told_[pair.entry] = used_[pair.impact] = true;
      if (wanted) {
        measure(entries_[pair.entry], pair.impact);
      } else {
        ++result_.allowed;
      }
    }
  }

  void measure(const Entry& entry, std::size_t k) {
    const sim::DetectedImpact& impact = heard_.found.impacts[k];
    ++result_.hit;
    result_.late_ms.push_back(1.0e3 * (impact.time - entry.time));
    if (std::isnan(entry.down)) return;
    const double down = std::max(entry.down, kSmallestSpeed);
    result_.speed_error.push_back(impact.approach / down - 1.0);
    if (wishes_.added_mass > 0.0 && k < heard_.momenta.size()) {
      result_.momentum.push_back(heard_.momenta[k] / (wishes_.added_mass * down));
    }
  }

  void look_at_entries() {
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      if (!entries_[e].wanted) continue;
      ++result_.wanted;
      if (told_[e]) continue;
      result_.faults.push_back(program::format("missed: body %zu at %.3f s, %.2f m/s down",
                                               entries_[e].body, entries_[e].time,
                                               entries_[e].down));
    }
  }

  void look_at_the_rest() {
    for (std::size_t k = 0; k < used_.size(); ++k) {
      if (used_[k]) continue;
      const sim::DetectedImpact& impact = heard_.found.impacts[k];
      const sim::BodyState state =
          heard_.paths.at(static_cast<std::size_t>(impact.body))(impact.time);
      if (wishes_.waves && sim::length(state.velocity) < kStandsStill) {
        ++result_.waves;
        continue;
      }
      ++result_.untrue;
      result_.faults.push_back(program::format(
          "false: body %d at %.3f s, %.2f m/s, %.0f mm above the level, its middle moving at "
          "%+.2f m/s upwards",
          impact.body, impact.time, impact.approach, 1.0e3 * (impact.position[2] - wishes_.level),
          state.velocity[2]));
    }
    if (!wishes_.waves) return;
    if (result_.waves >= wishes_.waves->least && result_.waves <= wishes_.waves->most) return;
    result_.faults.push_back(program::format("%d impacts of waves, wanted %d to %d", result_.waves,
                                             wishes_.waves->least, wishes_.waves->most));
  }

  void look_at_cavities() {
    for (const sim::DetectedCavity& cavity : heard_.found.cavities) {
      const bool above = cavity.position[2] > wishes_.level;
      const bool follows = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        const double after = cavity.time - entry.time;
        return after >= 0.0 && after <= kCavityWindow;
      });
      if (follows && !above) {
        ++result_.cavities;
        continue;
      }
      ++result_.stray;
      if (above) ++result_.stray_above;
      result_.faults.push_back(
          program::format("stray cavity at %.3f s, r %.0f mm, %.0f mm above the level", cavity.time,
                          1.0e3 * cavity.radius, 1.0e3 * (cavity.position[2] - wishes_.level)));
    }
    look_at_closing();
    if (!wishes_.cavities) return;
    if (result_.cavities >= wishes_.cavities->least && result_.cavities <= wishes_.cavities->most) {
      return;
    }
    result_.faults.push_back(program::format("%d cavities after entries, wanted %d to %d",
                                             result_.cavities, wishes_.cavities->least,
                                             wishes_.cavities->most));
  }

  /// Of the first cavity: the hollow closes at half the body's depth (Bergmann et al. 2009), and
  /// the air is below that, down to the body.
  void look_at_closing() {
    if (wishes_.closes_after <= 0.0 || heard_.found.cavities.empty() || entries_.empty()) return;
    const sim::DetectedCavity& cavity = heard_.found.cavities.front();
    const Entry& entry = entries_.front();
    const double after = cavity.time - entry.time - wishes_.sinks_after;
    result_.closing.push_back(after / wishes_.closes_after);
    if (std::abs(result_.closing.back() - 1.0) > kClosing) {
      result_.faults.push_back(
          program::format("the cavity closes %.0f ms after the entry, expected %.0f", 1.0e3 * after,
                          1.0e3 * wishes_.closes_after));
    }
    if (wishes_.most_air <= 0.0) return;
    const double air = 4.0 / 3.0 * std::numbers::pi * std::pow(cavity.radius, 3);
    result_.air.push_back((air + wishes_.body) / wishes_.hollow);
    if (air > wishes_.most_air || air < wishes_.least_air) {
      result_.faults.push_back(
          program::format("%.2f litres of air in the cavity, expected %.2f to %.2f", 1.0e3 * air,
                          1.0e3 * wishes_.least_air, 1.0e3 * wishes_.most_air));
    }
    const double half = 0.5 * entry.down * after;
    const double depth = wishes_.level - cavity.position[2];
    result_.depth.push_back(depth / half);
    if (depth < kShallow * half || depth > kDeep * half) {
      result_.faults.push_back(
          program::format("the cavity lies %.0f mm deep, expected %.0f to %.0f", 1.0e3 * depth,
                          1.0e3 * kShallow * half, 1.0e3 * kDeep * half));
    }
  }

  const std::vector<Entry>& entries_;
  const Heard& heard_;
  const Wishes& wishes_;
  std::vector<bool> told_;  ///< of each entry
  std::vector<bool> used_;  ///< of each impact
  Score result_;
};

}  // namespace

double window_of(const Entry& entry) {
  if (std::isnan(entry.down)) return kWidestWindow;
  const double slow = kWaveHeight / std::max(entry.down, kSmallestSpeed);
  return std::min(kWindow + slow, kWidestWindow);
}

Score score(const std::vector<Entry>& entries, const Heard& heard, const Wishes& wishes) {
  return Judge(entries, heard, wishes).judge();
}

void add(Score& sum, const Score& one) {
  sum.wanted += one.wanted;
  sum.hit += one.hit;
  sum.allowed += one.allowed;
  sum.waves += one.waves;
  sum.untrue += one.untrue;
  sum.cavities += one.cavities;
  sum.stray += one.stray;
  sum.stray_above += one.stray_above;
  sum.bubbles += one.bubbles;
  tests::append(sum.late_ms, one.late_ms);
  tests::append(sum.speed_error, one.speed_error);
  tests::append(sum.momentum, one.momentum);
  tests::append(sum.closing, one.closing);
  tests::append(sum.air, one.air);
  tests::append(sum.depth, one.depth);
  tests::append(sum.faults, one.faults);
}

}  // namespace splash::detection
