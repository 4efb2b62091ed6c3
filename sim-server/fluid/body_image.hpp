// SPDX-License-Identifier: MIT
// What a body's share of a particle's kernel does to it, on the host; kernels/body_image.h has the
// reasons.
#pragma once

#include <algorithm>
#include <cmath>

namespace splash::sim {

/// f(S): weight of the mirror image behind a face whose points have the share S [1]. `contact`: the
/// share at half a spacing, or 0 where bodies have no image: f(S) = S.
inline double image_of(double share, double contact) {
  if (contact <= 0.0) return share;
  return share < contact ? share * share / contact : 2.0 * share - contact;
}

/// df / dS, from f [1].
inline double image_rise(double image, double contact) {
  if (contact <= 0.0) return 1.0;
  return 2.0 * std::sqrt(std::clamp(image / contact, 0.0, 1.0));
}

}  // namespace splash::sim
