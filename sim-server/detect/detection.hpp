// SPDX-License-Identifier: MIT
// What the detectors find in a frame, before it is numbered and sent.
#pragma once

#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct DetectedImpact {
  double time = 0.0;  ///< when the surfaces meet: past, or up to the look-ahead in the future [s]
  int body = 0;
  double speed = 0.0;     ///< of the touching point [m/s]
  double approach = 0.0;  ///< at which the surfaces close, along the water's normal [m/s]
  double momentum = 0.0;  ///< given to the water until the blow is strongest [N s]
  double rise = 0.0;      ///< from the first touch until then [s]
  double area = 0.0;      ///< of the skin that is wet then, projected onto the surface [m2]
  Vector3 position = {0.0, 0.0, 0.0};  ///< [m]
};

struct DetectedBubble {
  double time = 0.0;    ///< [s]
  int particle = 0;     ///< id of the fluid particle that entrapped it
  double radius = 0.0;  ///< [m]
  double epsilon = 0.0;
  Vector3 position = {0.0, 0.0, 0.0};  ///< [m]
};

struct DetectedCavity {
  double time = 0.0;                   ///< [s]
  int body = -1;                       ///< behind which it closed, -1: not known
  int bubbles = 0;                     ///< N_b, by the paper's rule
  double radius = 0.0;                 ///< [m]
  double epsilon = 0.1;                ///< initial excitation; the paper's, section 5.3.1 [1]
  double life = 0.0;                   ///< until it surfaces or breaks, 0: not known [s]
  Vector3 position = {0.0, 0.0, 0.0};  ///< its centre [m]
};

struct Detections {
  std::vector<DetectedImpact> impacts;
  std::vector<DetectedBubble> bubbles;
  std::vector<DetectedCavity> cavities;
};

}  // namespace splash::sim
