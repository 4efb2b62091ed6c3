// SPDX-License-Identifier: MIT
// The bubble by linear theory: a sphere of air in water, small radial oscillations, heat flowing
// between gas and water (A. Prosperetti 1977, J. Acoust. Soc. Am. 61; C. E. Brennen 1995,
// Cavitation and Bubble Dynamics, section 4.2 and 4.4):
//   rho r^2 w0^2 = 3 k p_gas - 2 sigma / r,   p_gas = p_atm + rho g h + 2 sigma / r
// with k the real part of the complex polytropic exponent, which is nearly Minnaert's 1.4 for the
// large and nearly 1 for the small. What the fit of the paper lumps together is three terms:
//   d = 2 mu / (rho r^2)  +  3 p_gas Im k / (2 rho r^2 w0)  +  w0^2 r / (2 c)
//       viscous              thermal                           radiation
// A rise of the pitch is no part of the theory: it is van den Doel's, for bubbles that come up to
// the surface.
#pragma once

namespace splash::synth {

/// Air in fresh water at 20 C under one atmosphere.
struct Water {
  double density = 998.0;           ///< rho [kg/m^3]
  double sound_speed = 1482.0;      ///< c [m/s]
  double viscosity = 1.0e-3;        ///< mu [Pa s]
  double surface_tension = 0.0728;  ///< sigma [N/m]
  double atmosphere = 101325.0;     ///< [Pa]
  double gravity = 9.81;            ///< [m/s^2]
  double heat_ratio = 1.4;          ///< gamma of air [1]
  double gas_diffusivity = 2.0e-5;  ///< of heat in air [m^2/s]
};

/// What theory says of a bubble, part by part.
struct BubbleResonance {
  double frequency = 0.0;   ///< f0 [Hz]
  double polytropic = 0.0;  ///< Re k [1]
  double viscous = 0.0;     ///< [1/s]
  double thermal = 0.0;     ///< [1/s]
  double radiation = 0.0;   ///< [1/s]
  [[nodiscard]] double damping() const noexcept { return viscous + thermal + radiation; }
};

/// `radius` [m], `depth` of its middle under the surface [m].
[[nodiscard]] BubbleResonance resonance(double radius, double depth,
                                        const Water& water = {}) noexcept;

}  // namespace splash::synth
