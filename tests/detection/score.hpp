// SPDX-License-Identifier: MIT
// What was told, held against what was true: each entry once, at its moment and with its speed; no
// impact besides; cavities after an entry and below the level.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim-server/detect/detection.hpp"
#include "tests/detection/truth.hpp"

namespace splash::detection {

/// How many there may be.
struct Count {
  int least = 0;
  int most = 0;
};

/// What a run is judged by, besides its entries.
struct Wishes {
  double level = 0.0;             ///< of the water at rest [m]
  double added_mass = 0.0;        ///< of the face that goes in [kg]; 0: P is not judged
  std::optional<Count> cavities;  ///< in all; nothing: any number, each after an entry
  std::optional<Count> waves;     ///< impacts of bodies that stand still; nothing: they are false
  double sinks_after = 0.0;       ///< from the entry until its front's middle is under [s]
  double closes_after = 0.0;      ///< from then to the cavity [s]; 0: any time
  double least_air = 0.0;         ///< in the cavity [m3]
  double most_air = 0.0;          ///< same; 0: it is not judged
  double body = 0.0;              ///< of which the air would fill with a thin one's ... [m3]
  double hollow = 0.0;            ///< ... so much [m3]
};

/// Everything that a run told, and what its bodies did.
struct Heard {
  sim::Detections found;
  std::vector<double> momenta;  ///< of the impacts [N s]; empty: not told
  std::vector<Path> paths;      ///< of each body
};

struct Score {
  int wanted = 0;
  int hit = 0;      ///< wanted entries that were told
  int allowed = 0;  ///< told, of those that may be
  int waves = 0;
  int untrue = 0;  ///< told for nothing, or a second time
  std::vector<double> late_ms;
  std::vector<double> speed_error;  ///< of the approach [1]
  std::vector<double> momentum;     ///< P / (m_a u) [1]
  std::vector<double> closing;      ///< time of the first cavity by the wanted one [1]
  std::vector<double> air;          ///< its volume and the body's, by the hollow's [1]
  std::vector<double> depth;        ///< of its centre by half of the body's [1]
  int cavities = 0;                 ///< below the level within 0.5 s after an entry
  int stray = 0;                    ///< the other ones
  int stray_above = 0;              ///< of these, above the level
  int bubbles = 0;
  std::vector<std::string> faults;  ///< a sentence each
};

/// How far from an entry its impact may be told: waves of an earlier one move the surface [s].
[[nodiscard]] double window_of(const Entry& entry);

[[nodiscard]] Score score(const std::vector<Entry>& entries, const Heard& heard,
                          const Wishes& wishes);

/// Adds the figures of one run to those of others.
void add(Score& sum, const Score& one);

}  // namespace splash::detection
