// SPDX-License-Identifier: MIT
#include "synth-server/sound/sound_reader.hpp"

#include "program/config.hpp"

namespace splash::synth {
namespace {

using program::ConfigMap;

template <class Part>
void read_part(const ConfigMap& map, const std::string& key, const std::vector<Field<Part>>& fields,
               Part& part) {
  if (const std::optional<ConfigMap> child = map.optional_child(key)) child->read(fields, {}, part);
}

/// Whoever confuses the kinds of files is told so, not that a key is unknown.
void refuse_others(const ConfigMap& map) {
  for (const char* key : {"tank", "fluid", "outputs"}) {
    if (!map.has(key)) continue;
    throw map.error(key, std::string(std::string(key) == "outputs"
                                         ? "this is a rig, which says what is driven (--rig)"
                                         : "this is a scene, which is sim-server's (--scene)") +
                             "; a sound is wanted here, which says how water sounds, e.g. "
                             "configs/sounds/cirio2013.yaml");
  }
}

NamedSound read_map(const ConfigMap& map) {
  refuse_others(map);
  NamedSound sound;
  map.read(sound_fields(), {"impact", "bubble", "cavity", "cloud", "fine", "foot"}, sound);
  read_part(map, "impact", impact_fields(), sound.sound.impact);
  read_part(map, "bubble", bubble_fields(), sound.sound.bubble);
  read_part(map, "cavity", cavity_fields(), sound.sound.cavity);
  read_part(map, "cloud", cloud_fields(), sound.sound.cloud);
  read_part(map, "fine", fine_fields(), sound.sound.fine);
  read_part(map, "foot", foot_fields(), sound.sound.foot);
  return sound;
}

}  // namespace

NamedSound read_sound(const std::filesystem::path& path) {
  return read_map(ConfigMap::load(path));
}

NamedSound parse_sound(const std::string& text, const std::string& file_name) {
  return read_map(ConfigMap::parse(text, file_name));
}

}  // namespace splash::synth
