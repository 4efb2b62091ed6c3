// SPDX-License-Identifier: MIT
#include "sim-server/fluid/random_draw.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <Random123/philox.h>
#pragma GCC diagnostic pop

namespace splash::sim {

std::array<double, 4> random_draw(const std::array<std::uint32_t, 4>& counter,
                                  const std::array<std::uint32_t, 2>& key) {
  const r123::Philox4x32 generator;
  const r123::Philox4x32::key_type k = {{key[0], key[1]}};
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const auto bits = generator(c, k);
  constexpr double kUnit = 1.0 / 4294967296.0;  // 2^-32
  return {bits[0] * kUnit, bits[1] * kUnit, bits[2] * kUnit, bits[3] * kUnit};
}

}  // namespace splash::sim
