// SPDX-License-Identifier: MIT
// The divergence-free solver once more, in double precision: pairs found all against all, then the
// same number of iterations that the device took.
#pragma once

#include <vector>

#include "tests/sim-server/fluid/reference.hpp"

namespace splash::sim {

/// What stays the same for all iterations of a step
/// (pressure/divergence_free/pressure_response.cl).
struct ReferenceResponse {
  std::vector<Vector3> gradient;      ///< G [kg/m4]
  std::vector<double> response;       ///< D
  std::vector<double> boundary_rate;  ///< [kg/m3 s]
};
[[nodiscard]] ReferenceResponse reference_response(const FluidState& state, double piston_speed);

struct ReferenceSolve {
  std::vector<Vector3> velocity;  ///< [m/s]
  std::vector<double> pressure;   ///< p / rho^2
  double error_before = 0.0;      ///< mean density error that made the last iteration necessary [1]
  double error = 0.0;             ///< that ended the solve [1]
};
/// `offset` as in pressure/divergence_free/pressure_correction.cl [kg/m3].
[[nodiscard]] ReferenceSolve reference_solve(const FluidState& state,
                                             const ReferenceResponse& response,
                                             const std::vector<double>& offset, double dt,
                                             int iterations, ReferenceSolve from);

}  // namespace splash::sim
