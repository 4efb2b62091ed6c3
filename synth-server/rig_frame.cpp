// SPDX-License-Identifier: MIT
#include "synth-server/rig_frame.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "program/config_file.hpp"
#include "protocol/time_tag.hpp"

namespace splash::synth {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(OutputKind kind) {
  switch (kind) {
    case OutputKind::tiles:
      return "tiles";
    case OutputKind::single:
      return "single";
    case OutputKind::worn:
      return "worn";
    case OutputKind::stereo:
      break;
  }
  return "stereo";
}

/// `place`: 0 at the left, 1 at the right.
Pan pan_at(double place) {
  const double angle = 0.5 * std::numbers::pi * place;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// Of an output's channel, from 0.
double place_of(const Output& output, int channel) {
  if (output.kind == OutputKind::stereo) return channel == 0 ? 0.0 : 1.0;
  if (output.kind != OutputKind::tiles || output.tiles_x < 2) return 0.5;
  return static_cast<double>(channel % output.tiles_x) / (output.tiles_x - 1);
}

}  // namespace

std::string describe_for_viewers(const Rig& rig, const Desk& desk, int sample_rate) {
  Json json;
  json["rig"] = rig.name;
  json["description"] = rig.description;
  json["sample_rate"] = sample_rate;
  json["outputs"] = Json::array();
  int first = 0;
  for (const Output& output : rig.outputs) {
    json["outputs"].push_back({{"name", output.name},
                               {"kind", name_of(output.kind)},
                               {"first", first},
                               {"channels", channel_count(output)},
                               {"body", output.body},
                               {"place", output.place},
                               {"tiles", {output.tiles_x, output.tiles_y}},
                               {"tile_size", output.tile_size},
                               {"width", output.width}});
    first += channel_count(output);
  }
  json["channels"] = channel_names(rig);
  json["rows"] = Json::array();
  for (const Knob& knob : desk.knobs()) {
    json["rows"].push_back({{"name", knob.name},
                            {"min", knob.min},
                            {"max", knob.max},
                            {"value", desk.get(knob.name).value_or(knob.min)},
                            {"logarithmic", knob.logarithmic},
                            {"unit", knob.unit},
                            {"meaning", knob.meaning}});
  }
  json["middle"] = nullptr;
  for (const Output& output : rig.outputs) {
    if (!output.has_place) json["middle"] = output.place;
  }
  for (const char* kind : {"rigs", "sounds"}) {
    json[kind] = Json::array();
    for (const auto& [name, description] : program::list_configs(kind)) {
      json[kind].push_back({{"name", name}, {"description", description}});
    }
  }
  // A name may have any bytes: those that are no UTF-8 are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

protocol::ViewFrame rig_frame(const Rig& rig, const Desk& desk, int sample_rate) {
  protocol::FrameWriter writer(protocol::kRigFrame, protocol::unix_now());
  writer.text(describe_for_viewers(rig, desk, sample_rate));
  return std::move(writer).take();
}

std::vector<Pan> pans_of(const Rig& rig) {
  std::vector<Pan> pans;
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) pans.push_back(pan_at(place_of(output, c)));
  }
  return pans;
}

}  // namespace splash::synth
