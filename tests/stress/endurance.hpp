// SPDX-License-Identifier: MIT
// Test S5: the built-in scenes for very many steps, one after the other: no reset, nobody lost,
// memory and file descriptors as at the beginning.
#pragma once

#include <cstdint>
#include <filesystem>

#include "sim-server/device/device.hpp"

namespace splash::stress {

/// Runs each scene for `steps`, tells how it fares and leaves endurance.csv in `out`; how many did
/// not pass. Memory is compared with that after a tenth of the steps.
[[nodiscard]] int endure(sim::Device& device, std::int64_t steps, const std::filesystem::path& out);

}  // namespace splash::stress
