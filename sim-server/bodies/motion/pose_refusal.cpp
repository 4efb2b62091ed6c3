// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pose_refusal.hpp"

#include <array>

namespace splash::sim {

namespace {

struct Words {
  std::string_view key;
  std::string_view sentence;
};

constexpr std::array<Words, kPoseRefusals> kWords = {{
    {"accepted", "accepted"},
    {"malformed", "its types or numbers are not those of a pose"},
    {"not_finite", "a number is not finite"},
    {"no_rotation", "the quaternion's length is not 1 within 10 %"},
    {"too_far", "the place is beyond the limit"},
    {"too_fast", "the speed is beyond the limit"},
    {"outlier", "it is far off the body's own motion"},
    {"time_ran_back", "it arrived before the pose before it"},
    {"too_old", "it was taken long before the newest pose"},
    {"no_body", "the scene has no such body"},
    {"not_tracked", "the body is not moved over OSC (motion: {kind: osc})"},
    {"other_sender", "another sender, which began later, moves the body"},
}};

const Words& words_of(PoseRefusal refusal) noexcept {
  const auto index = static_cast<std::size_t>(refusal);
  return kWords[index < kPoseRefusals ? index : 0];
}

}  // namespace

std::string_view describe(PoseRefusal refusal) noexcept {
  return words_of(refusal).sentence;
}

std::string_view key_of(PoseRefusal refusal) noexcept {
  return words_of(refusal).key;
}

}  // namespace splash::sim
