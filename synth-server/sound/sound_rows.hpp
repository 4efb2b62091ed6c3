// SPDX-License-Identifier: MIT
// Every number of a sound, a row each: the error texts and the manual come from them, and the
// reader of a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

using program::Field;

/// What a sound is called, beside its numbers.
struct NamedSound {
  std::string name = "cirio2013";
  std::string description;
  Sound sound;  ///< the paper's
};

[[nodiscard]] std::vector<Field<NamedSound>> sound_fields();
/// The rows of a part of a sound, whose name in files is `name`.
template <class Part>
[[nodiscard]] std::vector<Field<Part>> fields_of(const Part& part, const std::string& name);

/// The number of a row, each of which is a double.
template <class Part>
[[nodiscard]] const double& number_of(const Part& part, const Field<Part>& field) {
  return part.*std::get<double Part::*>(field.member);
}

/// A YAML file as a sound. Keys that are missing take the paper's values. Throws
/// program::ConfigError with file, line and column.
[[nodiscard]] NamedSound read_sound(const std::filesystem::path& path);
[[nodiscard]] NamedSound parse_sound(const std::string& text, const std::string& file_name);

/// All keys as Markdown tables: the reference in configs/sounds/README.md.
[[nodiscard]] std::string describe_sound_keys();

}  // namespace splash::synth
