// SPDX-License-Identifier: MIT
#include "synth-server/output/rig_reader.hpp"

#include <cstdio>
#include <map>
#include <stdexcept>

#include "protocol/config.hpp"

namespace splash::synth {
namespace {

using protocol::ConfigMap;
using protocol::Field;
using protocol::Row;

constexpr const char* kPaper = "paper, section 6";

/// What the YAML says of an output beside Output's own members.
struct OutputEntry : Output {
  std::string kind_name;
};

std::vector<Field<Rig>> rig_fields() {
  return {{{.key = "name", .unit = "", .meaning = "what the rig is called", .required = true},
           &Rig::name},
          {{.key = "description", .unit = "", .meaning = "one line for lists"}, &Rig::description}};
}

std::vector<Field<OutputEntry>> output_fields() {
  return {
      {{.key = "name", .unit = "", .meaning = "begins the names of its channels", .required = true},
       &OutputEntry::name},
      {{.key = "kind",
        .unit = "",
        .meaning = "a floor of tiles, one transducer, or a pair of loudspeakers",
        .required = true,
        .choices = {"tiles", "single", "stereo"}},
       &OutputEntry::kind_name},
      {{.key = "full_scale",
        .unit = "m",
        .meaning = "amplitude of a voice that drives its channel to 1.0, before gain_db",
        .min = 1e-6,
        .max = 10.0,
        .source = "a cavity of 10 cm: epsilon r = 0.1 x 0.1 m"},
       &OutputEntry::full_scale},
      {{.key = "gain_db", .unit = "dB", .meaning = "gain of all channels", .min = -60, .max = 60},
       &OutputEntry::gain_db},
      {{.key = "ceiling",
        .unit = "1",
        .meaning = "no sample ever leaves beyond this part of full scale",
        .min = 0.001,
        .max = 1.0},
       &OutputEntry::ceiling},
      {{.key = "body",
        .unit = "",
        .meaning = "number of the one body whose events are rendered; -1: all",
        .min = -1,
        .max = 16777215},
       &OutputEntry::body},
      {{.key = "trims_db",
        .unit = "dB",
        .meaning = "gain of each channel, in their order",
        .min = -60,
        .max = 60},
       &OutputEntry::trims_db}};
}

std::vector<Field<Band>> band_fields() {
  return {{{.key = "low",
            .unit = "Hz",
            .meaning = "-3 dB point of the high-pass, 24 dB per octave",
            .min = 1,
            .max = 20000,
            .required = true},
           &Band::low},
          {{.key = "high",
            .unit = "Hz",
            .meaning = "-3 dB point of the low-pass; bubbles born above it are left out",
            .min = 2,
            .max = 192000,
            .required = true},
           &Band::high}};
}

std::vector<Field<Output>> tile_fields() {
  return {{{.key = "origin", .unit = "m", .meaning = "corner of tile 0 with the least x and y"},
           &Output::place},
          {{.key = "columns",
            .unit = "",
            .meaning = "tiles along +x",
            .min = 1,
            .max = 1024,
            .source = kPaper},
           &Output::tiles_x},
          {{.key = "rows",
            .unit = "",
            .meaning = "tiles along +y",
            .min = 1,
            .max = 1024,
            .source = kPaper},
           &Output::tiles_y},
          {{.key = "size",
            .unit = "m",
            .meaning = "edge of a tile",
            .min = 0.01,
            .max = 10,
            .source = kPaper},
           &Output::tile_size},
          {{.key = "reach",
            .unit = "m",
            .meaning = "an event moves tiles whose middle is nearer than this",
            .min = 0.01,
            .max = 100,
            .source = "1.3 tiles: an event on a corner moves its four tiles alike"},
           &Output::reach}};
}

std::vector<Field<Output>> stereo_fields() {
  return {{{.key = "middle", .unit = "m", .meaning = "point heard from both sides alike"},
           &Output::place},
          {{.key = "width",
            .unit = "m",
            .meaning = "from all on the left to all on the right, along x",
            .min = 0.01,
            .max = 100},
           &Output::width}};
}

/// A mapping that only one kind of output has.
void read_part(const ConfigMap& map, const std::string& key, bool allowed,
               const std::vector<Field<Output>>& fields, Output& output) {
  const std::optional<ConfigMap> part = map.optional_child(key);
  if (!part) return;
  if (!allowed) throw map.error(key, "has no meaning for an output of another kind");
  part->read(fields, {}, output);
}

Output read_output(const ConfigMap& map) {
  static const std::map<std::string, OutputKind> kKinds = {
      {"tiles", OutputKind::tiles}, {"single", OutputKind::single}, {"stereo", OutputKind::stereo}};
  OutputEntry entry;
  map.read(output_fields(), {"band", "tiles", "stereo"}, entry);
  entry.kind = kKinds.at(entry.kind_name);
  map.child("band").read(band_fields(), {}, entry.band);
  read_part(map, "tiles", entry.kind == OutputKind::tiles, tile_fields(), entry);
  read_part(map, "stereo", entry.kind == OutputKind::stereo, stereo_fields(), entry);
  return entry;
}

Rig read_map(const ConfigMap& map) {
  Rig rig;
  map.read(rig_fields(), {"outputs"}, rig);
  for (const ConfigMap& output : map.list("outputs")) {
    rig.outputs.push_back(read_output(output));
    try {
      check(rig);
    } catch (const std::invalid_argument& broken) {
      throw protocol::ConfigError(output.place(), broken.what());
    }
  }
  if (rig.outputs.empty()) throw map.error("outputs", "must list one output or more");
  return rig;
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}
std::string text_of(int value) {
  return std::to_string(value);
}
std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(const std::string& value) {
  return value;
}
template <class List>
std::string text_of(const List& list) {
  std::string out;
  for (const auto& item : list) out += (out.empty() ? "" : ", ") + text_of(item);
  return "[" + out + "]";
}

template <class Struct>
std::string describe_fields(const std::vector<Field<Struct>>& fields) {
  const Struct fallback{};
  std::vector<Row> rows;
  std::vector<std::string> defaults;
  for (const Field<Struct>& field : fields) {
    rows.push_back(field.row);
    defaults.push_back(
        std::visit([&](auto member) { return text_of(fallback.*member); }, field.member));
  }
  return protocol::describe(rows, defaults);
}

}  // namespace

Rig read_rig(const std::filesystem::path& path) {
  return read_map(ConfigMap::load(path));
}

Rig parse_rig(const std::string& text, const std::string& file_name) {
  return read_map(ConfigMap::parse(text, file_name));
}

std::string describe_rig_keys() {
  return "### A rig\n\n" + describe_fields(rig_fields()) + "\n### Each of `outputs`\n\n" +
         describe_fields(output_fields()) + "\n### `band` of an output\n\n" +
         describe_fields(band_fields()) + "\n### `tiles` of an output of that kind\n\n" +
         describe_fields(tile_fields()) + "\n### `stereo` of an output of that kind\n\n" +
         describe_fields(stereo_fields());
}

}  // namespace splash::synth
