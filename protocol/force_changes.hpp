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

  static constexpr double kGap = 0.1;       ///< a body that is told again so late begins anew [s]
  static constexpr double kLeast = 1e-4;    ///< forces are told further apart [s]
  static constexpr float kMostRate = 1e6F;  ///< no body bears more; what is over it is cut [N/s]

 private:
  struct Told {
    std::int32_t session = -1;  ///< of the sender; -1: never
    double time = 0.0;          ///< [s]
    std::array<double, 3> force{};
  };
  std::array<Told, 256> last_;
};

}  // namespace splash::protocol
