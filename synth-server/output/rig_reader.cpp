// SPDX-License-Identifier: MIT
#include "synth-server/output/rig_reader.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

#include "program/config.hpp"
#include "synth-server/output/rig_rows.hpp"

namespace splash::synth {
namespace {

using program::ConfigMap;

/// A mapping that only one kind of output has.
void read_part(const ConfigMap& map, const std::string& key, bool allowed,
               const std::vector<Field<Output>>& fields, Output& output) {
  const std::optional<ConfigMap> part = map.optional_child(key);
  if (!part) return;
  if (!allowed) throw map.error(key, "has no meaning for an output of another kind");
  part->read(fields, {}, output);
}

/// Each within its range, and too many together.
void check_tile_count(const ConfigMap& map, const Output& output) {
  if (output.tiles_x <= kMaxTiles / output.tiles_y) return;
  const int most = kMaxTiles / output.tiles_y;
  throw map.child("tiles").error("columns", "must be at most " + std::to_string(most) + " with " +
                                                std::to_string(output.tiles_y) + " rows, got '" +
                                                std::to_string(output.tiles_x) +
                                                "': an output has at most " +
                                                std::to_string(kMaxTiles) + " tiles");
}

EqualiserSection read_section(const ConfigMap& map) {
  static const std::map<std::string, SectionKind> kKinds = {
      {"peak", SectionKind::peak},
      {"low_shelf", SectionKind::low_shelf},
      {"high_shelf", SectionKind::high_shelf}};
  SectionEntry entry;
  map.read(section_fields(), {}, entry);
  entry.kind = kKinds.at(entry.kind_name);
  return entry;
}

Equalisation read_equaliser(const ConfigMap& map) {
  Equalisation equalisation;
  map.read(equaliser_fields(), {"sections", "response"}, equalisation);
  for (const ConfigMap& section : map.list("sections")) {
    equalisation.sections.push_back(read_section(section));
  }
  if (const std::optional<ConfigMap> response = map.optional_child("response")) {
    response->read(response_fields(), {}, equalisation.response);
  }
  return equalisation;
}

Threshold read_threshold(const ConfigMap& map) {
  ThresholdEntry entry;
  map.read(threshold_fields(), {}, entry);
  entry.sense = entry.sense_name == "touch" ? Sense::touch : Sense::hearing;
  return entry;
}

Output read_output(const ConfigMap& map) {
  static const std::map<std::string, OutputKind> kKinds = {{"tiles", OutputKind::tiles},
                                                           {"single", OutputKind::single},
                                                           {"worn", OutputKind::worn},
                                                           {"stereo", OutputKind::stereo}};
  OutputEntry entry;
  map.read(output_fields(), {"band", "tiles", "stereo", "equalisers", "threshold", "heat"}, entry);
  entry.kind = kKinds.at(entry.kind_name);
  map.child("band").read(band_fields(), {}, entry.band);
  read_part(map, "tiles", entry.kind == OutputKind::tiles, tile_fields(), entry);
  if (map.has("tiles")) check_tile_count(map, entry);
  read_part(map, "stereo", entry.kind == OutputKind::stereo, stereo_fields(), entry);
  if (entry.kind == OutputKind::stereo) {
    const std::optional<ConfigMap> stereo = map.optional_child("stereo");
    entry.has_place = stereo && stereo->has("middle");
  }
  if (entry.kind != OutputKind::worn && map.has("parts")) {
    throw map.error("parts", "has no meaning for an output that is not worn");
  }
  for (const ConfigMap& equaliser : map.list("equalisers")) {
    entry.equalisers.push_back(read_equaliser(equaliser));
  }
  if (const std::optional<ConfigMap> threshold = map.optional_child("threshold")) {
    entry.threshold = read_threshold(*threshold);
  }
  if (const std::optional<ConfigMap> heat = map.optional_child("heat")) {
    heat->read(heat_fields(), {}, entry.heat);
  }
  return entry;
}

/// Whoever confuses the two kinds of file is told so, not that a key is unknown.
void refuse_scene(const ConfigMap& map) {
  if (map.has("outputs")) return;
  for (const char* key : {"tank", "fluid"}) {
    if (!map.has(key)) continue;
    throw map.error(key,
                    "this is a scene, which says what sim-server simulates (--scene); a rig is "
                    "wanted here, which says what synth-server drives, e.g. "
                    "configs/rigs/stereo.yaml");
  }
}

/// After the outputs, whose channels they are.
std::vector<int> device_channels(const ConfigMap& map, const RigEntry& rig) {
  std::vector<int> numbers;
  for (const double number : rig.device_channel_numbers) {
    numbers.push_back(static_cast<int>(number));
    if (number != std::floor(number)) {
      throw map.error("device_channels", "must be whole numbers, e.g. [3, 1]");
    }
  }
  return numbers;
}

Rig read_map(const ConfigMap& map) {
  refuse_scene(map);
  RigEntry rig;
  map.read(rig_fields(), {"outputs"}, rig);
  for (const ConfigMap& output : map.list("outputs")) {
    rig.outputs.push_back(read_output(output));
    try {
      check(rig);
    } catch (const std::invalid_argument& broken) {
      throw program::ConfigError(output.place(), broken.what());
    }
  }
  if (rig.outputs.empty()) throw map.error("outputs", "must list one output or more");
  rig.device_channels = device_channels(map, rig);
  try {
    check(rig);
  } catch (const std::invalid_argument& broken) {
    throw map.error("device_channels", broken.what());
  }
  return rig;
}

}  // namespace

Rig read_rig(const std::filesystem::path& path) {
  return read_map(ConfigMap::load(path));
}

Rig parse_rig(const std::string& text, const std::string& file_name) {
  return read_map(ConfigMap::parse(text, file_name));
}

}  // namespace splash::synth
