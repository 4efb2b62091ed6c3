// SPDX-License-Identifier: MIT
// Random numbers by a counter: each is a function of what it is for, whatever is drawn besides.
#pragma once

#include <array>
#include <cstdint>

namespace splash::sim {

/// Four numbers, uniform on [0, 1), for this counter and key: Philox 4x32 (Salmon, Moraes, Dror &
/// Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3").
[[nodiscard]] std::array<double, 4> random_draw(const std::array<std::uint32_t, 4>& counter,
                                                const std::array<std::uint32_t, 2>& key);

}  // namespace splash::sim
