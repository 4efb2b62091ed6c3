// SPDX-License-Identifier: MIT
// Water pulls as well as it pushes: Briggs 1950 tore it at -28 MPa, and the air presses its surface
// after whatever leaves it. Without that it comes apart wherever a slap's pressure is relieved, or
// behind what moves on. But a particle that has less around it than in full water need not be
// stretched: at a surface it sums to 0.81 rho0 at rest, and a pull there would be a skin as tight
// as 30 N/m (0.09^2 c0^2 rho0 dp at 13 m/s and 2 cm; water's is 0.07). So each remembers its peak
// density k, the densest that it was since it last came apart, and only what is less dense is
// stretched:
//   k   = rho                                     torn: rho < rho_t, air has come in between
//   k   = min(rho0, max(k, rho)), forgotten at s, k' = -s (k - rho)                 otherwise
//   P_i = c0^2 ( max(rho - rho0, 0) / rho^2 + b min(rho - k, 0) / rho0^2 )           P = p / rho^2
// With k held this is the gradient of an energy, and each change of k takes energy away or leaves
// it alone, as in a material that yields (Simo & Hughes 1998, section 1.2): the total never grows,
// momentum is kept. b = 1/2: what has neighbours on one side only swings faster than full water,
// and must not need shorter steps (README.md, "Water that pulls").

#include "sim-server/fluid/lanes/lanes.h"
#include "sim-server/fluid/params/fluid_params.h"

// k of water of the density rho that had the peak density `before`, a step of dt ago.
static lanes peak_density_now(constant FluidParams* p, float dt, lanes rho, lanes before) {
  const lanes whole = fmin(fmax(before, rho), (lanes)(p->rest_density));
  const lanes fading = whole - SPLASH_STRETCH_FADES * dt * fmax(whole - rho, 0.0f);
  return select(fading, rho, rho < (lanes)(p->torn_density));
}

// P of the state equation.
static lanes state_equation(constant FluidParams* p, lanes rho, lanes peak) {
  const lanes push = fmax(rho - p->rest_density, 0.0f) / (rho * rho);
  const lanes pull = fmin(rho - peak, 0.0f) / (p->rest_density * p->rest_density);
  return p->sound_speed * p->sound_speed * (push + SPLASH_STRETCH_STIFFNESS * pull);
}
