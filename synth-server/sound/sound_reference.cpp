// SPDX-License-Identifier: MIT
// The rows of a sound as Markdown tables, with their defaults.
#include "program/text.hpp"
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

/// `part`: whose numbers are the defaults.
template <class Part>
std::string describe_fields(const std::vector<Field<Part>>& fields, const Part& part) {
  std::vector<program::Row> rows;
  std::vector<std::string> defaults;
  for (const Field<Part>& field : fields) {
    rows.push_back(field.row);
    const auto* number = std::get_if<double Part::*>(&field.member);
    defaults.push_back(number == nullptr ? "" : program::format("%.6g", part.**number));
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
