// SPDX-License-Identifier: MIT
// What the detectors find in a frame, each as the event that it becomes once it is numbered.
#pragma once

#include <vector>

#include "protocol/event.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

[[nodiscard]] inline protocol::Vec3 as_place(const Vector3& place) noexcept {
  return {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
}

struct DetectedImpact {
  double time = 0.0;  ///< when the surfaces meet: past, or up to the look-ahead in the future [s]
  int body = 0;
  double speed = 0.0;     ///< of the touching point [m/s]
  double approach = 0.0;  ///< at which the surfaces close, along the water's normal [m/s]
  double momentum = 0.0;  ///< given to the water until the blow is strongest [N s]
  double rise = 0.0;      ///< from the first touch until then [s]
  double area = 0.0;      ///< of the skin that is wet then, projected onto the surface [m2]
  Vector3 position = {0.0, 0.0, 0.0};  ///< [m]

  /// Found ahead of its time, at which it sounds; what is found afterwards sounds a latency later.
  static constexpr bool kIsForeseen = true;
  [[nodiscard]] protocol::Impact event() const noexcept {
    return {.body = body,
            .speed = static_cast<float>(speed),
            .approach = static_cast<float>(approach),
            .position = as_place(position),
            .momentum = static_cast<float>(momentum),
            .rise = static_cast<float>(rise)};
  }
};

struct DetectedBubble {
  double time = 0.0;    ///< [s]
  int particle = 0;     ///< id of the fluid particle that entrapped it
  double radius = 0.0;  ///< [m]
  double epsilon = 0.0;
  Vector3 position = {0.0, 0.0, 0.0};  ///< [m]

  static constexpr bool kIsForeseen = false;
  [[nodiscard]] protocol::Bubble event() const noexcept {
    return {.radius = static_cast<float>(radius),
            .epsilon = static_cast<float>(epsilon),
            .position = as_place(position)};
  }
};

struct DetectedCavity {
  double time = 0.0;                   ///< [s]
  int body = -1;                       ///< behind which it closed, -1: not known
  int bubbles = 0;                     ///< N_b, by the paper's rule
  double radius = 0.0;                 ///< [m]
  double epsilon = 0.1;                ///< initial excitation; the paper's, section 5.3.1 [1]
  double life = 0.0;                   ///< until it surfaces or breaks, 0: not known [s]
  Vector3 position = {0.0, 0.0, 0.0};  ///< its centre [m]

  static constexpr bool kIsForeseen = false;
  [[nodiscard]] protocol::Cavity event() const noexcept {
    return {.body = body,
            .radius = static_cast<float>(radius),
            .epsilon = static_cast<float>(epsilon),
            .position = as_place(position),
            .life = static_cast<float>(life)};
  }
};

struct Detections {
  std::vector<DetectedImpact> impacts;
  std::vector<DetectedBubble> bubbles;
  std::vector<DetectedCavity> cavities;

  /// Calls `visit` with what was found of each kind.
  template <class Visit>
  void each(Visit&& visit) const {
    static_assert(protocol::kEventKinds == 3);
    visit(impacts);
    visit(bubbles);
    visit(cavities);
  }
};

}  // namespace splash::sim
