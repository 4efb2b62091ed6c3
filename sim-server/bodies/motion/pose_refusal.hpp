// SPDX-License-Identifier: MIT
// Why a pose of a tracker was not taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace splash::sim {

enum class PoseRefusal : std::uint8_t {
  none,
  malformed,      ///< other types, or a number out of its range
  not_finite,     ///< a number is NaN or infinite
  no_rotation,    ///< the quaternion's length is no unit
  too_far,        ///< a place beyond the limit
  too_fast,       ///< a speed or spin beyond the limit since the pose before
  outlier,        ///< off the body's own motion, and not for long
  time_ran_back,  ///< arrived before the pose before
  too_old,        ///< taken long before the newest one
  no_body,        ///< for a body that the scene has not
  not_tracked,    ///< for a body whose motion is of another kind
  other_sender,   ///< for a body that another sender moves
  count_          ///< number of reasons
};
inline constexpr std::size_t kPoseRefusals = static_cast<std::size_t>(PoseRefusal::count_);

/// In words.
[[nodiscard]] std::string_view describe(PoseRefusal refusal) noexcept;
/// The report's key.
[[nodiscard]] std::string_view key_of(PoseRefusal refusal) noexcept;

}  // namespace splash::sim
