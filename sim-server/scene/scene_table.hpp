// SPDX-License-Identifier: MIT
// Every key of a scene file, one row each, of keys/*.def. The reader, its error texts and the
// reference page in configs/README.md all come from these tables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

template <class Struct>
using Fields = std::vector<program::Field<Struct>>;

#define KEY(type, name, value, ...) type name = value;
#define SPELLED(type, name, value, ...)

/// A mesh: the file relative to the scene.
struct MeshEntry {
#include "sim-server/scene/keys/mesh.def"
};

/// A tracker's messages.
struct TrackerEntry {
#include "sim-server/scene/keys/tracker.def"
};

#undef KEY
#undef SPELLED
#define KEY(type, name, value, ...)
#define SPELLED(type, name, value, ...) type name##_spelled = value;

// Mappings as a file spells them: kinds are words, files relative to the scene, bodies names.

struct FluidEntry : FluidSettings {
#include "sim-server/scene/keys/fluid.def"
};

struct ShapeEntry : Shape {
#include "sim-server/scene/keys/shape.def"
};

struct MotionEntry : MotionSettings {
#include "sim-server/scene/keys/motion.def"
};

struct FrictionEntry : PairFriction {
#include "sim-server/scene/keys/friction.def"
};

struct WaterEntry : WaterBlock {
#include "sim-server/scene/keys/water.def"
};

struct FlowEntry : Flow {
#include "sim-server/scene/keys/flow.def"
};

struct GaugeEntry : GaugeSettings {
#include "sim-server/scene/keys/gauge.def"
};

#undef KEY
#undef SPELLED

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
/// The kinds of a body's motion by their names in scene files.
[[nodiscard]] const std::map<std::string, MotionKind>& motion_kinds();

/// What senders of the common kinds send, under the names of `preset`.
[[nodiscard]] const std::map<std::string, TrackerEntry>& tracker_presets();

}  // namespace splash::sim
