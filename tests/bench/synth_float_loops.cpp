// SPDX-License-Identifier: MIT
#include "tests/bench/synth_float_loops.hpp"

#include <ctime>

namespace splash::bench {
namespace {

using Vector __attribute__((vector_size(SPLASH_VECTOR_BYTES), may_alias)) = float;
constexpr int kLanes = SPLASH_VECTOR_BYTES / 4;

void advance(FloatPack& pack, float* samples) {
  for (int lane = 0; lane < 16; lane += kLanes) {
    Vector re = *reinterpret_cast<Vector*>(pack.re + lane);
    Vector im = *reinterpret_cast<Vector*>(pack.im + lane);
    Vector turn_re = *reinterpret_cast<Vector*>(pack.turn_re + lane);
    Vector turn_im = *reinterpret_cast<Vector*>(pack.turn_im + lane);
    const Vector rise_re = *reinterpret_cast<Vector*>(pack.rise_re + lane);
    const Vector rise_im = *reinterpret_cast<Vector*>(pack.rise_im + lane);
    for (int n = 0; n < 64; ++n) {
      *reinterpret_cast<Vector*>(samples + n * 16 + lane) = im;
      const Vector next = re * turn_re - im * turn_im;
      im = re * turn_im + im * turn_re;
      re = next;
      const Vector next_turn = turn_re * rise_re - turn_im * rise_im;
      turn_im = turn_re * rise_im + turn_im * rise_re;
      turn_re = next_turn;
    }
    *reinterpret_cast<Vector*>(pack.re + lane) = re;
    *reinterpret_cast<Vector*>(pack.im + lane) = im;
    *reinterpret_cast<Vector*>(pack.turn_re + lane) = turn_re;
    *reinterpret_cast<Vector*>(pack.turn_im + lane) = turn_im;
  }
}

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Twelve chains that do not wait for each other.
double vector_rate() {
  constexpr int kChains = 12;
  constexpr int kRounds = 4'000'000;
  Vector chains[kChains];
  for (int c = 0; c < kChains; ++c) chains[c] = Vector{} + static_cast<float>(c);
  Vector factor = Vector{} + 0.99999F;
  Vector addend = Vector{} + 1e-5F;
  asm volatile("" : "+x"(factor), "+x"(addend));  // unknown to the compiler
  const double start = seconds();
  for (int round = 0; round < kRounds; ++round) {
    for (int c = 0; c < kChains; ++c) chains[c] = chains[c] * factor + addend;
  }
  const double spent = seconds() - start;
  for (int c = 0; c < kChains; ++c) asm volatile("" : "+x"(chains[c]));
  constexpr double kOperations = SPLASH_FUSED ? 1.0 : 2.0;
  return kOperations * kChains * kRounds / spent;
}

}  // namespace

FloatLoops SPLASH_FLOAT_LOOPS() {
  return {advance, vector_rate, kLanes, SPLASH_FUSED};
}

}  // namespace splash::bench
