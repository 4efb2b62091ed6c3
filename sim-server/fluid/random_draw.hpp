// SPDX-License-Identifier: MIT
// Random numbers by a counter: each is a function of what it is for, whatever is drawn besides.
#pragma once

#include <array>
#include <cstdint>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace splash::sim {

/// Four numbers, uniform on [0, 1), for this counter and key: Philox 4x32 (Salmon, Moraes, Dror &
/// Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3").
[[nodiscard]] inline std::array<double, 4> random_draw(const std::array<std::uint32_t, 4>& counter,
                                                       const std::array<std::uint32_t, 2>& key) {
  const r123::Philox4x32 generator;
  const r123::Philox4x32::key_type k = {{key[0], key[1]}};
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const auto bits = generator(c, k);
  constexpr double kUnit = 1.0 / 4294967296.0;  // 2^-32
  return {bits[0] * kUnit, bits[1] * kUnit, bits[2] * kUnit, bits[3] * kUnit};
}

}  // namespace splash::sim
