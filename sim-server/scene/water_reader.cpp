// SPDX-License-Identifier: MIT
#include <map>

#include "sim-server/scene/mapping_readers.hpp"
#include "sim-server/scene/scene_rules.hpp"

namespace splash::sim {

namespace {

using program::ConfigMap;

WaterBlock read_block(const ConfigMap& map) {
  static const std::map<std::string, WaterForm> kForms = {
      {"box", WaterForm::box}, {"cylinder", WaterForm::cylinder}, {"sphere", WaterForm::sphere}};
  WaterEntry entry;
  map.read(water_fields(), {}, entry);
  entry.form = kForms.at(entry.form_spelled);
  return entry;
}

}  // namespace

void read_water(const ConfigMap& map, Scene& scene) {
  for (const ConfigMap& entry : map.list("water")) {
    const WaterBlock block = read_block(entry);
    check_water(entry, block, scene);
    scene.water.push_back(block);
  }
  if (scene.water.empty()) throw map.error("water", "the scene needs at least one block of water");
  if (const auto gate = map.optional_child("gate")) {
    gate->read(gate_fields(), {}, scene.gate);
    scene.gate.present = true;
    check_gate(*gate, scene);
  }
}

void read_flow(const ConfigMap& map, Scene& scene) {
  static const std::map<std::string, FlowKind> kKinds = {{"uniform", FlowKind::uniform},
                                                         {"strain", FlowKind::strain},
                                                         {"standing_wave", FlowKind::standing_wave},
                                                         {"vortex", FlowKind::vortex}};
  const auto flow = map.optional_child("flow");
  if (!flow) return;
  FlowEntry entry;
  flow->read(flow_fields(), {}, entry);
  if (const auto* row = foreign_key(*flow, flow_fields(), {entry.kind_spelled})) {
    throw flow->error(row->key, "has no meaning for a flow of kind " + entry.kind_spelled);
  }
  entry.kind = kKinds.at(entry.kind_spelled);
  scene.flow = entry;
}

}  // namespace splash::sim
