// SPDX-License-Identifier: MIT
#include "synth-server/output/rig.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "program/text.hpp"

namespace splash::synth {
namespace {

constexpr int kMaxChannels = 2048;
constexpr std::size_t kMaxParts = 64;
constexpr double kMostBoost = 24.0;      // [dB]
constexpr double kMostCut = 60.0;        // [dB]
constexpr std::size_t kMostPoints = 64;  ///< of a response, and sections of a list
/// Closer points would need filters so narrow that they ring.
constexpr double kLeastRatio = 1.05;

[[noreturn]] void refuse(const Output& output, const std::string& key, double value,
                         const std::string& rule) {
  throw std::invalid_argument("output '" + output.name + "': " + key + " = " +
                              program::format("%g", value) + ": " + rule);
}

void check_tiles(const Output& output) {
  if (output.tiles_x < 1) refuse(output, "tiles.columns", output.tiles_x, "must be at least 1");
  if (output.tiles_y < 1) refuse(output, "tiles.rows", output.tiles_y, "must be at least 1");
  if (output.tiles_x > kMaxTiles / output.tiles_y) {
    refuse(output, "tiles.columns", output.tiles_x, "an output has at most 1024 tiles");
  }
  if (!(output.tile_size > 0.0)) refuse(output, "tiles.size", output.tile_size, "must be positive");
  // Half a tile's diagonal is 0.71 of its edge: with less reach, corners would be mute.
  if (!(output.reach >= 0.75 * output.tile_size)) {
    refuse(output, "tiles.reach", output.reach, "must be at least 0.75 of tiles.size");
  }
}

void check_parts(const Output& output) {
  const auto& parts = output.parts;
  if (parts.empty() || parts.size() > kMaxParts) {
    refuse(output, "number of parts", static_cast<double>(parts.size()),
           "a worn output has 1 to 64, one per transducer, such as [heel, toe]");
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].empty() &&
        std::find(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), parts[i]) ==
            parts.begin() + static_cast<std::ptrdiff_t>(i)) {
      continue;
    }
    throw std::invalid_argument("output '" + output.name + "': part '" + parts[i] +
                                "': names must differ and not be empty");
  }
}

void check_heat(const Output& output) {
  const Heat& heat = output.heat;
  if (heat.rms != 0.0 && !(heat.rms >= 0.05 && heat.rms <= 1.0)) {
    refuse(output, "heat.rms", heat.rms, "must be in [0.05, 1], or 0 for no budget");
  }
  if (!(heat.seconds >= 0.1 && heat.seconds <= 600.0)) {
    refuse(output, "heat.seconds", heat.seconds, "must be in [0.1, 600]");
  }
}

void check_device_channels(const Rig& rig) {
  const std::vector<int>& wanted = rig.device_channels;
  const auto refuse_them = [](const std::string& rule) {
    throw std::invalid_argument("device_channels: " + rule);
  };
  if (!wanted.empty() && wanted.size() != static_cast<std::size_t>(channel_count(rig))) {
    refuse_them(std::to_string(wanted.size()) + " of them, and the rig has " +
                std::to_string(channel_count(rig)) + " channels: one each, or none");
  }
  for (auto number = wanted.begin(); number != wanted.end(); ++number) {
    if (*number < 1 || *number > kMostDeviceChannels) {
      refuse_them(std::to_string(*number) + ": must be 1 to " +
                  std::to_string(kMostDeviceChannels));
    }
    if (std::find(wanted.begin(), number, *number) != number) {
      refuse_them(std::to_string(*number) + " is named twice: each channel goes to one of its own");
    }
  }
}

void require(bool good, const Output& output, const std::string& key, double value,
             const std::string& rule) {
  if (!good) refuse(output, "equalisers: " + key, value, rule);
}

void check_section(const Output& output, const EqualiserSection& s, double most_boost) {
  require(s.frequency >= 1.0 && s.frequency <= 192000.0, output, "frequency", s.frequency,
          "must be 1 to 192000 Hz");
  require(s.q >= 0.1 && s.q <= 30.0, output, "q", s.q, "must be 0.1 to 30");
  require(s.gain_db >= -kMostCut, output, "gain_db", s.gain_db, "must be at least -60 dB");
  require(s.gain_db <= most_boost, output, "gain_db", s.gain_db,
          "must not be over most_boost_db, which keeps transducers from harm");
}

void check_response(const Output& output, const MeasuredResponse& response) {
  const auto& at = response.frequency;
  require(at.size() == response.level_db.size(), output, "number of level_db",
          static_cast<double>(response.level_db.size()),
          "must be " + std::to_string(at.size()) + ", as many as frequencies");
  require(at.empty() || (at.size() >= 2 && at.size() <= kMostPoints), output,
          "number of frequencies", static_cast<double>(at.size()), "must be 2 to 64");
  require(response.most_cut_db >= 0.0 && response.most_cut_db <= kMostCut, output, "most_cut_db",
          response.most_cut_db, "must be 0 to 60 dB");
  for (std::size_t i = 0; i < at.size(); ++i) {
    require(at[i] >= 1.0 && at[i] <= 192000.0, output, "frequency", at[i],
            "must be 1 to 192000 Hz");
    require(i == 0 || at[i] >= kLeastRatio * at[i - 1], output, "frequency", at[i],
            "must be at least 1.05 times the one before it");
    require(std::abs(response.level_db[i]) <= 120.0, output, "level_db", response.level_db[i],
            "must be within -120 and 120 dB");
  }
}

