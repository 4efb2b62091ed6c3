// SPDX-License-Identifier: MIT
// Denormal numbers count as nil while this lives: dying filters would otherwise cost many times
// their time on some processors. The setting is the thread's, so it is put back afterwards.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace splash::synth {

class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() noexcept : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | kFlushAndZero);
  }
  ~FlushDenormals() {
    _mm_setcsr(saved_);
  }
#elif defined(__aarch64__)
  FlushDenormals() noexcept {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" ::"r"(saved_ | (std::uint64_t{1} << 24U)));
  }
  ~FlushDenormals() {
    asm volatile("msr fpcr, %0" ::"r"(saved_));
  }
#else
  FlushDenormals() noexcept = default;
  ~FlushDenormals() {
    static_cast<void>(saved_);
  }
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushAndZero = 0x8040U;  ///< FTZ (bit 15) and DAZ (bit 6) of MXCSR
  unsigned saved_;
#else
  std::uint64_t saved_ = 0;
#endif
};

}  // namespace splash::synth
