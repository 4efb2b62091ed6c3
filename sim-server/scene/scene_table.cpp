// SPDX-License-Identifier: MIT
#include "sim-server/scene/scene_table.hpp"

#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/step_policy.hpp"

namespace splash::sim {

const std::map<std::string, TrackerEntry>& tracker_presets() {
  static const std::vector<std::string> kUnity = {"z", "-x", "y"};  // x right, y up, z ahead
  static const std::vector<std::string> kUpIsY = {"x", "-z", "y"};  // right-handed, y up
  static const std::map<std::string, TrackerEntry> kPresets = {
      // https://protocol.vmc.info: trackers, controllers and the headset by their serial.
      {"vmc",
       {.address = "/VMC/Ext/Tra/Pos",
        .match = {"{name}"},
        .position = {1, 2, 3},
        .rotation = {4, 5, 6, 7},
        .axes = kUnity}},
      // https://docs.vrchat.com/docs/osc-trackers: 1 to 8 or head; Unity turns about z, x, y.
      {"vrchat",
       {.address = "/tracking/trackers/{name}/position",
        .rotation_address = "/tracking/trackers/{name}/rotation",
        .rotation = {0, 1, 2},
        .euler = "zxy",
        .axes = kUnity}},
      // https://github.com/icq4ever/natnet2osc: z is the height.
      {"natnet2osc",
       {.address = "/rigidbody/{name}/location3d",
        .rotation_address = "/rigidbody/{name}/orientation",
        .rotation = {0, 1, 2, 3}}},
      // https://github.com/tecartlab/app_NatNetThree2OSC, its mode max: Motive's axes.
      {"natnetthree2osc",
       {.address = "/rigidbody",
        .match = {"{name}", "position"},
        .position = {2, 3, 4},
        .rotation_match = {"{name}", "quat"},
        .rotation = {2, 3, 4, 5},
        .axes = kUpIsY}},
      // https://github.com/BarakChamo/OpenVR-OSC: an array of a place, yaw, pitch and roll; right,
      // up, back.
      {"openvr-osc",
       {.address = "/tracker/{name}",
        .rotation = {5, 4, 3},
        .euler = "triad",
        .axes = {"-z", "-x", "y"}}},
      // https://www.tuio.org: TUIO 1.1, a surface seen from above with y towards its front edge.
      {"tuio", {.address = "/tuio/2Dcur", .match = {"set"}, .axes = {"x", "-y", "z"}}},
  };
  return kPresets;
}

const std::map<std::string, MotionKind>& motion_kinds() {
  static const std::map<std::string, MotionKind> kKinds = {
      {"fixed", MotionKind::fixed}, {"script", MotionKind::script},    {"csv", MotionKind::csv},
      {"trc", MotionKind::trc},     {"osc", MotionKind::osc},          {"free", MotionKind::free},
      {"touch", MotionKind::touch}, {"pressure", MotionKind::pressure}};
  return kKinds;
}

namespace {

constexpr double kLastArgument = 15.0;  // protocol/limits.hpp: 16 arguments

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const auto& [name, entry] : tracker_presets()) names.push_back(name);
  return names;
}

}  // namespace

#define KEY(type, name, value, ...) {{.key = #name, __VA_ARGS__}, &Struct::name},
#define SPELLED(type, name, value, ...) {{.key = #name, __VA_ARGS__}, &Struct::name##_spelled},
// The function `name`_fields(), around the keys of its struct.
#define FIELDS(type, name)              \
  const Fields<type>& name##_fields() { \
    using Struct = type;                \
    static const Fields<Struct> kFields = {
#define END_OF_FIELDS \
  }                   \
  ;                   \
  return kFields;     \
  }

FIELDS(Scene, scene)
#include "sim-server/scene/keys/scene.def"
END_OF_FIELDS

FIELDS(FluidEntry, fluid)
#include "sim-server/scene/keys/fluid.def"
END_OF_FIELDS

FIELDS(Tank, tank)
#include "sim-server/scene/keys/tank.def"
END_OF_FIELDS

FIELDS(Slope, slope)
#include "sim-server/scene/keys/slope.def"
END_OF_FIELDS

