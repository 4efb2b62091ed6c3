// SPDX-License-Identifier: MIT
// Reduces the work when the machine cannot keep up, in this order: gauges are read once a second
// only; then steps become longer, as far as is needed and stable; then simulated time runs slower
// than the clock, which is reported. Missed time is never made up for.
#pragma once

#include <array>
#include <string>

namespace splash::sim {

enum class Load {
  easy,    ///< all work is done
  lean,    ///< gauges are read once a second
  coarse,  ///< and steps are longer
  slow,    ///< and simulated time runs slower than the clock
};
inline constexpr std::size_t kLoads = 4;

struct OverloadSettings {
  bool has_gauges = false;       ///< without gauges the level `lean` would save nothing
  double largest_stretch = 1.0;  ///< by which steps may become longer (StepPolicy) [1]
  double over = 0.98;            ///< load above which the level rises [1]
  double under = 0.75;           ///< load below which the level falls [1]
  double rise = 0.5;             ///< shortest time between two rises [s]
  double fall = 2.0;             ///< time of low load before the level falls [s]
};

class Overload {
 public:
  explicit Overload(const OverloadSettings& settings) : settings_(settings) {}

  /// Takes note that `seconds` of simulated time cost `spent` seconds. Returns whether the level or
  /// the stretch has changed.
  bool note(double seconds, double spent);

  [[nodiscard]] Load level() const noexcept { return level_; }
  /// How many times as long as without load steps should be [1].
  [[nodiscard]] double stretch() const noexcept { return stretch_; }
  /// The cost of a simulated second, averaged over about the last second [s/s].
  [[nodiscard]] double load() const noexcept { return load_; }
  /// The time spent at a level so far [s].
  [[nodiscard]] double spent_at(Load level) const noexcept {
    return spent_[static_cast<std::size_t>(level)];
  }

 private:
  /// Whether a level has something to leave out.
  [[nodiscard]] bool helps(Load level) const noexcept;
  /// The next such level above (1) or below (-1) this one, which is not the last one there.
  [[nodiscard]] Load next(int step) const noexcept;
  void rise();
  void fall();
  /// Makes steps `factor` times as long as without load, as far as they may be [1].
  void stretch(double factor);

  OverloadSettings settings_;
  Load level_ = Load::easy;
  double stretch_ = 1.0;
  double cost_ = 0.0;  ///< decaying sum of the costs [s]
  double time_ = 1.0;  ///< of the simulated times; a run begins as after an idle second [s]
  double load_ = 0.0;
  double since_ = 0.0;   ///< the last change of level, or high load [s]
  double wait_ = 1.0;    ///< times `fall`; doubled when a step down was too early
  double fell_ = 1.0e9;  ///< since the last step down [s]
  std::array<double, kLoads> spent_ = {};
};

/// Returns a sentence on the level that has just been reached. `scene_may_ask_for_more`: as
/// StepPolicy has it, of longer steps.
[[nodiscard]] std::string describe(const Overload& overload, bool scene_may_ask_for_more);

}  // namespace splash::sim
