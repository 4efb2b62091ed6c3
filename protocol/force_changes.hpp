// SPDX-License-Identifier: MIT
// Computes from the simulator's /force messages how fast the forces on bodies change.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/message.hpp"

namespace splash::protocol {

/// Returns whether a bundle carries forces. Such bundles are numbered separately from events.
[[nodiscard]] bool tells_forces(const std::vector<Message>& messages) noexcept;

class ForceChanges {
 public:
  /// The changes that a bundle reports; none if a message of it breaks the address table. `time`:
  /// the bundle's [s]; only differences count. A body's first force, one after a gap and one that
  /// comes twice report none.
  [[nodiscard]] std::vector<Push> take(const std::vector<Message>& messages, double time);

  static constexpr double kGap =
      0.1;  ///< after a longer gap a body's force counts as its first [s]
  static constexpr double kLeast = 1e-4;  ///< two forces on a body less far apart count as one [s]
  static constexpr float kMostRate = 1e6F;  ///< faster changes are reported as this [N/s]

 private:
  struct Last {
    std::int32_t session = -1;  ///< of the sender; -1: never
    double time = 0.0;          ///< [s]
    std::array<double, 3> force{};
  };
  std::array<Last, 256> last_;  ///< by index of the body
};

}  // namespace splash::protocol
