// SPDX-License-Identifier: MIT
// The loops behind PackKernels, compiled once per instruction set: with the compiler's vectors of
// kVectorBytes, no intrinsics. All but the function that hands them out has internal linkage, and
// nothing of the standard library's is called: code that was compiled for a newer processor must
// never be linked into the rest of the program.
#include <cstddef>
#include <utility>

#include "synth-server/voices/pack_kernels.hpp"

namespace splash::synth {
namespace {

constexpr int kVectorBytes = SPLASH_VECTOR_BYTES;
using Vector __attribute__((vector_size(kVectorBytes), may_alias)) = double;
constexpr int kLanes = kVectorBytes / static_cast<int>(sizeof(double));

/// z <- z w
[[gnu::always_inline]] inline void turn(Vector& z_re, Vector& z_im, const Vector& w_re,
                                        const Vector& w_im) {
  const Vector re = z_re * w_re - z_im * w_im;
  z_im = z_re * w_im + z_im * w_re;
  z_re = re;
}

/// One vector's worth of a pack's lanes, in registers.
struct Turning {
  Vector re[2], im[2], turn_re[2], turn_im[2], rise_re, rise_im;

  [[gnu::always_inline]] inline void load(const BubblePack& pack, int lane) {
    for (int parity = 0; parity < 2; ++parity) {
      re[parity] = *reinterpret_cast<const Vector*>(pack.sound[parity].re + lane);
      im[parity] = *reinterpret_cast<const Vector*>(pack.sound[parity].im + lane);
      turn_re[parity] = *reinterpret_cast<const Vector*>(pack.turn[parity].re + lane);
      turn_im[parity] = *reinterpret_cast<const Vector*>(pack.turn[parity].im + lane);
    }
    rise_re = *reinterpret_cast<const Vector*>(pack.rise.re + lane);
    rise_im = *reinterpret_cast<const Vector*>(pack.rise.im + lane);
  }
  [[gnu::always_inline]] inline void store(BubblePack& pack, int lane) const {
    for (int parity = 0; parity < 2; ++parity) {
      *reinterpret_cast<Vector*>(pack.sound[parity].re + lane) = re[parity];
      *reinterpret_cast<Vector*>(pack.sound[parity].im + lane) = im[parity];
      *reinterpret_cast<Vector*>(pack.turn[parity].re + lane) = turn_re[parity];
      *reinterpret_cast<Vector*>(pack.turn[parity].im + lane) = turn_im[parity];
    }
  }
  [[gnu::always_inline]] inline void step(int parity) {
    turn(re[parity], im[parity], turn_re[parity], turn_im[parity]);
    turn(turn_re[parity], turn_im[parity], rise_re, rise_im);
  }
};

/// Samples [from, to) of a vector's worth of lanes.
[[gnu::always_inline]] inline void render(BubblePack& pack, int lane, int from, int to,
                                          double* rows) {
  Turning voices{};
  double* row = rows + lane;
  voices.load(pack, lane);
  // Each parity is named, not computed: else its voices would go through memory for every sample.
  const auto emit = [&](int parity) __attribute__((always_inline)) {
    *reinterpret_cast<Vector*>(row) = voices.im[parity];
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

void turn_lanes(BubblePack& pack, int from, int to, double* rows) {
  for (int lane = 0; lane < kPackVoices; lane += kLanes) render(pack, lane, from, to, rows);
}

/// Lanes of a channel's sum: always eight, so that the order of adding, and with it every bit, is
/// the same on each processor.
constexpr int kSumLanes = 8;

/// Gains that are kept in registers, as vectors: of the 16 or 32 that there are.
constexpr int kGainVectors = kVectorBytes == 64 ? 16 : 8;

/// Samples that are mixed per turn of the loop. Its counting is an eighth of SSE2's operations;
/// wider vectors' do not wait for it.
constexpr int kSamplesAtOnce = kVectorBytes == 16 ? 4 : 1;

/// Some of the packs: their gains fit into the registers.
template <int kPacks>
[[gnu::always_inline]] inline void mix_some(const PackMix& packs, int first, int from, int to,
                                            double* sums) {
  constexpr int kParts = kPackVoices / kSumLanes;
  for (int lane = 0; lane < kSumLanes; lane += kLanes) {
    Vector gains[kPacks][kParts];
    for (int k = 0; k < kPacks; ++k) {
      const double* const from_lane = packs.feeds[first + k]->gains + lane;
      for (int part = 0; part < kParts; ++part) {
        gains[k][part] =
            *reinterpret_cast<const Vector*>(&from_lane[std::ptrdiff_t{part} * kSumLanes]);
      }
    }
#pragma GCC unroll kSamplesAtOnce
    for (int n = from; n < to; ++n) {
      auto& sum = *reinterpret_cast<Vector*>(&sums[n * kSumLanes + lane]);
      Vector added = sum;
      for (int k = 0; k < kPacks; ++k) {
        for (int part = 0; part < kParts; ++part) {
          const int at = (n - from) * kPackVoices + part * kSumLanes + lane;
          added += gains[k][part] * *reinterpret_cast<const Vector*>(&packs.rows[first + k][at]);
        }
      }
      sum = added;
    }
  }
}

/// The last of the packs, kMost at most: all at once.
template <int kMost>
[[gnu::always_inline]] inline void mix_rest(const PackMix& packs, int first, int from, int to,
                                            double* sums) {
  if (packs.count - first == kMost) {
    mix_some<kMost>(packs, first, from, to, sums);
  } else if constexpr (kMost > 1) {
    mix_rest<kMost - 1>(packs, first, from, to, sums);
  }
}

/// As many at once as registers hold, then what is left: sums are fetched and put back seldom.
void mix(const PackMix& packs, int from, int to, double* sums) {
  constexpr int kFitting = kGainVectors * kSumLanes / kPackVoices;
  constexpr int kAtOnce = kFitting < kMixedPacks ? kFitting : kMixedPacks;
  int first = 0;
  for (; first + kAtOnce <= packs.count; first += kAtOnce) {
    mix_some<kAtOnce>(packs, first, from, to, sums);
  }
  if constexpr (kAtOnce > 1) mix_rest<kAtOnce - 1>(packs, first, from, to, sums);
}

/// low: a0 b0 a1 b1 ..., high: the same of the upper halves.
template <int... I>
[[gnu::always_inline]] inline void interleave(const Vector& a, const Vector& b, Vector& low,
                                              Vector& high,
                                              std::integer_sequence<int, I...> /*order*/) {
  constexpr int kCount = static_cast<int>(sizeof...(I));
  low = __builtin_shufflevector(a, b, (I / 2 + (I % 2) * kCount)...);
  high = __builtin_shufflevector(a, b, (kCount / 2 + I / 2 + (I % 2) * kCount)...);
}

/// As many samples as a sum has lanes, if that is a vector's worth: rows become columns by perfect
/// shuffles, and columns are added.
[[gnu::always_inline]] inline void collect_block(double* sums, double* out) {
  Vector rows[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    auto& row = reinterpret_cast<Vector*>(sums)[k];
    rows[k] = row;
    row = Vector{};
  }
  for (int width = 1; width < kLanes; width *= 2) {
    Vector shuffled[kLanes];
    for (std::ptrdiff_t i = 0; i < kLanes / 2; ++i) {
      interleave(rows[i], rows[i + kLanes / 2], shuffled[2 * i], shuffled[2 * i + 1],
                 std::make_integer_sequence<int, kLanes>{});
    }
    for (int i = 0; i < kLanes; ++i) rows[i] = shuffled[i];
  }
  for (int half = kLanes / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) rows[lane] += rows[lane + half];
  }
  for (int k = 0; k < kLanes; ++k) out[k] += rows[0][k];
}

[[gnu::always_inline]] inline void collect_sample(double* row, double* out) {
  for (int half = kSumLanes / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) row[lane] += row[lane + half];
  }
  *out += row[0];
  for (int lane = 0; lane < kSumLanes; ++lane) row[lane] = 0.0;
}

void collect(double* sums, int from, int to, double* out) {
  for (int n = from; n < to;) {
    double* const row = sums + std::ptrdiff_t{n} * kSumLanes;
    if constexpr (kSumLanes == kLanes) {
      if (n % kLanes == 0 && n + kLanes <= to) {
        collect_block(row, &out[n]);
        n += kLanes;
        continue;
      }
    }
    collect_sample(row, &out[n]);
    ++n;
  }
}

}  // namespace

/// Made here as pack_kernels_portable, pack_kernels_avx2 and pack_kernels_avx512.
PackKernels SPLASH_KERNELS() noexcept {
  return {turn_lanes, mix, collect};
}

}  // namespace splash::synth
