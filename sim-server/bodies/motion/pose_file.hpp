// SPDX-License-Identifier: MIT
// Recorded poses of one body as CSV: the header t,x,y,z,qx,qy,qz,qw (seconds, metres, unit
// quaternion body to world), then a pose per line. Lines that begin with # are remarks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Both throw program::ConfigError with line and column.
[[nodiscard]] std::vector<Keyframe> read_poses(const std::filesystem::path& path);
[[nodiscard]] std::vector<Keyframe> parse_poses(const std::string& text,
                                                const std::string& file_name);

}  // namespace splash::sim
