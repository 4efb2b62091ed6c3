// SPDX-License-Identifier: MIT
// Packs water that hangs free like a liquid before time begins. What stands in a basin does so by
// its own weight (settle.hpp); nothing stirs a drop, and it would keep the lattice that it was put
// on: drawn out, its rows part, and the same water counts as a fifth denser.
#pragma once

#include <cstdint>
#include <vector>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

/// Puts each particle that is `loose`, by its id, anywhere in its own cube of the lattice, which
/// leaves no rows [1], then lets pressure alone move them, without weight and stopped after each
/// step, to where none presses: a glass [2]. All others stay where they are. With nothing loose
/// nothing is done. Waits.
///
/// `bodies`: where they are, at rest; `piston`: offset of the wave maker [m]; `dt`: of a step [s];
/// the same `seed` gives the same packing.
/// [1] Jittered sampling: Cook 1986 (ACM Trans. Graph. 5, 51), section 4.
/// [2] Diehl, Rockefeller, Fryer, Riethmiller & Statler 2015 (PASA 32, e048), section 2.
void pack(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double dt,
          const std::vector<bool>& loose, std::uint32_t seed);

}  // namespace splash::sim
