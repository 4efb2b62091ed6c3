// SPDX-License-Identifier: MIT
// The fast setting's loops, for the instruction set that this object file is compiled with.
#include "synth-server/voices/pack_loops.hpp"

namespace splash::synth {

/// Made here as fast_kernels_portable, fast_kernels_avx2 and fast_kernels_avx512.
PackKernels<FastPack> SPLASH_KERNELS() noexcept {
  using Real = FastPack::Real;
  return {begin, turn_lanes<Real>, mix<Real>, mix_two<Real>, collect<Real>};
}

}  // namespace splash::synth
