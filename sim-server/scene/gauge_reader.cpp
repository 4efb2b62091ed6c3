// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "sim-server/scene/mapping_readers.hpp"
#include "sim-server/scene/scene_rules.hpp"

namespace splash::sim {

namespace {

using program::ConfigMap;

void check_keys(const ConfigMap& map, const std::string& kind) {
  static const std::map<std::string, std::vector<std::string>> kNeeded = {
      {"height", {"x", "y"}}, {"pressure", {"place"}}, {"velocity", {"place"}},
      {"front", {"axis"}},    {"body", {"body"}},      {"cavity", {"lower", "upper"}}};
  if (const auto needed = kNeeded.find(kind); needed != kNeeded.end()) {
    for (const std::string& key : needed->second) {
      if (!map.has(key)) {
        throw map.error(key, "is missing: a gauge of kind " + kind + " needs it");
      }
    }
  }
  if (const auto* row = foreign_key(map, gauge_fields(), {kind})) {
    throw map.error(row->key, "has no meaning for a gauge of kind " + kind);
  }
}

/// Names become columns of a CSV file, with _ between name and quantity.
void check_name(const ConfigMap& map, const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (name.empty() || !plain) {
    throw map.error("name", "'" + name + "' must be letters, digits and _ and not empty");
  }
}

std::size_t find_body(const ConfigMap& map, const Scene& scene, const std::string& name) {
  std::string known;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].name == name) return b;
    known += (known.empty() ? "" : ", ") + scene.bodies[b].name;
  }
  throw map.error("body", "there is no body named '" + name +
                              "'; there are: " + (known.empty() ? "none" : known));
}

GaugeSettings read_gauge(const ConfigMap& map, const Scene& scene) {
  static const std::map<std::string, GaugeKind> kKinds = {
      {"height", GaugeKind::height},     {"pressure", GaugeKind::pressure},
      {"velocity", GaugeKind::velocity}, {"front", GaugeKind::front},
      {"body", GaugeKind::body},         {"energy", GaugeKind::energy},
      {"momentum", GaugeKind::momentum}, {"spread", GaugeKind::spread},
      {"cavity", GaugeKind::cavity}};
  GaugeEntry entry;
  map.read(gauge_fields(), {}, entry);
  check_name(map, entry.name);
  check_keys(map, entry.kind_spelled);
  entry.kind = kKinds.at(entry.kind_spelled);
  entry.sign = entry.axis_spelled.front() == '-' ? -1.0 : 1.0;
  entry.axis = static_cast<std::size_t>(entry.axis_spelled.back() - 'x');
  if (map.has("body")) {
    entry.body = find_body(map, scene, entry.body_spelled);
    entry.rides = entry.kind != GaugeKind::body;
  }
  check_gauge(map, entry, scene);
  return entry;
}

}  // namespace

GaugesSettings read_gauges(const ConfigMap& map, const Scene& scene) {
  GaugesSettings gauges;
  map.read(gauges_fields(), {"probes"}, gauges);
  std::set<std::string> names;
  for (const ConfigMap& entry : map.list("probes")) {
    gauges.probes.push_back(read_gauge(entry, scene));
    const std::string& name = gauges.probes.back().name;
    if (!names.insert(name).second) {
      throw entry.error("name", "there is another gauge named '" + name + "'");
    }
  }
  if (gauges.probes.empty()) throw map.error("probes", "name at least one, or leave out 'gauges'");
  return gauges;
}

}  // namespace splash::sim
