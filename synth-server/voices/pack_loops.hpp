// SPDX-License-Identifier: MIT
// The loops behind PackKernels, for the files that are compiled once per instruction set: with the
// compiler's vectors of kVectorBytes, no intrinsics. Everything here has internal linkage and
// nothing of the standard library's is called: code that was compiled for a newer processor must
// never be linked into the rest of the program.
#pragma once

#include <cstddef>

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {
namespace {

inline constexpr int kVectorBytes = SPLASH_VECTOR_BYTES;
template <class Real>
struct Lanes {
  using Vector __attribute__((vector_size(kVectorBytes), may_alias)) = Real;
  static constexpr int kCount = kVectorBytes / static_cast<int>(sizeof(Real));
};

template <class Real>
using Vector = typename Lanes<Real>::Vector;

/// z <- z w
template <class V>
[[gnu::always_inline]] inline void turn(V& z_re, V& z_im, const V& w_re, const V& w_im) {
  const V re = z_re * w_re - z_im * w_im;
  z_im = z_re * w_im + z_im * w_re;
  z_re = re;
}

/// One vector's worth of a pack's lanes, in registers.
template <class Real>
struct Turning {
  using V = Vector<Real>;
  V re[2], im[2], turn_re[2], turn_im[2], rise_re, rise_im;

  [[gnu::always_inline]] inline void load(const TurningLanes<Real>& pack, int lane) {
    for (int parity = 0; parity < 2; ++parity) {
      re[parity] = *reinterpret_cast<const V*>(pack.sound[parity].re + lane);
      im[parity] = *reinterpret_cast<const V*>(pack.sound[parity].im + lane);
      turn_re[parity] = *reinterpret_cast<const V*>(pack.turn[parity].re + lane);
      turn_im[parity] = *reinterpret_cast<const V*>(pack.turn[parity].im + lane);
    }
    rise_re = *reinterpret_cast<const V*>(pack.rise.re + lane);
    rise_im = *reinterpret_cast<const V*>(pack.rise.im + lane);
  }
  [[gnu::always_inline]] inline void store(TurningLanes<Real>& pack, int lane) const {
    for (int parity = 0; parity < 2; ++parity) {
      *reinterpret_cast<V*>(pack.sound[parity].re + lane) = re[parity];
      *reinterpret_cast<V*>(pack.sound[parity].im + lane) = im[parity];
      *reinterpret_cast<V*>(pack.turn[parity].re + lane) = turn_re[parity];
      *reinterpret_cast<V*>(pack.turn[parity].im + lane) = turn_im[parity];
    }
  }
  [[gnu::always_inline]] inline void step(int parity) {
    turn(re[parity], im[parity], turn_re[parity], turn_im[parity]);
    turn(turn_re[parity], turn_im[parity], rise_re, rise_im);
  }
};

[[gnu::always_inline]] inline void multiply(ComplexLanes<double>& a,
                                            const ComplexLanes<double>& b) {
  for (int k = 0; k < kPackVoices; ++k) {
    const double re = a.re[k] * b.re[k] - a.im[k] * b.im[k];
    a.im[k] = a.re[k] * b.im[k] + a.im[k] * b.re[k];
    a.re[k] = re;
  }
}

[[gnu::always_inline]] inline void round(const ComplexLanes<double>& from,
                                         ComplexLanes<float>& to) {
  for (int k = 0; k < kPackVoices; ++k) to.re[k] = static_cast<float>(from.re[k]);
  for (int k = 0; k < kPackVoices; ++k) to.im[k] = static_cast<float>(from.im[k]);
}

/// to <- a b
template <class Real>
[[gnu::always_inline]] inline void round_product(const ComplexLanes<double>& a,
                                                 const ComplexLanes<Real>& b,
                                                 ComplexLanes<float>& to) {
  for (int k = 0; k < kPackVoices; ++k) {
    const double b_re = static_cast<double>(b.re[k]);
    const double b_im = static_cast<double>(b.im[k]);
    to.re[k] = static_cast<float>(a.re[k] * b_re - a.im[k] * b_im);
    to.im[k] = static_cast<float>(a.re[k] * b_im + a.im[k] * b_re);
  }
}

inline void begin_cell(ExactPack& /*pack*/) {}

inline void begin_cell(FastPack& pack) {
  round(pack.cell_sound, pack.sound[0]);
  round_product(pack.cell_sound, pack.first_turn, pack.sound[1]);
  round(pack.pair_turn, pack.turn[0]);
  round_product(pack.pair_turn, pack.half_rise, pack.turn[1]);
  multiply(pack.cell_sound, pack.cell_leap);
  multiply(pack.cell_leap, pack.cell_leap_rise);
  multiply(pack.first_turn, pack.first_turn_rise);
  multiply(pack.pair_turn, pack.pair_turn_rise);
}

/// Samples [from, to) of a vector's worth of lanes.
template <class Real>
[[gnu::always_inline]] inline void render(TurningLanes<Real>& pack, int lane, int from, int to,
                                          Real* rows) {
  Turning<Real> voices{};
  voices.load(pack, lane);
  int n = from;
  const auto emit = [&](int parity) __attribute__((always_inline)) {
    *reinterpret_cast<Vector<Real>*>(&rows[n * kPackVoices + lane]) = voices.im[parity];
    voices.step(parity);
    ++n;
  };
  if (n % 2 == 1 && n < to) emit(1);
  while (n + 2 <= to) {
    emit(0);
    emit(1);
  }
  if (n < to) emit(0);
  voices.store(pack, lane);
}

template <class Pack>
void advance(Pack& pack, int from, int to, typename Pack::Real* rows) {
  using Real = typename Pack::Real;
  if (from == 0) begin_cell(pack);
  for (int lane = 0; lane < kPackVoices; lane += Lanes<Real>::kCount) {
    render<Real>(pack, lane, from, to, rows);
  }
}

/// Lanes of a channel's sum. Of doubles always eight, so that the order of adding, and with it
/// every bit, is the same on each processor.
template <class Real>
inline constexpr int kSumLanes = sizeof(Real) == sizeof(double) ? 8 : Lanes<Real>::kCount;

template <class Real>
void mix(const Real* rows, int from, int to, const PackFeed<Real>* feeds,
         const std::int32_t* channels, int count, Real* sums) {
  using V = Vector<Real>;
  constexpr int kParts = kPackVoices / kSumLanes<Real>;
  for (int f = 0; f < count; ++f) {
    Real* const channel = &sums[std::ptrdiff_t{channels[f]} * kRows];
    for (int lane = 0; lane < kSumLanes<Real>; lane += Lanes<Real>::kCount) {
      V gains[kParts];
      for (int part = 0; part < kParts; ++part) {
        gains[part] = *reinterpret_cast<const V*>(feeds[f].gains + part * kSumLanes<Real> + lane);
      }
      for (int n = from; n < to; ++n) {
        V& sum = *reinterpret_cast<V*>(&channel[n * kSumLanes<Real> + lane]);
        V added = sum;
        for (int part = 0; part < kParts; ++part) {
          const int at = n * kPackVoices + part * kSumLanes<Real> + lane;
          added += gains[part] * *reinterpret_cast<const V*>(&rows[at]);
        }
        sum = added;
      }
    }
  }
}

template <class Real>
void collect(Real* sums, int from, int to, double* out) {
  for (int n = from; n < to; ++n) {
    Real* const row = &sums[n * kSumLanes<Real>];
    for (int half = kSumLanes<Real> / 2; half > 0; half /= 2) {
      for (int lane = 0; lane < half; ++lane) row[lane] += row[lane + half];
    }
    out[n] += static_cast<double>(row[0]);
    for (int lane = 0; lane < kSumLanes<Real>; ++lane) row[lane] = Real{0};
  }
}

}  // namespace
}  // namespace splash::synth
