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

const Fields<Scene>& scene_fields() {
  using Struct = Scene;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/scene.def"
  };
  return kFields;
}

const Fields<FluidEntry>& fluid_fields() {
  using Struct = FluidEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/fluid.def"
  };
  return kFields;
}

const Fields<Tank>& tank_fields() {
  using Struct = Tank;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/tank.def"
  };
  return kFields;
}

const Fields<Slope>& slope_fields() {
  using Struct = Slope;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/slope.def"
  };
  return kFields;
}

const Fields<WaveMaker>& wave_maker_fields() {
  using Struct = WaveMaker;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/wave_maker.def"
  };
  return kFields;
}

const Fields<TankMotionSettings>& tank_motion_fields() {
  using Struct = TankMotionSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/tank_motion.def"
  };
  return kFields;
}

const Fields<TankSample>& tank_sample_fields() {
  using Struct = TankSample;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/tank_sample.def"
  };
  return kFields;
}

const Fields<WaterEntry>& water_fields() {
  using Struct = WaterEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/water.def"
  };
  return kFields;
}

const Fields<Gate>& gate_fields() {
  using Struct = Gate;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/gate.def"
  };
  return kFields;
}

const Fields<FlowEntry>& flow_fields() {
  using Struct = FlowEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/flow.def"
  };
  return kFields;
}

const Fields<BodySettings>& body_fields() {
  using Struct = BodySettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/body.def"
  };
  return kFields;
}

const Fields<ShapeEntry>& shape_fields() {
  using Struct = ShapeEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/shape.def"
  };
  return kFields;
}

const Fields<MeshEntry>& mesh_fields() {
  using Struct = MeshEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/mesh.def"
  };
  return kFields;
}

const Fields<MotionEntry>& motion_fields() {
  using Struct = MotionEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/motion.def"
  };
  return kFields;
}

const Fields<FrictionEntry>& friction_fields() {
  using Struct = FrictionEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/friction.def"
  };
  return kFields;
}

const Fields<GaugesSettings>& gauges_fields() {
  using Struct = GaugesSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/gauges.def"
  };
  return kFields;
}

const Fields<GaugeEntry>& gauge_fields() {
  using Struct = GaugeEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/gauge.def"
  };
  return kFields;
}

const Fields<DetectSettings>& detect_fields() {
  using Struct = DetectSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/detect.def"
  };
  return kFields;
}

const Fields<SkipSettings>& skip_fields() {
  using Struct = SkipSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/skip.def"
  };
  return kFields;
}

const Fields<ServeSettings>& serve_fields() {
  using Struct = ServeSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/serve.def"
  };
  return kFields;
}

const Fields<TrackingSettings>& tracking_fields() {
  using Struct = TrackingSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/tracking.def"
  };
  return kFields;
}

const Fields<TrackerEntry>& tracker_fields() {
  using Struct = TrackerEntry;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/tracker.def"
  };
  return kFields;
}

const Fields<FloorSettings>& floor_fields() {
  using Struct = FloorSettings;
  static const Fields<Struct> kFields = {
#include "sim-server/scene/keys/floor.def"
  };
  return kFields;
}

#undef KEY
#undef SPELLED

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
