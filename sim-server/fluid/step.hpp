// SPDX-License-Identifier: MIT
// One step of a frame.
#pragma once

namespace splash::sim {

struct Step {
  double dt = 0.0;            ///< [s]
  double piston = 0.0;        ///< offset of the wave maker [m]
  double piston_speed = 0.0;  ///< [m/s]
  int first_body = 0;         ///< where this step's bodies begin among those of the frame
  bool opens_frame = false;   ///< first of a frame: what wakes and what sleeps is looked at anew
};

}  // namespace splash::sim
