// SPDX-License-Identifier: MIT
#include <type_traits>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {

namespace {

/// Zero stands for "not given" where it is outside the row's range, an empty list anywhere.
template <class Value>
bool is_default(const program::Row& row, const Value& value) {
  if (row.required) return false;
  if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
    return static_cast<double>(value) >= row.min;
  } else if constexpr (!std::is_same_v<Value, bool>) {
    return !value.empty();
  }
  return true;
}

/// The text of a row's default. Not inlined: where g++ 12 sees the object it warns of the variant's
/// alternatives that this struct cannot have.
template <class Struct>
[[gnu::noinline]] std::string default_text(const program::Field<Struct>& field, Struct& defaults) {
  return std::visit(
      [&](auto member) {
        auto& value = defaults.*member;
        return is_default(field.row, value) ? program::default_text(&value) : std::string();
      },
      field.member);
}

template <class Struct>
std::string section(const std::string& heading, const Fields<Struct>& fields) {
  Struct defaults;
  std::vector<program::Row> rows;
  std::vector<std::string> texts;
  for (const auto& field : fields) {
    rows.push_back(field.row);
    texts.push_back(default_text(field, defaults));
  }
  return heading + "\n\n" + program::describe(rows, texts) + "\n";
}

}  // namespace

std::string scene_reference() {
  return section("### At the top", scene_fields()) + section("### `fluid`", fluid_fields()) +
         section("### `tank`", tank_fields()) + section("### `slope` (optional)", slope_fields()) +
         section("### `wave_maker` (optional): the wall at the smallest x is a piston",
                 wave_maker_fields()) +
         section("### `tank_motion` (optional): the tank is shaken, rocked or turned",
                 tank_motion_fields()) +
         section("### `samples` of the tank's motion (optional): a list", tank_sample_fields()) +
         section("### `water`: a list", water_fields()) +
         section("### `gate` (optional): a wall that keeps water back until time begins",
                 gate_fields()) +
         section("### `flow` (optional): how the water moves when time begins", flow_fields()) +
         section("### `bodies`: a list", body_fields()) +
         section("### `shape` of a body", shape_fields()) +
         section("### or, in its place, a mesh", mesh_fields()) +
         section("### `rest` of a body (kinds `fixed`, `osc`, `touch`, `pressure` and `free`)",
                 rest_fields()) +
         section("### `motion` of a body (optional)", motion_fields()) +
         section("### `keyframes` of a scripted motion: a list", keyframe_fields()) +
         section("### `frictions` (optional): a list of pairs that rub in a way of their own",
                 friction_fields()) +
         section("### `gauges` (optional): what `--gauges FILE.csv` writes", gauges_fields()) +
         section("### `probes` of the gauges: a list", gauge_fields()) +
         section("### `detect` (optional)", detect_fields()) +
         section("### `skip` (optional)", skip_fields()) +
         section("### `serve` (optional)", serve_fields()) +
         section("### `tracking` (optional): trackers that do not send `/body/pose`",
                 tracking_fields()) +
         section("### `sources` of the tracking: a list", tracker_fields()) +
         section("### `floor` of the tracking (optional): tiles that feel weight", floor_fields()) +
         section("### `mount` of a source (optional): the body on its tracker", mount_fields());
}

}  // namespace splash::sim
