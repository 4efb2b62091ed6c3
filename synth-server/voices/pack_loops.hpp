// SPDX-License-Identifier: MIT
// The loops behind PackKernels, for the files that are compiled once per instruction set: with the
// compiler's vectors of kVectorBytes, no intrinsics. Everything here has internal linkage and
// nothing of the standard library's is called: code that was compiled for a newer processor must
// never be linked into the rest of the program.
#pragma once

#include <utility>

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {
namespace {

inline constexpr int kVectorBytes = SPLASH_VECTOR_BYTES;
inline constexpr std::ptrdiff_t kRow = kCell;  ///< from a lane's samples to the next one's

template <class Real>
struct Lanes {
  using Vector __attribute__((vector_size(kVectorBytes), may_alias)) = Real;
  static constexpr int kCount = kVectorBytes / static_cast<int>(sizeof(Real));
  using Order = std::make_integer_sequence<int, kCount>;
};

template <class Real>
using Vector = typename Lanes<Real>::Vector;

/// low: a0 b0 a1 b1 ..., high: the same of the upper halves.
template <class V, int... I>
[[gnu::always_inline]] inline void interleave(const V& a, const V& b, V& low, V& high,
                                              std::integer_sequence<int, I...>) {
  constexpr int kCount = static_cast<int>(sizeof...(I));
  low = __builtin_shufflevector(a, b, (I / 2 + (I % 2) * kCount)...);
  high = __builtin_shufflevector(a, b, (kCount / 2 + I / 2 + (I % 2) * kCount)...);
}

/// Rows become columns: log2 kCount perfect shuffles.
template <class Real>
[[gnu::always_inline]] inline void transpose(Vector<Real>* rows) {
  constexpr int kCount = Lanes<Real>::kCount;
  for (int width = 1; width < kCount; width *= 2) {
    Vector<Real> shuffled[kCount];
    for (int i = 0; i < kCount / 2; ++i) {
      interleave(rows[i], rows[i + kCount / 2], shuffled[2 * i], shuffled[2 * i + 1],
                 typename Lanes<Real>::Order{});
    }
    for (int i = 0; i < kCount; ++i) rows[i] = shuffled[i];
  }
}

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

/// As many samples as a vector has lanes, from `out` on, lane by lane; the first of them even.
template <class Real>
[[gnu::always_inline]] inline void render_block(Turning<Real>& voices, Real* out) {
  constexpr int kCount = Lanes<Real>::kCount;
  Vector<Real> rows[kCount];
  for (int k = 0; k < kCount; ++k) {
    rows[k] = voices.im[k % 2];
    voices.step(k % 2);
  }
  transpose<Real>(rows);
  for (int lane = 0; lane < kCount; ++lane) {
    *reinterpret_cast<Vector<Real>*>(out + lane * kRow) = rows[lane];
  }
}

/// One sample, where a block of the device cuts a cell.
template <class Real>
[[gnu::always_inline]] inline void render_sample(Turning<Real>& voices, int parity, Real* out) {
  for (int lane = 0; lane < Lanes<Real>::kCount; ++lane) {
    out[lane * kRow] = voices.im[parity][lane];
  }
  voices.step(parity);
}

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

template <class Pack>
void advance(Pack& pack, int from, int to, typename Pack::Real* samples) {
  using Real = typename Pack::Real;
  constexpr int kCount = Lanes<Real>::kCount;
  if (from == 0) begin_cell(pack);
  for (int lane = 0; lane < kPackVoices; lane += kCount) {
    Turning<Real> voices{};
    voices.load(pack, lane);
    Real* const out = samples + lane * kRow;
    for (int n = from; n < to;) {
      if (n % kCount == 0 && n + kCount <= to) {
        render_block(voices, out + n);
        n += kCount;
      } else {
        render_sample(voices, n % 2, out + n);
        ++n;
      }
    }
    voices.store(pack, lane);
  }
}

/// A whole cell: the voice stays in registers while its channels pass by.
template <class Real>
[[gnu::always_inline]] inline void mix_cell(const Real* samples, const Feed<Real>* feeds, int count,
                                            Real* channels) {
  constexpr int kVectors = kCell / Lanes<Real>::kCount;
  constexpr int kHeld = kVectors < 8 ? kVectors : 8;
  for (int first = 0; first < kVectors; first += kHeld) {
    Vector<Real> held[kHeld];
    for (int k = 0; k < kHeld; ++k) {
      held[k] = reinterpret_cast<const Vector<Real>*>(samples)[first + k];
    }
    for (int f = 0; f < count; ++f) {
      auto* const out = reinterpret_cast<Vector<Real>*>(channels + feeds[f].channel * kRow);
      for (int k = 0; k < kHeld; ++k) out[first + k] += feeds[f].gain * held[k];
    }
  }
}

template <class Real>
void mix(const Real* samples, int from, int to, const Feed<Real>* feeds, int stride,
         const std::int32_t* counts, Real* channels) {
  const bool whole = from == 0 && to == kCell;
  for (int lane = 0; lane < kPackVoices; ++lane, feeds += stride, samples += kRow) {
    if (whole) {
      mix_cell<Real>(samples, feeds, counts[lane], channels);
      continue;
    }
    for (int f = 0; f < counts[lane]; ++f) {
      Real* const out = channels + feeds[f].channel * kRow;
      for (int n = from; n < to; ++n) out[n] += feeds[f].gain * samples[n];
    }
  }
}

}  // namespace
}  // namespace splash::synth