void check_equalisers(const Output& output) {
  const std::vector<std::string> names = part_names(output);
  for (const Equalisation& e : output.equalisers) {
    for (const std::string& channel : e.channels) {
      if (std::find(names.begin(), names.end(), channel) != names.end()) continue;
      throw std::invalid_argument("output '" + output.name + "': equalisers: no channel '" +
                                  channel + "'; there is e.g. '" + names.front() + "'");
    }
    require(e.most_boost_db >= 0.0 && e.most_boost_db <= kMostBoost, output, "most_boost_db",
            e.most_boost_db, "must be 0 to 24 dB");
    require(e.sections.size() <= kMostPoints, output, "number of sections",
            static_cast<double>(e.sections.size()), "must be at most 64");
    for (const EqualiserSection& section : e.sections) {
      check_section(output, section, e.most_boost_db);
    }
    check_response(output, e.response);
  }
}

void check_output(const Output& output) {
  if (output.name.empty()) throw std::invalid_argument("an output needs a name");
  const Band& band = output.band;
  if (!(band.low >= 1.0)) refuse(output, "band.low", band.low, "must be at least 1 Hz");
  if (!(band.high > band.low)) refuse(output, "band.high", band.high, "must be above band.low");
  if (!(output.ceiling > 0.0 && output.ceiling <= 1.0)) {
    refuse(output, "ceiling", output.ceiling, "must be in (0, 1]");
  }
  check_heat(output);
  if (!(output.full_scale > 0.0)) {
    refuse(output, "full_scale", output.full_scale, "must be positive");
  }
  if (!(std::abs(output.gain_db) <= 60.0)) {
    refuse(output, "gain_db", output.gain_db, "must be within -60 and 60 dB");
  }
  if (output.kind == OutputKind::tiles) check_tiles(output);
  if (output.kind == OutputKind::worn) check_parts(output);
  if (output.kind == OutputKind::stereo && !(output.width > 0.0)) {
    refuse(output, "width", output.width, "must be positive");
  }
  const auto channels = static_cast<std::size_t>(channel_count(output));
  if (!output.trims_db.empty() && output.trims_db.size() != channels) {
    refuse(output, "number of trims_db", static_cast<double>(output.trims_db.size()),
           "must be " + std::to_string(channels) + ", one per channel, or none");
  }
  check_equalisers(output);
}

}  // namespace

void centre(Rig& rig, const std::array<double, 3>& middle) noexcept {
  for (Output& output : rig.outputs) {
    if (!output.has_place) output.place = middle;
  }
}

int channel_count(const Output& output) noexcept {
  switch (output.kind) {
    case OutputKind::tiles:
      return output.tiles_x * output.tiles_y;
    case OutputKind::single:
      return 1;
    case OutputKind::worn:
      return static_cast<int>(output.parts.size());
    case OutputKind::stereo:
      return 2;
  }
  return 0;
}

int channel_count(const Rig& rig) noexcept {
  int count = 0;
  for (const Output& output : rig.outputs) count += channel_count(output);
  return count;
}

std::vector<std::string> part_names(const Output& output) {
  if (output.kind == OutputKind::single) return {""};
  if (output.kind == OutputKind::stereo) return {"left", "right"};
  if (output.kind == OutputKind::worn) return output.parts;
  std::vector<std::string> names;
  const int count = channel_count(output);
  const std::size_t width = std::max<std::size_t>(2, std::to_string(count - 1).size());
  for (int tile = 0; tile < count; ++tile) {
    const std::string number = std::to_string(tile);
    names.push_back("tile/" + std::string(width - number.size(), '0') + number);
  }
  return names;
}

std::vector<std::string> channel_names(const Rig& rig) {
  std::vector<std::string> names;
  for (const Output& output : rig.outputs) {
    for (const std::string& part : part_names(output)) {
      names.push_back(part.empty() ? output.name : output.name + '/' + part);
    }
  }
  return names;
}

void check(const Rig& rig) {
  if (rig.outputs.empty()) {
    throw std::invalid_argument("rig '" + rig.name + "' has no outputs; it needs at least one");
  }
  for (std::size_t i = 0; i < rig.outputs.size(); ++i) {
    check_output(rig.outputs[i]);
    for (std::size_t j = 0; j < i; ++j) {
      if (rig.outputs[i].name != rig.outputs[j].name) continue;
      throw std::invalid_argument("two outputs are named '" + rig.outputs[i].name +
                                  "'; channel names must differ");
    }
  }
  if (channel_count(rig) > kMaxChannels) {
    throw std::invalid_argument("rig '" + rig.name + "' has " + std::to_string(channel_count(rig)) +
                                " channels; limit: 2048");
  }
  check_device_channels(rig);
}

}  // namespace splash::synth
