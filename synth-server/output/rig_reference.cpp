// SPDX-License-Identifier: MIT
// The rows of the rig file as Markdown tables, with their defaults.
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/output/rig_rows.hpp"

namespace splash::synth {
namespace {

using program::Row;

template <class Struct>
std::string describe_fields(const std::vector<Field<Struct>>& fields) {
  static Struct fallback{};  // static: else g++ 12 warns of uninitialised strings
  std::vector<Row> rows;
  std::vector<std::string> defaults;
  for (const Field<Struct>& field : fields) {
    rows.push_back(field.row);
    defaults.push_back(std::visit(
        [&](auto member) { return program::default_text(&(fallback.*member)); }, field.member));
  }
  return program::describe(rows, defaults);
}

}  // namespace

std::string describe_rig_keys() {
  return "### A rig\n\n" + describe_fields(rig_fields()) + "\n### Each of `outputs`\n\n" +
         describe_fields(output_fields()) + "\n### `band` of an output\n\n" +
         describe_fields(band_fields()) + "\n### `tiles` of an output of that kind\n\n" +
         describe_fields(tile_fields()) + "\n### `stereo` of an output of that kind\n\n" +
         describe_fields(stereo_fields()) + "\n### Each of `equalisers` of an output\n\n" +
         describe_fields(equaliser_fields()) + "\n### Each of `sections` of an equaliser\n\n" +
         describe_fields(section_fields()) + "\n### `response` of an equaliser\n\n" +
         describe_fields(response_fields()) + "\n### `threshold` of an output\n\n" +
         describe_fields(threshold_fields()) + "\n### `heat` of an output\n\n" +
         describe_fields(heat_fields());
}

}  // namespace splash::synth