FIELDS(WaveMaker, wave_maker)
#include "sim-server/scene/keys/wave_maker.def"
END_OF_FIELDS

FIELDS(TankMotionSettings, tank_motion)
#include "sim-server/scene/keys/tank_motion.def"
END_OF_FIELDS

FIELDS(TankSample, tank_sample)
#include "sim-server/scene/keys/tank_sample.def"
END_OF_FIELDS

FIELDS(WaterEntry, water)
#include "sim-server/scene/keys/water.def"
END_OF_FIELDS

FIELDS(Gate, gate)
#include "sim-server/scene/keys/gate.def"
END_OF_FIELDS

FIELDS(FlowEntry, flow)
#include "sim-server/scene/keys/flow.def"
END_OF_FIELDS

FIELDS(BodySettings, body)
#include "sim-server/scene/keys/body.def"
END_OF_FIELDS

FIELDS(ShapeEntry, shape)
#include "sim-server/scene/keys/shape.def"
END_OF_FIELDS

FIELDS(MeshEntry, mesh)
#include "sim-server/scene/keys/mesh.def"
END_OF_FIELDS

FIELDS(MotionEntry, motion)
#include "sim-server/scene/keys/motion.def"
END_OF_FIELDS

FIELDS(FrictionEntry, friction)
#include "sim-server/scene/keys/friction.def"
END_OF_FIELDS

FIELDS(GaugesSettings, gauges)
#include "sim-server/scene/keys/gauges.def"
END_OF_FIELDS

FIELDS(GaugeEntry, gauge)
#include "sim-server/scene/keys/gauge.def"
END_OF_FIELDS

FIELDS(DetectSettings, detect)
#include "sim-server/scene/keys/detect.def"
END_OF_FIELDS

FIELDS(SkipSettings, skip)
#include "sim-server/scene/keys/skip.def"
END_OF_FIELDS

FIELDS(ServeSettings, serve)
#include "sim-server/scene/keys/serve.def"
END_OF_FIELDS

FIELDS(TrackingSettings, tracking)
#include "sim-server/scene/keys/tracking.def"
END_OF_FIELDS

FIELDS(TrackerEntry, tracker)
#include "sim-server/scene/keys/tracker.def"
END_OF_FIELDS

FIELDS(FloorSettings, floor)
#include "sim-server/scene/keys/floor.def"
END_OF_FIELDS

#undef KEY
#undef SPELLED
#undef FIELDS
#undef END_OF_FIELDS

namespace {

program::Field<Keyframe> position_field(bool required) {
  return {{.key = "position",
           .unit = "m",
           .meaning = "Of the body's centre; of a mesh's origin.",
           .min = -100,
           .max = 100,
           .required = required},
          &Keyframe::position};
}

program::Field<Keyframe> rotation_field() {
  return {{.key = "rotation",
           .unit = "1",
           .meaning = "Quaternion x y z w, body to world; brought to unit length.",
           .min = -1,
           .max = 1},
          &Keyframe::rotation};
}

}  // namespace

const Fields<Keyframe>& rest_fields() {
  static const Fields<Keyframe> kFields = {position_field(true), rotation_field()};
  return kFields;
}

const Fields<Keyframe>& keyframe_fields() {
  static const Fields<Keyframe> kFields = {{{.key = "time",
                                             .unit = "s",
                                             .meaning = "Later than the keyframe before.",
                                             .min = 0,
                                             .max = 86400,
                                             .required = true},
                                            &Keyframe::time},
                                           position_field(true),
                                           rotation_field()};
  return kFields;
}

const Fields<Keyframe>& mount_fields() {
  static const Fields<Keyframe> kFields = {
      {{.key = "position",
        .unit = "m",
        .meaning = "The body's centre from the tracker's, along the tracker's axes as `axes` "
                   "names them.",
        .min = -10,
        .max = 10},
       &Keyframe::position},
      {{.key = "rotation",
        .unit = "1",
        .meaning = "Quaternion x y z w, body to tracker; brought to unit length.",
        .min = -1,
        .max = 1},
       &Keyframe::rotation},
  };
  return kFields;
}

}  // namespace splash::sim
