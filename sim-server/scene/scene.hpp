// SPDX-License-Identifier: MIT
// What a scene file says, as plain validated structs. SI units throughout. Read by
// scene/scene_reader; nothing here knows YAML, OpenCL or OSC.
// Each key of the file is declared once, in keys/*.def: KEY(type, name, default, the rest of its
// program::Row) is a member as well. SPELLED(...) is a key whose text the reader has to look up,
// such as an enumeration's word, a file or a body's name; the member that it sets stands here.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim-server/scene/body_form.h"

#define KEY(type, name, value, ...) type name = value;
#define SPELLED(type, name, value, ...)

namespace splash::sim {

using Vector3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< x y z w, unit

/// Where pressure comes from: sim-server/fluid.
enum class PressureKind { weakly_compressible, grid_projected };

/// What of the water comes to rest before time begins: scene/support_state.hpp. automatic: what
/// something holds; always: all of it, wherever it flows meanwhile; never: none.
enum class SettleKind { automatic, always, never };

/// vector: as suits the device; reference: one particle at a time.
enum class KernelKind { vector, reference };

/// The water itself and the numbers of its solver.
struct FluidSettings {
#include "sim-server/scene/keys/fluid.def"
  PressureKind solver = PressureKind::weakly_compressible;
  KernelKind kernels = KernelKind::vector;
  SettleKind settle = SettleKind::automatic;
};

/// A box open at the top. Its five sides are walls; spray may rise above `upper`.
struct Tank {
#include "sim-server/scene/keys/tank.def"
};

/// A sloped floor: rises from the tank's floor at x = `foot` by `gradient` towards +x.
struct Slope {
  bool present = false;
#include "sim-server/scene/keys/slope.def"
};

/// The wall at the smallest x moves as a piston: x = lower.x + stroke/2 (1 - cos(2 pi t/period)).
struct WaveMaker {
  bool present = false;
#include "sim-server/scene/keys/wave_maker.def"
};

/// How a tank that moves does so at one time.
struct TankSample {
#include "sim-server/scene/keys/tank_sample.def"
};

/// A tank that is shaken, rocked or turned: scene/tank_motion.hpp has the formulas. All else in a
/// scene is told in the tank's axes.
struct TankMotionSettings {
  bool present = false;
#include "sim-server/scene/keys/tank_motion.def"
  std::vector<TankSample> samples;  ///< besides; in between along straight lines
};

enum class WaterForm { box, cylinder, sphere };

/// Water fills the form that touches the box between `lower` and `upper` from within, cut by the
/// tank, slope and bodies.
struct WaterBlock {
#include "sim-server/scene/keys/water.def"
  WaterForm form = WaterForm::box;  ///< cylinder: along y
};

/// A wall across the tank at `x` that keeps the water on either side of it until time begins.
struct Gate {
  bool present = false;
#include "sim-server/scene/keys/gate.def"
};

enum class FlowKind { none, uniform, strain, standing_wave, vortex };

/// How the water moves when time begins; scene/flow has the formulas.
struct Flow {
  FlowKind kind = FlowKind::none;
#include "sim-server/scene/keys/flow.def"
};

struct MeshSolid;

struct Shape {
  ShapeKind kind = ShapeKind::box;
#include "sim-server/scene/keys/shape.def"
  std::shared_ptr<const MeshSolid> mesh = nullptr;  ///< mesh only: scene/mesh/mesh_solid.hpp
};

struct Keyframe {
  double time = 0.0;                           ///< [s]
  Vector3 position = {0.0, 0.0, 0.0};          ///< of the body's centre [m]
  Quaternion rotation = {0.0, 0.0, 0.0, 1.0};  ///< body to world
};

enum class MotionKind { fixed, script, csv, trc, osc, touch, pressure, free };

/// What a body does while its tracker is silent: goes on as it moved, for a while, or stays.
enum class GapKind { bridge, hold };

/// What a tracker's poses are to a body: where it is, or where a spring draws it.
enum class CouplingKind { direct, spring };

struct MotionSettings {
  MotionKind kind = MotionKind::fixed;
#include "sim-server/scene/keys/motion.def"
  std::vector<Keyframe> keyframes;               ///< script
  std::filesystem::path file;                    ///< csv, trc
  GapKind gap = GapKind::bridge;                 ///< osc
  CouplingKind coupling = CouplingKind::direct;  ///< osc
  double hover = 0.0;  ///< touch, pressure: out of the water, above where it stands [m]
  int held = 0;        ///< free: bits of what it does not do: move along x y z, turn about x y z
};

/// Coulomb's coefficient between two bodies, of which at least one is free, or one and the walls.
struct PairFriction {
  int one = 0;     ///< index among the scene's bodies
  int other = -1;  ///< likewise; -1: the tank's walls, floor and slope
#include "sim-server/scene/keys/friction.def"
};

struct BodySettings {
#include "sim-server/scene/keys/body.def"
  Shape shape;
  Keyframe rest;                     ///< pose at the start and, for fixed bodies, for ever
  Vector3 centre = {0.0, 0.0, 0.0};  ///< spring, mesh: of its mass, from its file's origin [m]
  MotionSettings motion;
};

/// Whether a floor that feels it moves the body: a foot, of which nothing is known while it is up.
[[nodiscard]] inline bool is_felt(const BodySettings& body) noexcept {
  return body.motion.kind == MotionKind::touch || body.motion.kind == MotionKind::pressure;
}
/// Whether the body hangs on a device by a spring.
[[nodiscard]] inline bool is_tied(const BodySettings& body) noexcept {
  return body.motion.kind == MotionKind::osc && body.motion.coupling == CouplingKind::spring;
}
/// Whether the water moves the body.
[[nodiscard]] inline bool is_free(const BodySettings& body) noexcept {
  return body.motion.kind == MotionKind::free || is_tied(body);
}
/// Whether the body has a motion of its own, from which poses can take it.
[[nodiscard]] inline bool is_grabbable(const BodySettings& body) noexcept {
  return !is_free(body) && !is_felt(body) && body.motion.kind != MotionKind::osc;
}
/// The wire numbers bodies from 0 to 255.
inline constexpr std::size_t kBodiesMax = 256;
/// So many bodies may be free at most.
inline constexpr int kFreeBodiesMax = 32;

/// Thresholds of the detectors; paper sections 4 and 5.
struct DetectSettings {
#include "sim-server/scene/keys/detect.def"
};

enum class GaugeKind { height, pressure, velocity, front, body, energy, momentum, spread, cavity };

/// One probe of the water; sim-server/gauge says what each kind measures.
struct GaugeSettings {
#include "sim-server/scene/keys/gauge.def"
  GaugeKind kind = GaugeKind::height;
  std::size_t axis = 0;  ///< front: 0 or 1 for x or y
  double sign = 1.0;     ///< front: +1 or -1, the way it runs
  std::size_t body = 0;  ///< body, and what rides: index among the scene's
  bool rides = false;    ///< pressure, velocity: the place is fixed to `body`
};

/// A sensor this near to a wall or a body is let into it [spacings].
inline constexpr double kLetIn = 0.25;

struct GaugesSettings {
#include "sim-server/scene/keys/gauges.def"
  std::vector<GaugeSettings> probes;
};

/// What is left undone where a scene does not need it.
struct SkipSettings {
#include "sim-server/scene/keys/skip.def"
};

/// Pacing and sending.
struct ServeSettings {
#include "sim-server/scene/keys/serve.def"
};

/// A tracker's messages and the body that they move. They give the body's pose as the sender sees
/// it; scene/tracking_reader has the words of each.
struct TrackerSource {
  std::size_t body = 0;                      ///< index among the scene's
  std::string name;                          ///< of the tracker, or of the source; empty: any
  std::array<double, 2> floor = {1.0, 1.0};  ///< tuio: size of the surface [m]
  std::string address;                       ///< OSC, of the messages with the position
  std::vector<std::string> match;            ///< what their first arguments are; empty: anything
  std::array<std::size_t, 3> position = {0, 1, 2};  ///< which arguments are x y z
  std::string rotation_address;                     ///< OSC, of those with the rotation
  std::vector<std::string> rotation_match;          ///< what their first arguments are
  std::vector<std::size_t> rotation;  ///< which arguments; 4: x y z w, 3: angles about x y z
  std::array<std::size_t, 3> order = {2, 0, 1};  ///< angles: axes in the order of the turns, fixed
  bool divided = false;                          ///< angles: that about y is triad_openvr's
  double angle = 1.0;                            ///< of the sender's unit of angle [rad]
  std::array<std::size_t, 3> axes = {0, 1, 2};   ///< the sender's axes that are the scene's x y z
  Vector3 signs = {1.0, 1.0, 1.0};               ///< their senses [1]
  double unit = 1.0;                             ///< of the sender's unit of length [m]
  Keyframe mount;  ///< the body on the tracker, in its axes after `axes`
};

/// A floor of tiles with force sensors, that says /tile/pressure.
struct FloorSettings {
  bool present = false;
#include "sim-server/scene/keys/floor.def"
};

/// Trackers other than /body/pose.
struct TrackingSettings {
#include "sim-server/scene/keys/tracking.def"
  std::vector<TrackerSource> sources;
  FloorSettings floor;
};

struct Scene {
#include "sim-server/scene/keys/scene.def"
  FluidSettings fluid;
  Tank tank;
  Slope slope;
  WaveMaker wave_maker;
  TankMotionSettings tank_motion;
  std::vector<WaterBlock> water;
  Gate gate;
  Flow flow;
  std::vector<BodySettings> bodies;
  std::vector<PairFriction> frictions;
  GaugesSettings gauges;
  DetectSettings detect;
  SkipSettings skip;
  ServeSettings serve;
  TrackingSettings tracking;
};

}  // namespace splash::sim

#undef KEY
#undef SPELLED
