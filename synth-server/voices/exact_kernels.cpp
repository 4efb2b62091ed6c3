// SPDX-License-Identifier: MIT
// The exact setting's loops, for the instruction set that this object file is compiled with.
#include "synth-server/voices/pack_loops.hpp"

namespace splash::synth {

/// Made here as exact_kernels_portable, exact_kernels_avx2 and exact_kernels_avx512.
PackKernels<ExactPack> SPLASH_KERNELS() noexcept {
  using Real = ExactPack::Real;
  return {begin, turn_lanes<Real>, mix<Real>, mix_two<Real>, collect<Real>};
}

}  // namespace splash::synth
