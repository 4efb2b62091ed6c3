// SPDX-License-Identifier: MIT
// The walk that force plates recorded, and what a floor of tiles would have felt of it: a foot's
// force lies on a patch of 8 cm around its centre of pressure, and a tile that is loaded at one
// point shares that out among its corners by the levers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct PlateFoot {
  double force = 0.0;  ///< [N]
  double x = 0.0;      ///< [m]
  double y = 0.0;
};

struct PlateRow {
  double time = 0.0;                   ///< [s]
  std::array<PlateFoot, 2> feet = {};  ///< left, right
};

inline std::vector<PlateRow> read_plates() {
  std::ifstream file(SPLASH_SOURCE_DIR "/tests/data/walk_plates.csv");
  std::vector<PlateRow> rows;
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    PlateRow row;
    if (!(words >> row.time)) continue;
    for (PlateFoot& foot : row.feet) words >> foot.force >> foot.x >> foot.y;
    rows.push_back(row);
  }
  return rows;
}

/// What the floor's sensors feel of both feet, in their order [N].
inline std::vector<double> readings_of(const PlateRow& row, const TrackingSettings& tracking) {
  constexpr int kPoints = 5;
  constexpr double kPatch = 0.08;  // [m]
  const FloorSettings& floor = tracking.floor;
  std::vector<double> readings(static_cast<std::size_t>(floor.columns * floor.rows * floor.sensors),
                               0.0);
  const auto add = [&](int column, int row_of, int corner, double force) {
    readings[static_cast<std::size_t>((row_of * floor.columns + column) * floor.sensors +
                                      corner)] += force;
  };
  for (const PlateFoot& foot : row.feet) {
    for (int k = 0; k < kPoints * kPoints; ++k) {
      const double force = foot.force / (kPoints * kPoints);
      const double side = kPatch / kPoints;
      const double x = foot.x + side * (k % kPoints - kPoints / 2) - tracking.position[0];
      const double y = foot.y + side * (k / kPoints - kPoints / 2) - tracking.position[1];
      const int column = static_cast<int>(std::floor(x / floor.tile));
      const int row_of = static_cast<int>(std::floor(y / floor.tile));
      if (column < 0 || row_of < 0 || column >= floor.columns || row_of >= floor.rows) continue;
      if (floor.sensors == 1) {
        add(column, row_of, 0, force);
        continue;
      }
      const double u = x / floor.tile - column;
      const double v = y / floor.tile - row_of;
      add(column, row_of, 0, (1.0 - u) * (1.0 - v) * force);
      add(column, row_of, 1, u * (1.0 - v) * force);
      add(column, row_of, 2, (1.0 - u) * v * force);
      add(column, row_of, 3, u * v * force);
    }
  }
  return readings;
}

/// The same as messages, 15 sensors in each.
inline std::vector<protocol::Message> pressure_messages(const std::vector<double>& readings) {
  std::vector<protocol::Message> messages;
  for (std::size_t first = 0; first < readings.size(); first += 15) {
    protocol::Message message = {"/tile/pressure", {static_cast<std::int32_t>(first)}};
    for (std::size_t k = first; k < std::min(first + 15, readings.size()); ++k) {
      message.arguments.emplace_back(static_cast<float>(readings[k]));
    }
    messages.push_back(message);
  }
  return messages;
}

}  // namespace splash::sim
