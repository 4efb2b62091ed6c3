// SPDX-License-Identifier: MIT
// Compiled once for each instruction set. As many particles as one of its vectors holds, that
// follow each other in a row of cells, share one list of neighbours, culled against the box around
// them (neighbours/near.h has the same idea); AVX-512 compresses the list, elsewhere a branch-free
// scalar loop does.
#include "tests/bench/fluid_yardstick.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace splash::bench {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX2__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif
constexpr int kRoom = 4096;  // neighbours of one vector: ten times what a settled fluid has
using Vector = float __attribute__((vector_size(4 * kLanes)));
using Flags = std::int32_t __attribute__((vector_size(4 * kLanes)));

Vector load(const float* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

Vector larger(Vector a, Vector b) {
  return a > b ? a : b;
}

Vector inverse(Vector a) {
#ifdef __AVX512F__
  const Vector estimate = Vector(_mm512_rcp14_ps(__m512(a)));
  return estimate * (2.0F - a * estimate);
#else
  return 1.0F / a;
#endif
}

struct Box {
  std::array<float, 3> lower;
  std::array<float, 3> upper;
};

/// A vector of particles and the points near them.
struct Group {
  int first = 0;
  int last = 0;  ///< one past the last of this turn
  Vector x, y, z;
  int near_count = 0;
  std::array<int, kRoom + kLanes> near;
};

int cell_along(float x, float origin, float inverse_cell, int cells) {
  return static_cast<int>(
      std::clamp((x - origin) * inverse_cell, 1.0F, static_cast<float>(cells - 2)));
}

int slice_of(const sim::FluidParams& p, float x) {
  const float cell =
      std::clamp((x - p.origin_x) * p.inverse_cell, 1.0F, static_cast<float>(p.cells_x));
  return std::min(static_cast<int>(cell * SPLASH_SLICES), (p.cells_x - 1) * SPLASH_SLICES - 1);
}

Box box_around(const Particles& p, int first, int last) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float* part = p.position.data() + axis * static_cast<std::size_t>(p.stride);
    box.lower[axis] = *std::min_element(part + first, part + last);
    box.upper[axis] = *std::max_element(part + first, part + last);
  }
  return box;
}

/// Appends the points from `from` to `to` that lie within the support of the box.
void cull(const Particles& p, const Box& box, int from, int to, Group& group) {
  const float* x = p.position.data();
  const float* y = x + p.stride;
  const float* z = y + p.stride;
  const float reach2 = p.params.support * p.params.support;
  const Vector none = {};
  for (int j = from; j < to; j += kLanes) {
    const Vector dx = larger(larger(box.lower[0] - load(x + j), load(x + j) - box.upper[0]), none);
    const Vector dy = larger(larger(box.lower[1] - load(y + j), load(y + j) - box.upper[1]), none);
    const Vector dz = larger(larger(box.lower[2] - load(z + j), load(z + j) - box.upper[2]), none);
    const Vector r2 = dx * dx + dy * dy + dz * dz;
    const int here = std::min(to - j, kLanes);
#ifdef __AVX512F__
    const __mmask16 inside = _mm512_cmp_ps_mask(__m512(r2), _mm512_set1_ps(reach2), _CMP_LT_OS) &
                             static_cast<__mmask16>((1U << here) - 1U);
    const __m512i numbers =
        _mm512_add_epi32(_mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
                         _mm512_set1_epi32(j));
    _mm512_storeu_si512(group.near.data() + group.near_count,
                        _mm512_maskz_compress_epi32(inside, numbers));
    group.near_count += __builtin_popcount(inside);
#else
    for (int lane = 0; lane < here; ++lane) {
      group.near[static_cast<std::size_t>(group.near_count)] = j + lane;
      group.near_count += r2[lane] < reach2;
    }
#endif
    group.near_count = std::min(group.near_count, kRoom);
  }
}

/// The group that begins at particle `first`: those of a vector that share its row of cells.
void gather(const Particles& p, int first, Group& group) {
  const sim::FluidParams& s = p.params;
  const float* x = p.position.data();
  const float* y = x + p.stride;
  const float* z = y + p.stride;
  const int row = cell_along(z[first], s.origin_z, s.inverse_cell, s.cells_z) * s.cells_y +
                  cell_along(y[first], s.origin_y, s.inverse_cell, s.cells_y);
  const int slices = SPLASH_SLICES * s.cells_x;
  const int row_end = p.cell_start[static_cast<std::size_t>((row + 1) * slices)];
  group.first = first;
  group.last = std::min(first + kLanes, row_end);
  group.x = load(x + first);
  group.y = load(y + first);
  group.z = load(z + first);
  group.near_count = 0;
  const Box box = box_around(p, first, group.last);
  const int from = slice_of(s, x[first]) - SPLASH_SLICES;
  const int to = slice_of(s, x[group.last - 1]) + SPLASH_SLICES + 1;
  for (int k = 0; k < 9; ++k) {
    const int base = (row + (k / 3 - 1) * s.cells_y + k % 3 - 1) * slices;
    cull(p, box, p.cell_start[static_cast<std::size_t>(base + from)],
         p.cell_start[static_cast<std::size_t>(base + to)], group);
  }
}

