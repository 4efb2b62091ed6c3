// SPDX-License-Identifier: MIT
#include "sim-server/serve/overload.hpp"

#include <algorithm>
#include <cmath>

#include "program/text.hpp"

namespace splash::sim {
namespace {

constexpr double kMemory = 1.0;        ///< of the mean load: one slow frame is no load [s]
constexpr double kLongestWait = 16.0;  ///< times the usual wait
constexpr double kAim = 0.85;  ///< load that longer steps aim at, between `under` and `over` [1]

}  // namespace

bool Overload::helps(Load level) const noexcept {
  if (level == Load::lean) return settings_.has_gauges;
  return level != Load::coarse || settings_.largest_stretch > 1.0;
}

Load Overload::next(int step) const noexcept {
  int level = static_cast<int>(level_);
  do {
    level += step;
  } while (!helps(static_cast<Load>(level)));  // the first and the last level always do
  return static_cast<Load>(level);
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
    rise();
    return true;
  }
  // A level down steps may be shorter.
  const double below = (level_ == Load::coarse ? stretch_ : 1.0) * load_;
  if (below > settings_.under) since_ = std::min(since_, settings_.rise);
  if (level_ == Load::easy || since_ < wait_ * settings_.fall) return false;
  fall();
  return true;
}

void Overload::rise() {
  since_ = 0.0;
  if (level_ != Load::coarse || stretch_ >= settings_.largest_stretch) {
    if (fell_ < 2.0 * settings_.fall) wait_ = std::min(2.0 * wait_, kLongestWait);
    level_ = next(1);
  }
  if (level_ == Load::coarse) stretch(stretch_ * load_ / kAim);
}

void Overload::fall() {
  since_ = 0.0;
  fell_ = 0.0;
  level_ = next(-1);
  if (level_ < Load::coarse) stretch(1.0);
}

void Overload::stretch(double factor) {
  const double wanted = std::clamp(factor, 1.0, settings_.largest_stretch);
  cost_ *= stretch_ / wanted;  // what is remembered as it would have been
  stretch_ = wanted;
}

std::string describe(const Overload& overload, bool scene_may_ask_for_more) {
  const double load = overload.load();
  switch (overload.level()) {
    case Load::easy:
      break;
    case Load::lean:
      return program::format("a simulated second takes %.2f s: gauges are read once a second",
                             load);
    case Load::coarse:
      return program::format(
          "a simulated second takes %.2f s: steps become %.2f times as long, which is stable", load,
          overload.stretch());
    case Load::slow:
      // Where steps may get longer still, the scene can ask for it.
      return program::format(
          "a simulated second takes %.2f s: simulated time runs slower than the clock "
          "(fewer fluid.particles%s or a faster --device would help)",
          load, scene_may_ask_for_more ? ", fluid.time_step_factor: 2" : "");
  }
  return "the machine keeps up again: nothing is left out";
}

}  // namespace splash::sim
