// SPDX-License-Identifier: MIT
// The rows of a sound as Markdown tables, with their defaults.
#include <array>
#include <cstdio>

#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// `part`: whose numbers are the defaults.
template <class Part>
std::string describe_fields(const std::vector<Field<Part>>& fields, const Part& part) {
  std::vector<program::Row> rows;
  std::vector<std::string> defaults;
  for (const Field<Part>& field : fields) {
    rows.push_back(field.row);
    const auto* number = std::get_if<double Part::*>(&field.member);
    defaults.push_back(number == nullptr ? "" : text_of(part.**number));
  }
  return program::describe(rows, defaults);
}

}  // namespace

std::string describe_sound_keys() {
  const NamedSound paper;
  std::string text = "### A sound\n\n" + describe_fields(sound_fields(), paper);
  each_part(paper.sound, [&text](const char* name, const auto& part) {
    text += "\n### `" + std::string(name) + "`\n\n" + describe_fields(fields_of(part, name), part);
  });
  return text;
}

}  // namespace splash::synth
