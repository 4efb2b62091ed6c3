// SPDX-License-Identifier: MIT
// The smoothing kernel on the host, in double precision, and what comes with it. The device's copy
// is params/smoothing.h; a test holds them together.
#pragma once

namespace splash::sim {

/// Support H over particle spacing [1].
constexpr double kSupportSpacings = 2.5;
/// Smoothing length h over support [1].
constexpr double kLengthOfSupport = 0.4;
/// The outermost particles of settled water lie this much deeper below its surface, which its
/// volume says, than half a spacing: they have nothing above them and pack more densely. Measured:
/// 0.18 to 0.28 in 0.1 to 0.25 m of water, 0.32 to 0.37 in 0.3 and 0.4 m [spacings].
constexpr double kSurfaceLoss = 0.22;
/// Largest time step, in H / (c0 + v): three layers of water on a floor stay calm up to 0.61 and
/// simmer from 0.63 on, deeper water from 0.81 [1].
constexpr double kAcousticCfl = 0.6;
/// Least density of a particle in a body of water: on the lattice a lone particle has 0.23, a film
/// of one layer 0.63, the top layer of a flat surface 0.81 [rho0].
constexpr double kLeastDensity = 0.72;
/// Density at which water has come apart: halfway from a full neighbourhood to the top layer of a
/// flat surface [rho0].
constexpr double kTornDensity = 0.9063;

// `support`: H [m].

/// sigma [1/m3]
[[nodiscard]] double kernel_norm(double support);
/// W(r) [1/m3]
[[nodiscard]] double kernel_value(double r, double support);
/// W again, of one support and from r^2 [m2]: for sums over many pairs.
class SmoothingKernel {
 public:
  explicit SmoothingKernel(double support)
      : norm_(kernel_norm(support)), inverse_square_(1.0 / (support * support)) {}
  [[nodiscard]] double of_square(double r2) const {  ///< [1/m3]
    const double t = 1.0 - r2 * inverse_square_;
    if (t <= 0.0) return 0.0;
    const double t2 = t * t;
    return norm_ * t2 * t2 * t * (1.1 + t * (-1.8 + t * 1.7));
  }

 private:
  double norm_;            ///< [1/m3]
  double inverse_square_;  ///< [1/m2]
};
/// F(r) of grad W(x) = F(r) x [1/m5]
[[nodiscard]] double kernel_gradient(double r, double support);
/// Weight of the kernel's plane at distance z from its centre: the integral of W over it [1/m].
[[nodiscard]] double plane_marginal(double z, double support);

}  // namespace splash::sim
