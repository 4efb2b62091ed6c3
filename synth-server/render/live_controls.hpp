// SPDX-License-Identifier: MIT
// The sound and the rig's levels as they are in each cell: numbers move to where they were sent in
// even steps from cell to cell, gains and ceilings evenly within each cell, too, so that nothing
// clicks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "synth-server/output/rig.hpp"
#include "synth-server/render/control_box.hpp"
#include "synth-server/render/mix.hpp"

namespace splash::synth {

class LiveControls {
 public:
  /// `box` may be null: nothing ever changes. `sample_rate` [Hz].
  LiveControls(const Rig& rig, const Sound& sound, double sample_rate, ControlBox* box);

  /// At the beginning of each cell.
  void begin_cell() noexcept;

  [[nodiscard]] const Sound& sound() const noexcept { return sound_; }
  /// Over this cell: of a kind of events, in the order of protocol::Event.
  [[nodiscard]] const CellGain& component(std::size_t component) const noexcept {
    return components_[component];
  }
  /// Of a channel, over what the rig says.
  [[nodiscard]] const CellGain& channel(std::size_t channel) const noexcept {
    return channels_[channel];
  }
  /// Of a channel's output [full scale]; not above the rig's.
  [[nodiscard]] const CellGain& ceiling(std::size_t channel) const noexcept {
    return ceilings_[output_of_[channel]];
  }
  /// Whether that is the rig's.
  [[nodiscard]] bool has_rigs_ceiling(std::size_t channel) const noexcept;
  /// Gain of an output over what the rig says, whether muted or not [1].
  [[nodiscard]] double output_gain(std::size_t output) const noexcept;

 private:
  void aim(const ControlTargets& targets) noexcept;
  void move() noexcept;
  void show() noexcept;
  [[nodiscard]] double value(std::size_t i) const noexcept;
  /// The part that mute and solo let through; `loudest_solo`: of all its kind.
  [[nodiscard]] double heard(std::size_t mute, std::size_t solo,
                             double loudest_solo) const noexcept;

  /// A number on its way, in its logarithm where it moves so.
  struct Way {
    double now = 0.0;
    double step = 0.0;  ///< per cell
    double aim = 0.0;
    double target = 0.0;    ///< `aim` as it was sent
    std::int64_t left = 0;  ///< cells
  };

  double cells_per_second_;
  ControlBox* box_;
  ControlLayout layout_;
  std::vector<Way> ways_;
  std::vector<char> logarithmic_;
  std::vector<std::size_t> output_of_;  ///< by channel
  std::vector<double> rigs_;            ///< the rig's values, by number
  bool moving_ = false;                 ///< any number is on its way
  bool settling_ = false;               ///< gains of the last cell have to become steady
  Sound sound_;
  std::array<CellGain, ControlLayout::kComponents> components_;
  std::vector<CellGain> channels_;
  std::vector<CellGain> ceilings_;  ///< by output
};

/// A rig's own numbers and a sound's, as they are before anybody changes them.
[[nodiscard]] std::vector<double> control_values(const Rig& rig, const Sound& sound);

}  // namespace splash::synth
