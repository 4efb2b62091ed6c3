// SPDX-License-Identifier: MIT
// Where the water stops being sound: pictures over time step and speed, viscosity and resolution,
// and the same as numbers.
#pragma once

#include <filesystem>

#include "tests/stress/trial.hpp"

namespace splash::stress {

/// In a few letters: WCSPH or grid.
[[nodiscard]] const char* short_name_of(sim::PressureKind solver) noexcept;

/// Runs all cells, telling each, and leaves map-*.csv and map-*.png in `out`.
void draw_maps(sim::Device& device, const std::filesystem::path& out);

}  // namespace splash::stress
