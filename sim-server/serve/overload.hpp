// SPDX-License-Identifier: MIT
// What gives way when the machine cannot keep up, in this order: first what is only written (gauges
// are read once a second), then the shortness of steps, within what is stable, then time itself:
// simulated time runs slower than the clock, and that is said. A step is never longer than is
// stable, and what was missed is never made up for.
#pragma once

#include <array>
#include <string>

namespace splash::sim {

enum class Load {
  easy,    ///< nothing is left out
  lean,    ///< gauges once a second
  coarse,  ///< and steps as long as is stable
  slow,    ///< and simulated time behind the clock
};
inline constexpr std::size_t kLoads = 4;

struct OverloadSettings {
  bool has_gauges = false;  ///< or `lean` would save nothing
  double over = 0.98;       ///< load above which more gives way [1]
  double under = 0.75;      ///< and below which it comes back [1]
  double rise = 0.5;        ///< between two steps up [s]
  double fall = 2.0;        ///< of low load before a step down [s]
};

class Overload {
 public:
  explicit Overload(const OverloadSettings& settings) : settings_(settings) {}

  /// `seconds` of simulated time cost `spent` seconds. True when the level is another one now.
  bool note(double seconds, double spent);

  [[nodiscard]] Load level() const noexcept { return level_; }
  /// Cost of a simulated second, over the last second or so [s/s].
  [[nodiscard]] double load() const noexcept { return load_; }
  /// Time spent at each level so far [s].
  [[nodiscard]] double spent_at(Load level) const noexcept {
    return spent_[static_cast<std::size_t>(level)];
  }

 private:
  [[nodiscard]] Load above() const noexcept;
  [[nodiscard]] Load below() const noexcept;

  OverloadSettings settings_;
  Load level_ = Load::easy;
  double cost_ = 0.0;  ///< of late [s]
  double time_ = 1.0;  ///< simulated for it; a run begins as after an idle second [s]
  double load_ = 0.0;
  double since_ = 0.0;   ///< the last change of level, or high load [s]
  double wait_ = 1.0;    ///< times `fall`; doubled when a step down was too early
  double fell_ = 1.0e9;  ///< since the last step down [s]
  std::array<double, kLoads> spent_ = {};
};

/// A sentence on the level that has just been reached. `overload_factor`: StepPolicy's [1].
[[nodiscard]] std::string describe(const Overload& overload, double overload_factor);

}  // namespace splash::sim
