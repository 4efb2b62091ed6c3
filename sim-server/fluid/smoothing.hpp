// SPDX-License-Identifier: MIT
// The smoothing kernel on the host, in double precision. The device's copy is kernels/smoothing.h;
// a test holds them together.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What comes with a kernel.
struct SmoothingTraits {
  double support_spacings;  ///< support H over particle spacing [1]
  double length;            ///< smoothing length h over support [1]
  /// Settled water stands lower than its volume says by this many spacings, whatever its depth: the
  /// outermost layer has nothing above it and packs more densely.
  double surface_loss;
  double acoustic;       ///< largest time step, in H / (c0 + v) [1]
  double least_density;  ///< of a particle in a body of water: spray and films have less [rho0]
};

[[nodiscard]] const SmoothingTraits& traits_of(SmoothingKind kind);

/// A kernel with its support. A bare support means the narrow one.
struct Smoothing {
  // NOLINTNEXTLINE(google-explicit-constructor)
  Smoothing(double support_radius, SmoothingKind which = SmoothingKind::narrow)
      : support(support_radius), kind(which) {}

  double support;  ///< H [m]
  SmoothingKind kind;
};

/// sigma [1/m3]
[[nodiscard]] double kernel_norm(const Smoothing& smoothing);
/// W(r) [1/m3]
[[nodiscard]] double kernel_value(double r, const Smoothing& smoothing);
/// F(r) of grad W(x) = F(r) x [1/m5]
[[nodiscard]] double kernel_gradient(double r, const Smoothing& smoothing);
/// Weight of the kernel's plane at distance z from its centre: the integral of W over it [1/m].
[[nodiscard]] double plane_marginal(double z, const Smoothing& smoothing);

/// What programs with this kernel are built with.
[[nodiscard]] std::vector<std::string> smoothing_defines(int kind);

}  // namespace splash::sim
