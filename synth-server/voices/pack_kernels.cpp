// SPDX-License-Identifier: MIT
#include "synth-server/voices/pack_kernels.hpp"

#include <algorithm>

namespace splash::synth {

// Made by pack_loops.cpp.
PackKernels pack_kernels_portable() noexcept;
#if defined(__x86_64__)
PackKernels pack_kernels_avx2() noexcept;
PackKernels pack_kernels_avx512() noexcept;
#endif

namespace {

InstructionSet of_this_processor() noexcept {
#if defined(__x86_64__)
  // Those that the loops are compiled for: see CMakeLists.txt.
  if (__builtin_cpu_supports("avx2") == 0 || __builtin_cpu_supports("fma") == 0) {
    return InstructionSet::portable;
  }
  const bool wide = __builtin_cpu_supports("avx512f") != 0 &&
                    __builtin_cpu_supports("avx512dq") != 0 &&
                    __builtin_cpu_supports("avx512vl") != 0;
  return wide ? InstructionSet::avx512 : InstructionSet::avx2;
#else
  return InstructionSet::portable;
#endif
}

}  // namespace

InstructionSet available(InstructionSet wanted) noexcept {
  static const InstructionSet kMost = of_this_processor();
  return std::min(wanted, kMost);
}

const char* name_of(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::portable:
      return "portable";
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::avx512:
      return "AVX-512";
    case InstructionSet::best:
      break;
  }
  return name_of(available(InstructionSet::best));
}

PackKernels pack_kernels(InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (available(set) == InstructionSet::avx512) return pack_kernels_avx512();
  if (available(set) == InstructionSet::avx2) return pack_kernels_avx2();
#else
  static_cast<void>(set);
#endif
  return pack_kernels_portable();
}

}  // namespace splash::synth