void store(const Group& group, Vector value, float* to) {
  for (int i = group.first; i < group.last; ++i) to[i] = value[i - group.first];
}

void density_of(const Particles& p, const Group& group, float* density) {
  const float* x = p.position.data();
  const float* y = x + p.stride;
  const float* z = y + p.stride;
  Vector sum = {};
  const Vector none = {};
  const float shrink = p.params.inverse_support * p.params.inverse_support;
  for (int k = 0; k < group.near_count; ++k) {
    const int j = group.near[static_cast<std::size_t>(k)];
    const Vector dx = group.x - x[j];
    const Vector dy = group.y - y[j];
    const Vector dz = group.z - z[j];
    const Vector r2 = dx * dx + dy * dy + dz * dz;
    const Vector t = larger(1.0F - r2 * shrink, none);
    const Vector t2 = t * t;
    sum += t2 * t2 * t * (1.1F + t * (-1.8F + t * 1.7F));
  }
  store(group, p.params.kernel_norm * p.params.mass * sum, density);
}

void acceleration_of(const Particles& p, const Group& group, float* acceleration) {
  const sim::FluidParams& s = p.params;
  const auto n = static_cast<std::size_t>(p.stride);
  const float* x = p.position.data();
  const float* u = p.velocity.data();
  const float eta2 = 0.01F * s.length * s.length;
  const float shrink = s.inverse_support * s.inverse_support;
  const float viscous = s.viscous / s.rest_density;
  const float artificial = s.artificial / s.rest_density;
  const Vector own_u = load(u + group.first);
  const Vector own_v = load(u + n + group.first);
  const Vector own_w = load(u + 2 * n + group.first);
  const Vector own = load(p.pressure.data() + group.first);
  const Vector none = {};
  Vector ax = {};
  Vector ay = {};
  Vector az = {};
  for (int k = 0; k < group.near_count; ++k) {
    const auto j = static_cast<std::size_t>(group.near[static_cast<std::size_t>(k)]);
    const Vector dx = group.x - x[j];
    const Vector dy = group.y - x[n + j];
    const Vector dz = group.z - x[2 * n + j];
    const Vector r2 = dx * dx + dy * dy + dz * dz;
    const Vector t = larger(1.0F - r2 * shrink, none);
    const Vector t2 = t * t;
    const Vector closing =
        (own_u - u[j]) * dx + (own_v - u[n + j]) * dy + (own_w - u[2 * n + j]) * dz;
    const Vector towards = closing < 0.0F ? closing : none;
    const Vector rub = (viscous * closing + artificial * towards) * inverse(r2 + eta2);
    const Vector f = t2 * t2 * (5.5F + t * (-10.8F + t * 11.9F)) * (own + p.pressure[j] - rub);
    ax += f * dx;
    ay += f * dy;
    az += f * dz;
  }
  const float gradient = 2.0F * s.kernel_norm * s.inverse_support * s.inverse_support * s.mass;
  store(group, gradient * ax, acceleration);
  store(group, gradient * ay, acceleration + n);
  store(group, gradient * az, acceleration + 2 * n);
}

template <class Sum>
void for_each_group(const Particles& p, const Starts& starts, int threads, const Sum& sum) {
#pragma omp parallel num_threads(threads)
  {
    Group group;
#pragma omp for schedule(dynamic, 16)
    for (int k = 0; k < starts.count; ++k) {
      gather(p, starts.first[k], group);
      sum(group);
    }
  }
}

void density(const Particles& p, const Starts& starts, int threads, float* sums) {
  for_each_group(p, starts, threads, [&](const Group& group) { density_of(p, group, sums); });
}

void acceleration(const Particles& p, const Starts& starts, int threads, float* sums) {
  for_each_group(p, starts, threads, [&](const Group& group) { acceleration_of(p, group, sums); });
}

}  // namespace

YardstickLoops SPLASH_YARDSTICK() {
  return {density, acceleration, kLanes};
}

}  // namespace splash::bench
