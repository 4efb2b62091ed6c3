// SPDX-License-Identifier: MIT
// The loops behind PackKernels, for the files that are compiled once per instruction set: with the
// compiler's vectors of kVectorBytes, no intrinsics. Everything here has internal linkage and
// nothing of the standard library's is called: code that was compiled for a newer processor must
// never be linked into the rest of the program.
#pragma once

#include <cstddef>
#include <utility>

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

inline void begin(ExactPack& /*pack*/, TurningLanes<double>& /*lanes*/) {}

inline void begin(FastPack& pack, TurningLanes<float>& lanes) {
  lanes.rise = pack.rise;
  round(pack.cell_sound, lanes.sound[0]);
  round_product(pack.cell_sound, pack.first_turn, lanes.sound[1]);
  round(pack.pair_turn, lanes.turn[0]);
  round_product(pack.pair_turn, pack.half_rise, lanes.turn[1]);
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
  Real* row = rows + lane;
  voices.load(pack, lane);
  // Each parity is named, not computed: else its voices would go through memory for every sample.
  const auto emit = [&](int parity) __attribute__((always_inline)) {
    *reinterpret_cast<Vector<Real>*>(row) = voices.im[parity];
    row += kPackVoices;
    voices.step(parity);
  };
  int n = from;
  if (n % 2 == 1 && n < to) {
    emit(1);
    ++n;
  }
  for (; n + 2 <= to; n += 2) {
    emit(0);
    emit(1);
  }
  if (n < to) emit(0);
  voices.store(pack, lane);
}

template <class Real>
void turn_lanes(TurningLanes<Real>& lanes, int from, int to, Real* rows) {
  for (int lane = 0; lane < kPackVoices; lane += Lanes<Real>::kCount) {
    render<Real>(lanes, lane, from, to, rows);
  }
}

/// Lanes of a channel's sum. Of doubles always eight, so that the order of adding, and with it
/// every bit, is the same on each processor.
template <class Real>
inline constexpr int kSumLanes = sizeof(Real) == sizeof(double) ? 8 : Lanes<Real>::kCount;

/// Gains that are kept in registers, as vectors: of the 16 or 32 that there are.
inline constexpr int kGainVectors = kVectorBytes == 64 ? 16 : 8;

/// Samples that are mixed per turn of the loop. Its counting is an eighth of SSE2's operations;
/// wider vectors' do not wait for it.
inline constexpr int kSamplesAtOnce = kVectorBytes == 16 ? 4 : 1;

/// What kChannels channels get of the same packs, and their sums.
template <class Real, int kChannels>
struct Mixing {
  const PackMix<Real>* packs[kChannels];
  Real* sums[kChannels];
};

/// Some of the packs: their gains fit into the registers.
template <class Real, int kPacks, int kChannels>
[[gnu::always_inline]] inline void mix_some(const Mixing<Real, kChannels>& mixing, int first,
                                            int from, int to) {
  using V = Vector<Real>;
  constexpr int kParts = kPackVoices / kSumLanes<Real>;
  for (int lane = 0; lane < kSumLanes<Real>; lane += Lanes<Real>::kCount) {
    V gains[kChannels][kPacks][kParts];
    const Real* rows[kPacks];
    for (int k = 0; k < kPacks; ++k) {
      rows[k] = mixing.packs[0]->rows[first + k];
      for (int c = 0; c < kChannels; ++c) {
        const Real* const from_lane = mixing.packs[c]->feeds[first + k]->gains + lane;
        for (int part = 0; part < kParts; ++part) {
          gains[c][k][part] = *reinterpret_cast<const V*>(&from_lane[part * kSumLanes<Real>]);
        }
      }
    }
#pragma GCC unroll kSamplesAtOnce
    for (int n = from; n < to; ++n) {
      V added[kChannels];
      for (int c = 0; c < kChannels; ++c) {
        added[c] = *reinterpret_cast<V*>(&mixing.sums[c][n * kSumLanes<Real> + lane]);
      }
      for (int k = 0; k < kPacks; ++k) {
        for (int part = 0; part < kParts; ++part) {
          const int at = (n - from) * kPackVoices + part * kSumLanes<Real> + lane;
          // Volatile: once for all channels, where compilers would fetch it for each.
          const V row = *reinterpret_cast<const volatile V*>(&rows[k][at]);
          for (int c = 0; c < kChannels; ++c) added[c] += gains[c][k][part] * row;
        }
      }
      for (int c = 0; c < kChannels; ++c) {
        *reinterpret_cast<V*>(&mixing.sums[c][n * kSumLanes<Real> + lane]) = added[c];
      }
    }
  }
}

