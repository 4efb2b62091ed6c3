// SPDX-License-Identifier: MIT
#include "synth-server/output/spreading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

/// 1 at distance 0, falling to 0 at `reach` and beyond.
double nearness(double dx, double dy, double reach) noexcept {
  return std::max(0.0, 1.0 - (dx * dx + dy * dy) / (reach * reach));
}

void spread_tiles(const Output& output, const protocol::Vec3& position, double* gains) noexcept {
  const double size = output.tile_size;
  const double x = static_cast<double>(position.x) - output.place[0];
  const double y = static_cast<double>(position.y) - output.place[1];
  const double inside_x = std::clamp(x, 0.0, output.tiles_x * size);
  const double inside_y = std::clamp(y, 0.0, output.tiles_y * size);
  double power = 0.0;
  for (int row = 0; row < output.tiles_y; ++row) {
    for (int column = 0; column < output.tiles_x; ++column) {
      const double gain =
          nearness((column + 0.5) * size - inside_x, (row + 0.5) * size - inside_y, output.reach);
      gains[row * output.tiles_x + column] = gain;
      power += gain * gain;
    }
  }
  const double level = nearness(x - inside_x, y - inside_y, output.reach) / std::sqrt(power);
  for (int tile = 0; tile < output.tiles_x * output.tiles_y; ++tile) gains[tile] *= level;
}

void spread_stereo(const Output& output, const protocol::Vec3& position, double* gains) noexcept {
  const double x = static_cast<double>(position.x) - output.place[0];
  const double share = std::clamp(0.5 + x / output.width, 0.0, 1.0);
  gains[0] = std::cos(0.5 * std::numbers::pi * share);
  gains[1] = share >= 1.0 ? 1.0 : std::sin(0.5 * std::numbers::pi * share);
}

}  // namespace

void spread(const Output& output, const protocol::Vec3& position, double* gains) noexcept {
  switch (output.kind) {
    case OutputKind::tiles:
      spread_tiles(output, position, gains);
      break;
    case OutputKind::stereo:
      spread_stereo(output, position, gains);
      break;
    case OutputKind::single:
    case OutputKind::worn:
      std::fill_n(gains, channel_count(output), 1.0);
      break;
  }
}

}  // namespace splash::synth
