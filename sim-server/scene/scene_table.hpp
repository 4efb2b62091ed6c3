// SPDX-License-Identifier: MIT
// Every key of a scene file, one row each. The reader, its error texts and the reference page in
// configs/README.md all come from these tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

template <class Struct>
using Fields = std::vector<program::Field<Struct>>;

/// The fluid as its mapping spells it.
struct FluidEntry : FluidSettings {
  std::string solver_name = "auto";
  std::string kernels_name = "vector";
  std::string settle_name = "auto";
};

/// A shape as its mapping spells it: the kind is still a word.
struct ShapeEntry : Shape {
  std::string kind_name = "box";
};

/// A mesh as its mapping spells it: the file relative to the scene.
struct MeshEntry {
  std::string file_name;
  double scale = 1.0;  ///< [m per unit of the file]
};

/// A motion as its mapping spells it: the kind is still a word, the file relative to the scene.
struct MotionEntry : MotionSettings {
  std::string kind_name = "fixed";
  std::string file_name;
  std::string gap_name = "bridge";
  std::string coupling_name = "direct";
  std::vector<std::string> held_names = {};
};

/// Friction between two as its mapping spells it.
struct FrictionEntry : PairFriction {
  std::vector<std::string> between = {};
};

/// Water as its mapping spells it: the form is still a word.
struct WaterEntry : WaterBlock {
  std::string form_name = "box";
};

/// A flow as its mapping spells it.
struct FlowEntry : Flow {
  std::string kind_name;
};

/// A gauge as its mapping spells it: kind, axis and body are still words.
struct GaugeEntry : GaugeSettings {
  std::string kind_name;
  std::string axis_name = "x";
  std::string body_name;
};

/// A tracker's messages as their mapping spells them.
struct TrackerEntry {
  std::string body = {};
  std::string preset = {};
  std::string name = {};
  std::string address = {};
  std::vector<std::string> match = {};
  std::vector<double> position = {0, 1, 2};
  std::string rotation_address = {};
  std::vector<std::string> rotation_match = {};
  std::vector<double> rotation = {};
  std::string euler = "xyz";
  std::string angles = "degrees";
  std::vector<std::string> axes = {"x", "y", "z"};
  double unit = 1.0;
  std::vector<double> floor = {};
};

[[nodiscard]] const Fields<Scene>& scene_fields();
[[nodiscard]] const Fields<FluidEntry>& fluid_fields();
[[nodiscard]] const Fields<Tank>& tank_fields();
[[nodiscard]] const Fields<Slope>& slope_fields();
[[nodiscard]] const Fields<WaveMaker>& wave_maker_fields();
[[nodiscard]] const Fields<TankMotionSettings>& tank_motion_fields();
[[nodiscard]] const Fields<TankSample>& tank_sample_fields();
[[nodiscard]] const Fields<WaterEntry>& water_fields();
[[nodiscard]] const Fields<Gate>& gate_fields();
[[nodiscard]] const Fields<FlowEntry>& flow_fields();
[[nodiscard]] const Fields<BodySettings>& body_fields();
[[nodiscard]] const Fields<ShapeEntry>& shape_fields();
[[nodiscard]] const Fields<MeshEntry>& mesh_fields();
[[nodiscard]] const Fields<Keyframe>& rest_fields();
[[nodiscard]] const Fields<Keyframe>& keyframe_fields();
[[nodiscard]] const Fields<MotionEntry>& motion_fields();
[[nodiscard]] const Fields<FrictionEntry>& friction_fields();
[[nodiscard]] const Fields<GaugesSettings>& gauges_fields();
[[nodiscard]] const Fields<GaugeEntry>& gauge_fields();
[[nodiscard]] const Fields<DetectSettings>& detect_fields();
[[nodiscard]] const Fields<SkipSettings>& skip_fields();
[[nodiscard]] const Fields<ServeSettings>& serve_fields();
[[nodiscard]] const Fields<TrackingSettings>& tracking_fields();
[[nodiscard]] const Fields<TrackerEntry>& tracker_fields();
[[nodiscard]] const Fields<FloorSettings>& floor_fields();
[[nodiscard]] const Fields<Keyframe>& mount_fields();
/// What senders of the common kinds send, under the names of `preset`.
[[nodiscard]] const std::map<std::string, TrackerEntry>& tracker_presets();

}  // namespace splash::sim