/// The last of the packs, kMost at most: all at once.
template <class Real, int kMost, int kChannels>
[[gnu::always_inline]] inline void mix_rest(const Mixing<Real, kChannels>& mixing, int first,
                                            int from, int to) {
  if (mixing.packs[0]->count - first == kMost) {
    mix_some<Real, kMost>(mixing, first, from, to);
  } else if constexpr (kMost > 1) {
    mix_rest<Real, kMost - 1>(mixing, first, from, to);
  }
}

/// As many at once as registers hold, then what is left: sums are fetched and put back seldom.
template <class Real, int kChannels>
[[gnu::always_inline]] inline void mix_all(const Mixing<Real, kChannels>& mixing, int from,
                                           int to) {
  constexpr int kFitting = kGainVectors * kSumLanes<Real> / (kChannels * kPackVoices);
  constexpr int kAtOnce = kFitting < kMixedPacks<Real> ? kFitting : kMixedPacks<Real>;
  int first = 0;
  for (; first + kAtOnce <= mixing.packs[0]->count; first += kAtOnce) {
    mix_some<Real, kAtOnce>(mixing, first, from, to);
  }
  if constexpr (kAtOnce > 1) mix_rest<Real, kAtOnce - 1>(mixing, first, from, to);
}

template <class Real>
void mix(const PackMix<Real>& packs, int from, int to, Real* sums) {
  mix_all<Real, 1>({{&packs}, {sums}}, from, to);
}

template <class Real>
void mix_two(const PackMix<Real>& packs, const PackMix<Real>& other, int from, int to, Real* sums,
             Real* other_sums) {
  mix_all<Real, 2>({{&packs, &other}, {sums, other_sums}}, from, to);
}

/// low: a0 b0 a1 b1 ..., high: the same of the upper halves.
template <class V, int... I>
[[gnu::always_inline]] inline void interleave(const V& a, const V& b, V& low, V& high,
                                              std::integer_sequence<int, I...> /*order*/) {
  constexpr int kCount = static_cast<int>(sizeof...(I));
  low = __builtin_shufflevector(a, b, (I / 2 + (I % 2) * kCount)...);
  high = __builtin_shufflevector(a, b, (kCount / 2 + I / 2 + (I % 2) * kCount)...);
}

/// As many samples as a sum has lanes, if that is a vector's worth: rows become columns by perfect
/// shuffles, and columns are added.
template <class Real>
[[gnu::always_inline]] inline void collect_block(Real* sums, double* out) {
  constexpr int kCount = Lanes<Real>::kCount;
  Vector<Real> rows[kCount];
  for (int k = 0; k < kCount; ++k) {
    auto& row = reinterpret_cast<Vector<Real>*>(sums)[k];
    rows[k] = row;
    row = Vector<Real>{};
  }
  for (int width = 1; width < kCount; width *= 2) {
    Vector<Real> shuffled[kCount];
    for (int i = 0; i < kCount / 2; ++i) {
      interleave(rows[i], rows[i + kCount / 2], shuffled[2 * i], shuffled[2 * i + 1],
                 std::make_integer_sequence<int, kCount>{});
    }
    for (int i = 0; i < kCount; ++i) rows[i] = shuffled[i];
  }
  for (int half = kCount / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) rows[lane] += rows[lane + half];
  }
  for (int k = 0; k < kCount; ++k) out[k] += static_cast<double>(rows[0][k]);
}

template <class Real>
[[gnu::always_inline]] inline void collect_sample(Real* row, double* out) {
  for (int half = kSumLanes<Real> / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) row[lane] += row[lane + half];
  }
  *out += static_cast<double>(row[0]);
  for (int lane = 0; lane < kSumLanes<Real>; ++lane) row[lane] = Real{0};
}

template <class Real>
void collect(Real* sums, int from, int to, double* out) {
  constexpr int kCount = kSumLanes<Real>;
  for (int n = from; n < to;) {
    Real* const row = sums + std::ptrdiff_t{n} * kCount;
    if constexpr (kCount == Lanes<Real>::kCount) {
      if (n % kCount == 0 && n + kCount <= to) {
        collect_block(row, &out[n]);
        n += kCount;
        continue;
      }
    }
    collect_sample(row, &out[n]);
    ++n;
  }
}

}  // namespace
}  // namespace splash::synth
