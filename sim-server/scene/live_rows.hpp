// SPDX-License-Identifier: MIT
// The rows of a scene that may change while it runs: "detect/bubble_speed". Names, ranges, units
// and meanings are those of the scene's table.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

/// A row and what it is set to; switches are 0 or 1.
struct LiveRow {
  std::string name;
  const program::Row* row = nullptr;
  bool is_switch = false;
  double value = 0.0;
};

/// From any thread.
class LiveRows {
 public:
  explicit LiveRows(const DetectSettings& detect) : wanted_(detect), held_(detect) {}

  /// Why not, or empty.
  [[nodiscard]] std::string set(const std::string& name, double value);
  [[nodiscard]] std::optional<double> get(const std::string& name) const;
  [[nodiscard]] std::vector<LiveRow> rows() const;

  /// What has been set since this was last asked.
  struct Change {
    DetectSettings detect;
    std::vector<LiveRow> rows;  ///< those that differ
  };
  [[nodiscard]] std::optional<Change> take();

 private:
  mutable std::mutex mutex_;
  DetectSettings wanted_;  ///< under mutex_
  DetectSettings held_;    ///< what was taken last; under mutex_
  bool changed_ = false;   ///< since then; under mutex_
};

}  // namespace splash::sim
