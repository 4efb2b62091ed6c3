// SPDX-License-Identifier: MIT
#include "synth-server/sound/sound_reader.hpp"

#include "program/config.hpp"

namespace splash::synth {
namespace {

using program::ConfigMap;

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
  std::vector<std::string> parts;
  each_part(sound.sound, [&](const char* name, auto&) { parts.emplace_back(name); });
  map.read(sound_fields(), parts, sound);
  each_part(sound.sound, [&](const char* name, auto& part) {
    if (const auto child = map.optional_child(name)) child->read(fields_of(part, name), {}, part);
  });
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
