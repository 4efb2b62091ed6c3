// SPDX-License-Identifier: MIT
// Everything that a person may change while it plays, by name: each row of the sound ("impact/q"),
// mute and solo of its components ("bubble/mute"), and the levels of the rig, with its own names
// ("rig/floor/gain_db", "rig/floor/tile/07/trim_db"). Ranges are those of the rows.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "synth-server/output/rig.hpp"
#include "synth-server/render/control_box.hpp"

namespace splash::synth {

/// A number that may be changed.
struct Knob {
  std::string name;
  double min = 0.0;
  double max = 1.0;
  bool logarithmic = false;  ///< moves evenly in its logarithm
  std::string unit = "1";
  std::string meaning = {};
};

/// From any thread but the audio callback's.
class Desk {
 public:
  /// From one value to another, where no other time is told [s].
  static constexpr double kSeconds = 0.020;

  Desk(const Rig& rig, const Sound& sound);

  /// What the engine reads.
  [[nodiscard]] ControlBox& box() noexcept { return box_; }
  [[nodiscard]] const std::vector<Knob>& knobs() const noexcept { return knobs_; }

  /// Why not, or empty.
  [[nodiscard]] std::string set(const std::string& name, double value);
  [[nodiscard]] std::optional<double> get(const std::string& name) const;
  /// Goes over to another sound; levels of the rig, mute and solo stay.
  void play(const Sound& sound, double seconds);

  struct Change {
    std::string name;
    double value = 0.0;
  };
  /// At most so many of the numbers that have changed since they were last taken.
  [[nodiscard]] std::vector<Change> take_changes(std::size_t most);

  /// Sends all once more, to an engine that begins anew with what the rig and its sound say.
  void repeat();

 private:
  [[nodiscard]] const Knob* find(const std::string& name) const;
  void aim(std::size_t index, double value, double seconds);

  std::vector<Knob> knobs_;
  mutable std::mutex mutex_;  ///< guards all below
  ControlTargets targets_;
  std::vector<char> changed_;
  ControlBox box_;
};

}  // namespace splash::synth
