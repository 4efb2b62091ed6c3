// SPDX-License-Identifier: MIT
#include "sim-server/serve/overload.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace splash::sim {
namespace {

constexpr double kMemory = 1.0;        ///< of the mean load: one slow frame is no load [s]
constexpr double kLongestWait = 16.0;  ///< times the usual wait

}  // namespace

Load Overload::above() const noexcept {
  switch (level_) {
    case Load::easy:
      return settings_.has_gauges ? Load::lean : Load::coarse;
    case Load::lean:
      return Load::coarse;
    case Load::coarse:
    case Load::slow:
      break;
  }
  return Load::slow;
}

Load Overload::below() const noexcept {
  switch (level_) {
    case Load::slow:
      return Load::coarse;
    case Load::coarse:
      return settings_.has_gauges ? Load::lean : Load::easy;
    case Load::lean:
    case Load::easy:
      break;
  }
  return Load::easy;
}

bool Overload::note(double seconds, double spent) {
  if (!(seconds > 0.0) || !std::isfinite(spent)) return false;
  const double passed = std::max(seconds, spent);
  const double kept = std::exp(-passed / kMemory);
  cost_ = kept * cost_ + spent;
  time_ = kept * time_ + seconds;
  load_ = cost_ / time_;
  spent_[static_cast<std::size_t>(level_)] += passed;
  since_ += passed;
  fell_ += passed;
  if (load_ > settings_.over) {
    if (level_ == Load::slow || since_ < settings_.rise) {
      if (level_ == Load::slow) since_ = 0.0;
      return false;
    }
    if (fell_ < 2.0 * settings_.fall) wait_ = std::min(2.0 * wait_, kLongestWait);
    level_ = above();
    since_ = 0.0;
    return true;
  }
  if (load_ > settings_.under) since_ = std::min(since_, settings_.rise);
  if (level_ == Load::easy || since_ < wait_ * settings_.fall) return false;
  level_ = below();
  since_ = 0.0;
  fell_ = 0.0;
  return true;
}

std::string describe(const Overload& overload, double overload_factor) {
  std::array<char, 256> text = {};
  const double load = overload.load();
  switch (overload.level()) {
    case Load::easy:
      return "the machine keeps up again: nothing is left out";
    case Load::lean:
      std::snprintf(text.data(), text.size(),
                    "a simulated second takes %.2f s: gauges are read once a second", load);
      break;
    case Load::coarse:
      std::snprintf(text.data(), text.size(),
                    "a simulated second takes %.2f s: steps are %.2f times as long, which is "
                    "stable",
                    load, overload_factor);
      break;
    case Load::slow:
      // Where steps may get longer still, the scene can ask for it.
      std::snprintf(text.data(), text.size(),
                    "a simulated second takes %.2f s: simulated time runs slower than the clock "
                    "(fewer fluid.particles%s or a faster --device would help)",
                    load, overload_factor > 1.0 ? ", fluid.time_step_factor: 2" : "");
      break;
  }
  return text.data();
}

}  // namespace splash::sim
