// SPDX-License-Identifier: MIT
#include "sim-server/scene/scene_table.hpp"

#include "sim-server/scene/shape.hpp"

namespace splash::sim {

const Fields<Scene>& scene_fields() {
  static const Fields<Scene> kFields = {
      {{.key = "name",
        .unit = "",
        .meaning = "Short name for logs and reports; the file's name if left out."},
       &Scene::name},
      {{.key = "description", .unit = "", .meaning = "One sentence for people."},
       &Scene::description},
      {{.key = "seed",
        .unit = "1",
        .meaning = "Seed of every random draw: same scene, same seed, same events.",
        .min = 0,
        .max = 2147483647},
       &Scene::seed},
  };
  return kFields;
}

const Fields<Tank>& tank_fields() {
  static const Fields<Tank> kFields = {
      {{.key = "lower",
        .unit = "m",
        .meaning = "Corner with the smallest x y z; its z is the floor.",
        .min = -100,
        .max = 100,
        .required = true},
       &Tank::lower},
      {{.key = "upper",
        .unit = "m",
        .meaning = "Opposite corner; the top is open and spray may rise above it.",
        .min = -100,
        .max = 100,
        .required = true},
       &Tank::upper},
  };
  return kFields;
}

const Fields<Slope>& slope_fields() {
  static const Fields<Slope> kFields = {
      {{.key = "foot",
        .unit = "m",
        .meaning = "x at which the slope leaves the tank's floor.",
        .min = -100,
        .max = 100,
        .required = true},
       &Slope::foot},
      {{.key = "gradient",
        .unit = "1",
        .meaning = "Rise over run towards +x.",
        .min = 0.001,
        .max = 2},
       &Slope::gradient},
  };
  return kFields;
}

const Fields<WaveMaker>& wave_maker_fields() {
  static const Fields<WaveMaker> kFields = {
      {{.key = "stroke",
        .unit = "m",
        .meaning = "Way of the piston from back to front.",
        .min = 0.001,
        .max = 5},
       &WaveMaker::stroke},
      {{.key = "period", .unit = "s", .meaning = "Time of one wave.", .min = 0.2, .max = 60},
       &WaveMaker::period},
  };
  return kFields;
}

const Fields<TankMotionSettings>& tank_motion_fields() {
  using T = TankMotionSettings;
  static const Fields<T> kFields = {
      {{.key = "pivot",
        .unit = "m",
        .meaning = "Place in the tank about which it turns.",
        .min = -100,
        .max = 100},
       &T::pivot},
      {{.key = "sway",
        .unit = "m",
        .meaning = "Amplitudes along the tank's x y z: it goes there and back by sway sin(2 pi "
                   "t / period).",
        .min = -5,
        .max = 5},
       &T::sway},
      {{.key = "roll",
        .unit = "deg",
        .meaning = "Amplitudes of its turns about its own x y z: its angular velocity is the rate "
                   "of roll sin(2 pi t / period). About y it dips to larger x at first, about x to "
                   "smaller y.",
        .min = -90,
        .max = 90},
       &T::roll},
      {{.key = "period", .unit = "s", .meaning = "Of sway and roll.", .min = 0.05, .max = 3600},
       &T::period},
      {{.key = "ramp",
        .unit = "s",
        .meaning = "Sway and roll grow smoothly from nothing within this; 0: the tank and the "
                   "water in it move at once.",
        .min = 0,
        .max = 3600},
       &T::ramp},
  };
  return kFields;
}

const Fields<TankSample>& tank_sample_fields() {
  using T = TankSample;
  static const Fields<T> kFields = {
      {{.key = "time",
        .unit = "s",
        .meaning = "Later than the sample before. In between it is as on a straight line, before "
                   "the first and after the last one as in these.",
        .min = 0,
        .max = 86400,
        .required = true},
       &T::time},
      {{.key = "acceleration",
        .unit = "m/s2",
        .meaning = "Of the tank's pivot, in the tank's own axes. The water feels the opposite "
                   "acceleration, so "
                   "that this also describes gravity that changes in time.",
        .min = -100,
        .max = 100},
       &T::acceleration},
      {{.key = "spin",
        .unit = "rad/s",
        .meaning = "Angular velocity, in the tank's own axes.",
        .min = -50,
        .max = 50},
       &T::spin},
  };
  return kFields;
}

const Fields<BodySettings>& body_fields() {
  static const Fields<BodySettings> kFields = {
      {{.key = "name", .unit = "", .meaning = "Its name, unlike any other's.", .required = true},
       &BodySettings::name},
      {{.key = "cavity",
        .unit = "",
        .meaning = "false: water closes around it without a hollow behind it, as around a clean "
                   "wet ball slower than about 7 m/s; so it makes no cavity. Edges part the water.",
        .source = "Duez et al. 2007"},
       &BodySettings::cavity},
  };
  return kFields;
}

const Fields<ShapeEntry>& shape_fields() {
  using S = ShapeEntry;
  static const Fields<S> kFields = {
      {{.key = "kind", .unit = "", .meaning = "The form.", .choices = shape_names()},
       &S::kind_name},
      {{.key = "size",
        .unit = "m",
        .meaning = size_meanings() + ".",
        .min = 0.005,
        .max = 10,
        .required = true},
       &S::size},
      {{.key = "rocker",
        .unit = "m",
        .meaning = "box only: its underside curves up at both x ends by this, like a sole.",
        .min = 0,
        .max = 1},
       &S::rocker},
      {{.key = "flat",
        .unit = "1",
        .meaning = "box only: this share of the underside's length, in the middle, stays flat.",
        .min = 0,
        .max = 0.95},
       &S::flat},
  };
  return kFields;
}

const Fields<MeshEntry>& mesh_fields() {
  static const Fields<MeshEntry> kFields = {
      {{.key = "mesh",
        .unit = "",
        .meaning = "Triangles that enclose a solid, .obj or .stl, relative to the scene file. "
                   "Position and axes of the body are the file's; a free one turns about its "
                   "centre of mass, and that is what gauges tell of it.",
        .required = true},
       &MeshEntry::file_name},
      {{.key = "scale",
        .unit = "m",
        .meaning = "One unit of the file: 0.001 where that is a millimetre.",
        .min = 1.0e-6,
        .max = 1000},
       &MeshEntry::scale},
  };
  return kFields;
}

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

namespace {

Fields<MotionEntry> recorded_fields() {
  using M = MotionEntry;
  return {
      {{.key = "kind",
        .unit = "",
        .meaning = "fixed: stays at rest; script: keyframes; csv: poses from a file; trc: markers "
                   "from a file; osc: /body/pose messages; touch: a foot on a surface that "
                   "tells where it is touched; pressure: a foot on a floor that feels weight; "
                   "free: the water and gravity move it.",
        .choices = {"fixed", "script", "csv", "trc", "osc", "touch", "pressure", "free"}},
       &M::kind_name},
      {{.key = "smooth",
        .unit = "",
        .meaning = "script: no corner and no overshoot between keyframes; false: straight lines "
                   "at constant speed."},
       &M::smooth},
      {{.key = "repeat",
        .unit = "",
        .meaning = "script, csv, trc: start again at the end; the last pose must be the first."},
       &M::repeat},
      {{.key = "file",
        .unit = "",
        .meaning = "csv, trc: the recording, relative to the scene file. A trc body without one "
                   "needs --tracker FILE."},
       &M::file_name},
      {{.key = "markers",
        .unit = "",
        .meaning = "trc: three or more names of markers on the body. The first two give its x "
                   "axis (heel and toe of a foot)."},
       &M::markers},
      {{.key = "sole",
        .unit = "",
        .meaning = "trc: the body is a foot; its underside is calibrated from the stance so that "
                   "it touches the floor z = 0."},
       &M::sole},
      {{.key = "start",
        .unit = "s",
        .meaning = "csv, trc: seconds of the recording that are skipped.",
        .min = 0,
        .max = 86400},
       &M::start},
  };
}

Fields<MotionEntry> live_fields() {
  using M = MotionEntry;
  return {
      {{.key = "gap",
        .unit = "",
        .meaning = "osc: what the body does between poses and when they stay out: bridge, goes on "
                   "as it moved for gap_limit, then slows to a stop within 0.05 s; hold, is played "
                   "a pose later, so that it never goes beyond the last one, and stays there.",
        .choices = {"bridge", "hold"}},
       &M::gap_name},
      {{.key = "gap_limit",
        .unit = "s",
        .meaning = "osc, gap bridge: for how long the body goes on as it moved; two and a half "
                   "times the time between two poses where that is longer, up to 0.25 s.",
        .min = 0,
        .max = 1},
       &M::gap_limit},
      {{.key = "delay_limit",
        .unit = "s",
        .meaning = "osc: poses that arrive unevenly are played later by as much as evens nine of "
                   "ten of them out, but by no more than this; 0: always at once.",
        .min = 0,
        .max = 0.5},
       &M::delay_limit},
  };
}

Fields<MotionEntry> coupling_fields() {
  using M = MotionEntry;
  return {
      {{.key = "coupling",
        .unit = "",
        .meaning =
            "osc. direct: the body follows the poses, and /force is the force of the water on "
            "it. spring: the water moves the body, which a spring and a damper connect to "
            "the poses, and /force is the force of these two on the device. Walls stop "
            "such a body, and its device feels them.",
        .choices = {"direct", "spring"}},
       &M::coupling_name},
      {{.key = "stiffness",
        .unit = "N/m",
        .meaning = "coupling spring: of the spring. It turns the body with a stiffness that makes "
                   "it swing as fast about its centre.",
        .min = 1,
        .max = 1.0e5},
       &M::stiffness},
      {{.key = "damping",
        .unit = "N s/m",
        .meaning = "coupling spring: of the damper beside it.",
        .min = 0,
        .max = 1.0e4},
       &M::damping},
      {{.key = "device_damping",
        .unit = "N s/m",
        .meaning = "coupling spring: the least that the device and the hand on it have of their "
                   "own. No less than stiffness x (one and a half frames + delay_limit) + damping, "
                   "else the spring, which is felt so late, could give the hand energy.",
        .min = 0,
        .max = 1.0e4,
        .source = "Colgate & Schenkel 1997"},
       &M::device_damping},
  };
}

Fields<MotionEntry> felt_fields() {
  using M = MotionEntry;
  return {
      {{.key = "lift",
        .unit = "m",
        .meaning = "touch, pressure: so far above the water the foot waits for its next touch.",
        .min = 0,
        .max = 2},
       &M::lift},
      {{.key = "fall",
        .unit = "m/s",
        .meaning =
            "touch, pressure: when it is touched it comes down at this speed; its impacts "
            "are as fast. It begins a tenth of the particles' spacing above the water as the "
            "scene begins, higher where it would stand within a frame.",
        .min = 0.05,
        .max = 10},
       &M::fall},
      {{.key = "rise",
        .unit = "m/s",
        .meaning = "touch, pressure: and leaves at this one.",
        .min = 0.05,
        .max = 10},
       &M::rise},
  };
}

Fields<MotionEntry> free_fields() {
  using M = MotionEntry;
  return {
      {{.key = "density",
        .unit = "kg/m3",
        .meaning =
            "free, spring: of the body, the same everywhere in it. Give this or `mass`, not both.",
        .min = 0.1,
        .max = 1.0e6},
       &M::density},
      {{.key = "mass",
        .unit = "kg",
        .meaning = "free, spring: of the whole body.",
        .min = 1.0e-6,
        .max = 1.0e6},
       &M::mass},
      {{.key = "velocity",
        .unit = "m/s",
        .meaning = "free: when time begins.",
        .min = -100,
        .max = 100},
       &M::velocity},
      {{.key = "spin",
        .unit = "rad/s",
        .meaning = "free: angular velocity in the world when time begins.",
        .min = -1000,
        .max = 1000},
       &M::spin},
      {{.key = "restitution",
        .unit = "1",
        .meaning = "free, spring: part of its speed with which it rebounds from a wall or another "
                   "body; of two free ones the larger counts.",
        .min = 0,
        .max = 1},
       &M::restitution},
      {{.key = "friction",
        .unit = "1",
        .meaning =
            "free, spring: Coulomb's coefficient on walls and other bodies; of two free ones the "
            "geometric mean counts. `frictions` of the scene may say otherwise of a pair.",
        .min = 0,
        .max = 10},
       &M::friction},
      {{.key = "inertia",
        .unit = "kg m2",
        .meaning = "free, spring: moments of inertia about the body's own axes through its centre; "
                   "left out: those of a body that is the same everywhere.",
        .min = 1.0e-12,
        .max = 1.0e9},
       &M::inertia},
      {{.key = "held",
        .unit = "",
        .meaning = "free: what the body does not do, as on a rail or a hinge: x, y, z: move along "
                   "that axis of the tank; rx, ry, rz: turn about it. What holds it takes any "
                   "force. Not yet with the solver grid_projected."},
       &M::held_names},
  };
}

}  // namespace

const Fields<FrictionEntry>& friction_fields() {
  static const Fields<FrictionEntry> kFields = {
      {{.key = "between",
        .unit = "",
        .meaning = "Two names of bodies, one of them free; `walls` in place of one: the tank's "
                   "walls, floor and slope.",
        .required = true},
       &FrictionEntry::between},
      {{.key = "friction",
        .unit = "1",
        .meaning = "Coulomb's coefficient where these two touch, whatever they say of themselves.",
        .min = 0,
        .max = 10,
        .required = true},
       &FrictionEntry::friction},
  };
  return kFields;
}

const Fields<MotionEntry>& motion_fields() {
  static const Fields<MotionEntry> kFields = [] {
    Fields<MotionEntry> all = recorded_fields();
    for (const auto& part : {live_fields(), coupling_fields(), felt_fields(), free_fields()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return kFields;
}

}  // namespace splash::sim
