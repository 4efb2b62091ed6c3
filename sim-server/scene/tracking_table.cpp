// SPDX-License-Identifier: MIT
// The keys of `tracking`, and what common senders send.
#include "sim-server/scene/scene_table.hpp"

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

const Fields<TrackingSettings>& tracking_fields() {
  static const Fields<TrackingSettings> kFields = {
      {{.key = "position",
        .unit = "m",
        .meaning = "The senders' origin in the scene.",
        .min = -100,
        .max = 100},
       &TrackingSettings::position},
      {{.key = "yaw",
        .unit = "deg",
        .meaning = "The senders' room is turned by this about the scene's z, from x to y.",
        .min = -360,
        .max = 360},
       &TrackingSettings::yaw},
  };
  return kFields;
}

namespace {

constexpr double kLastArgument = 15.0;  // protocol/limits.hpp: 16 arguments

Fields<TrackerEntry> message_fields() {
  using T = TrackerEntry;
  std::vector<std::string> presets;
  for (const auto& [name, entry] : tracker_presets()) presets.push_back(name);
  return {
      {{.key = "body",
        .unit = "",
        .meaning = "Name of the body that the messages move; its motion is of kind osc, for tuio "
                   "of kind touch.",
        .required = true},
       &T::body},
      {{.key = "preset",
        .unit = "",
        .meaning = "A common sender, whose values stand for the keys below; those given here "
                   "replace them.",
        .choices = presets},
       &T::preset},
      {{.key = "name",
        .unit = "",
        .meaning = "What the sender calls the tracker: stands for {name} in the address and in "
                   "what is matched. tuio: the source whose cursors are meant; left out: any."},
       &T::name},
      {{.key = "address",
        .unit = "",
        .meaning = "OSC address of the messages with the position; a preset has one."},
       &T::address},
      {{.key = "match",
        .unit = "",
        .meaning = "First arguments of the messages that are meant, texts or whole numbers, where "
                   "one address serves several trackers."},
       &T::match},
      {{.key = "position",
        .unit = "1",
        .meaning = "Which arguments are x, y and z, counted from 0.",
        .min = 0,
        .max = kLastArgument},
       &T::position},
      {{.key = "rotation_address",
        .unit = "",
        .meaning = "The same of messages with the rotation; left out: those with the position."},
       &T::rotation_address},
      {{.key = "rotation_match",
        .unit = "",
        .meaning = "Their first arguments; left out: as `match`."},
       &T::rotation_match},
  };
}

Fields<TrackerEntry> number_fields() {
  using T = TrackerEntry;
  return {
      {{.key = "rotation",
        .unit = "1",
        .meaning = "Which arguments are the rotation: four of a quaternion x y z w, or three "
                   "angles about x, y and z; left out: the body stays as it rests.",
        .min = 0,
        .max = kLastArgument},
       &T::rotation},
      {{.key = "euler",
        .unit = "",
        .meaning = "Axes, fixed in the room, in the order in which the angles turn about them; "
                   "triad: xyz, and the angle about y is that of triad_openvr, whose tangent is "
                   "minus the right one's over the cosine of that about z.",
        .choices = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "triad"}},
       &T::euler},
      {{.key = "angles", .unit = "", .meaning = "Their unit.", .choices = {"degrees", "radians"}},
       &T::angles},
      {{.key = "axes",
        .unit = "",
        .meaning = "Which of the sender's axes are the scene's x, y and z, each with a - where it "
                   "runs the other way; rotations are mirrored along.",
        .choices = {}},
       &T::axes},
      {{.key = "unit",
        .unit = "m",
        .meaning = "The sender's unit of length; 0.001 where that is a millimetre.",
        .min = 1.0e-6,
        .max = 1000},
       &T::unit},
      {{.key = "floor",
        .unit = "m",
        .meaning = "tuio: width and depth of the surface, for which its coordinates are 1.",
        .min = 0.01,
        .max = 100},
       &T::floor},
  };
}

}  // namespace

const Fields<TrackerEntry>& tracker_fields() {
  static const Fields<TrackerEntry> kFields = [] {
    Fields<TrackerEntry> all = message_fields();
    const Fields<TrackerEntry> numbers = number_fields();
    all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
  }();
  return kFields;
}

const Fields<FloorSettings>& floor_fields() {
  using F = FloorSettings;
  static const Fields<F> kFields = {
      {{.key = "columns",
        .unit = "1",
        .meaning =
            "Tiles along x. Tile 0 has its corner at the `position` of the tracking; numbers "
            "grow along x, then row by row along y, as those of a rig.",
        .min = 1,
        .max = 64},
       &F::columns},
      {{.key = "rows", .unit = "1", .meaning = "Tiles along y.", .min = 1, .max = 64}, &F::rows},
      {{.key = "tile", .unit = "m", .meaning = "Edge of a tile.", .min = 0.01, .max = 10},
       &F::tile},
      {{.key = "sensors",
        .unit = "1",
        .meaning = "Of a tile: 1, or 4 at its corners at -x -y, +x -y, -x +y and +x +y.",
        .min = 1,
        .max = 4},
       &F::sensors},
      {{.key = "load",
        .unit = "N",
        .meaning = "Puts a foot down; half of it, and less, lifts it.",
        .min = 2,
        .max = 1000},
       &F::load},
  };
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
