// SPDX-License-Identifier: MIT
// What a scene file says, as plain validated structs. SI units throughout. Read by
// scene/scene_reader; nothing here knows YAML, OpenCL or OSC.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim-server/scene/body_form.h"

namespace splash::sim {

using Vector3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< x y z w, unit

/// Where pressure comes from: sim-server/fluid.
enum class PressureKind { weakly_compressible, grid_projected };

/// Over how much water a particle's quantities are smoothed: sim-server/fluid/params/smoothing.hpp.

/// What of the water comes to rest before time begins: scene/support_state.hpp. automatic: what
/// something holds; always: all of it, wherever it flows meanwhile; never: none.
enum class SettleKind { automatic, always, never };

/// vector: as suits the device; reference: one particle at a time.
enum class KernelKind { vector, reference };

/// The water itself and the numbers of its solver.
struct FluidSettings {
  double spacing = 0.0;    ///< particle spacing [m]; 0: from `particles`
  int particles = 0;       ///< wanted number of particles; 0: from `spacing`
  double density = 998.0;  ///< at rest [kg/m3]
  PressureKind solver = PressureKind::weakly_compressible;
  KernelKind kernels = KernelKind::vector;
  SettleKind settle = SettleKind::automatic;
  double sound_speed = 0.0;     ///< of the weakly compressible model [m/s]; 0: from the scene
  double viscosity = 1.0e-6;    ///< kinematic [m2/s]
  double artificial = 0.1;      ///< Monaghan's artificial viscosity alpha [1]
  double time_step_factor = 1;  ///< multiplies the largest stable time step's safe share [1]
  Vector3 gravity = {0.0, 0.0, -9.81};  ///< [m/s2]
  /// Rates of a central field, along each axis: it accelerates by -pull^2 (x - pull_centre) [1/s].
  Vector3 pull = {0.0, 0.0, 0.0};
  Vector3 pull_centre = {0.0, 0.0, 0.0};  ///< [m]
};

/// A box open at the top. Its five sides are walls; spray may rise above `upper`.
struct Tank {
  Vector3 lower = {0.0, 0.0, 0.0};  ///< [m]
  Vector3 upper = {1.0, 1.0, 1.0};  ///< [m]
};

/// A sloped floor: rises from the tank's floor at x = `foot` by `gradient` towards +x.
struct Slope {
  bool present = false;
  double foot = 0.0;      ///< x where it leaves the floor [m]
  double gradient = 0.1;  ///< rise over run [1]
};

/// The wall at the smallest x moves as a piston: x = lower.x + stroke/2 (1 - cos(2 pi t/period)).
struct WaveMaker {
  bool present = false;
  double stroke = 0.1;  ///< front to back [m]
  double period = 2.0;  ///< [s]
};

/// How a tank that moves does so at one time.
struct TankSample {
  double time = 0.0;                       ///< [s]
  Vector3 acceleration = {0.0, 0.0, 0.0};  ///< of its pivot, in its own axes [m/s2]
  Vector3 spin = {0.0, 0.0, 0.0};          ///< in its own axes [rad/s]
};

/// A tank that is shaken, rocked or turned: scene/tank_motion.hpp has the formulas. All else in a
/// scene is told in the tank's axes.
struct TankMotionSettings {
  bool present = false;
  Vector3 pivot = {0.0, 0.0, 0.0};  ///< about which it turns [m]
  Vector3 sway = {0.0, 0.0, 0.0};   ///< amplitude along x y z [m]
  Vector3 roll = {0.0, 0.0, 0.0};   ///< amplitude about x y z [deg]
  double period = 2.0;              ///< of both [s]
  double ramp = 0.0;                ///< time in which they grow from nothing [s]
  std::vector<TankSample> samples;  ///< besides; in between along straight lines
};

enum class WaterForm { box, cylinder, sphere };

/// Water fills the form that touches the box between `lower` and `upper` from within, cut by the
/// tank, slope and bodies.
struct WaterBlock {
  Vector3 lower = {0.0, 0.0, 0.0};  ///< [m]
  Vector3 upper = {1.0, 1.0, 0.5};  ///< [m]
  WaterForm form = WaterForm::box;  ///< cylinder: along y
};

/// A wall across the tank at `x` that keeps the water on either side of it until time begins.
struct Gate {
  bool present = false;
  double x = 0.0;  ///< [m]
};

enum class FlowKind { none, uniform, strain, standing_wave, vortex };

/// How the water moves when time begins; scene/flow has the formulas.
struct Flow {
  FlowKind kind = FlowKind::none;
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< uniform [m/s]
  Vector3 centre = {0.0, 0.0, 0.0};    ///< strain: what stays where it is [m]
  double rate = 1.0;                   ///< strain [1/s]
  double amplitude = 0.01;             ///< standing_wave: height of the crest to come [m]
  int mode = 1;                        ///< standing_wave: half waves in the tank's length [1]
  double speed = 0.1;                  ///< vortex: the largest [m/s]
};

struct MeshSolid;

struct Shape {
  ShapeKind kind = ShapeKind::box;
  Vector3 size = {0.1, 0.1, 0.1};  ///< box: edges; sphere: diameters (equal); cylinder: diameter,
                                   ///< diameter, length along z; mesh: of the box around it [m]
  double rocker = 0.0;             ///< box only: the sole curves up at both x ends by this [m]
  double flat = 0.0;               ///< box only: this share of the sole's length, in the middle,
                                   ///< does not curve [1]
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
  bool smooth = true;                ///< script: cubic between keyframes, else straight lines
  bool repeat = false;               ///< script, csv, trc: start again at the end
  std::vector<Keyframe> keyframes;   ///< script
  std::filesystem::path file;        ///< csv, trc
  std::vector<std::string> markers;  ///< trc: at least three
  bool sole = false;                 ///< trc: a foot, its underside calibrated to the floor z = 0
  double start = 0.0;                ///< csv, trc: seconds of the recording that are skipped
  GapKind gap = GapKind::bridge;     ///< osc
  double gap_limit = 0.025;          ///< osc, bridge: so long the body goes on as it moved [s]
  double delay_limit = 0.030;        ///< osc: uneven poses are played up to so much later [s]
  CouplingKind coupling = CouplingKind::direct;  ///< osc
  double stiffness = 0.0;                        ///< spring: to the device [N/m]
  double damping = 0.0;                          ///< spring: of its damper [N s/m]
  double device_damping = 0.0;  ///< spring: that the device has, with the hand [N s/m]
  double hover = 0.0;           ///< touch, pressure: out of the water, above where it stands [m]
  double lift = 0.12;           ///< touch, pressure: it waits so far above the water [m]
  double fall = 1.0;            ///< touch, pressure: comes down so fast [m/s]
  double rise = 0.6;            ///< touch, pressure: and goes up so fast [m/s]
  double density = 0.0;         ///< free [kg/m3]; 0: from `mass`
  double mass = 0.0;            ///< free [kg]; 0: from `density`
  Vector3 velocity = {0.0, 0.0, 0.0};  ///< free: when time begins [m/s]
  Vector3 spin = {0.0, 0.0, 0.0};      ///< free: when time begins, in the world [rad/s]
  double restitution = 0.2;            ///< free: of its speed after a knock [1]
  double friction = 0.4;               ///< free: Coulomb's, on walls [1]
  Vector3 inertia = {0.0, 0.0, 0.0};   ///< free: moments about its own axes; 0: as if it were the
                                       ///< same everywhere [kg m2]
  int held = 0;  ///< free: bits of what it does not do: move along x y z, turn about x y z
};

/// Coulomb's coefficient between two bodies, of which at least one is free, or one and the walls.
struct PairFriction {
  int one = 0;            ///< index among the scene's bodies
  int other = -1;         ///< likewise; -1: the tank's walls, floor and slope
  double friction = 0.4;  ///< [1]
};

struct BodySettings {
  std::string name;
  Shape shape;
  bool cavity = true;                ///< it parts the water: air may be shut in behind it
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
  double impact_speed = 0.05;       ///< a body approaching the water slower makes no impact [m/s]
  double impact_lookahead = 0.015;  ///< an impact is announced this long before it happens [s]
  double impact_release = 0.006;    ///< way back and gap at which skin has left the water [m]
  bool impact_waves = false;        ///< water that comes to a body makes an impact, too
  double bubble_speed = 0.5;        ///< slower particles make no bubbles [m/s]
  double bubble_gradient = 0.25;    ///< least upward colour gradient, in that of a flat surface [1]
  bool bubble_per_particle =
      false;                   ///< the paper's rule: every particle that entraps air makes one
  double bubble_air = 10.0;    ///< air in the volume of water that entraps it, per metre [1/m]
  double bubble_energy = 0.0;  ///< share of the energy lost at the surface that lifts air; 0: the
                               ///< air is that of bubble_air [1]
  double bubble_eddy = 0.06;   ///< width of the eddies whose energy that is [m]
  double bubble_onset = 0.1;   ///< slower eddies fold nothing in [m/s]
  double bubbles_per_second = 4000.0;   ///< told at most, in larger ones if need be [1/s]
  double bubble_life = 0.5;             ///< a bubble particle is dropped after this [s]
  double radius_min = 0.003;            ///< bubble radii follow r^-radius_exponent [m]
  double radius_max = 0.030;            ///< [m]
  double radius_exponent = 10.0 / 3.0;  ///< Deane & Stokes 2002, above the Hinze scale [1]
  double epsilon_min = 0.01;            ///< excitations follow epsilon^-epsilon_exponent [1]
  double epsilon_max = 0.1;             ///< [1]
  double epsilon_exponent = 2.0;        ///< [1]
  bool cavity_by_count = false;         ///< the paper's rule: cavities are groups of bubbles
  double cavity_colour = 0.3;        ///< colour field c_b above which a bubble seeds a cavity [1]
  int cavity_bubbles_min = 5;        ///< N_b that is mapped to cavity_radius_min
  int cavity_bubbles_max = 100;      ///< N_b that is mapped to cavity_radius_max
  double cavity_radius_min = 0.020;  ///< of any cavity [m]
  double cavity_radius_max = 0.100;  ///< by the paper's rule [m]
};

enum class GaugeKind { height, pressure, velocity, front, body, energy, momentum, spread, cavity };

/// One probe of the water; sim-server/gauge says what each kind measures.
struct GaugeSettings {
  std::string name;
  GaugeKind kind = GaugeKind::height;
  double x = 0.0;                   ///< height: of the vertical line [m]
  double y = 0.0;                   ///< height [m]
  Vector3 place = {0.0, 0.0, 0.0};  ///< pressure, velocity; in the body's axes if it rides [m]
  Vector3 lower = {0.0, 0.0, 0.0};  ///< cavity: region that is searched [m]
  Vector3 upper = {1.0, 1.0, 1.0};  ///< cavity: its z is the level below which air is enclosed [m]
  std::size_t axis = 0;             ///< front: 0 or 1 for x or y
  double sign = 1.0;                ///< front: +1 or -1, the way it runs
  std::size_t body = 0;             ///< body, and what rides: index among the scene's
  bool rides = false;               ///< pressure, velocity: the place is fixed to `body`
  double radius = 0.0;              ///< pressure: of the sensor's face; 0: a point [m]
};

/// A sensor this near to a wall or a body is let into it [spacings].
inline constexpr double kLetIn = 0.25;

struct GaugesSettings {
  double rate = 0.0;  ///< samples per second; 0: one at the end of every frame [1/s]
  std::vector<GaugeSettings> probes;
};

/// What is left undone where a scene does not need it.
struct SkipSettings {
  bool sleep = true;         ///< water at rest is not moved
  double sleep_speed = 0.0;  ///< what counts as rest [m/s]; 0: as suits the solver
  double sleep_after = 1.0;  ///< for so long [s]
  bool idle = true;          ///< nothing at all is done while everything sleeps and nothing moves
  bool contacts = true;      ///< no look for impacts while no body is near the water
  bool bubbles = true;       ///< none for bubbles while no water is fast and no bubble lives
  bool cavities = true;      ///< none for cavities while none can close
  bool kernels = true;       ///< kernels are built without what the scene lacks
};

/// Pacing and sending.
struct ServeSettings {
  double frame_rate = 160.0;  ///< frames per second: detection, sending and pacing [1/s]
  double latency_ms = 15.0;   ///< bubbles and cavities are played this long after they happened
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
  int columns = 6;      ///< of tiles, along +x
  int rows = 6;         ///< along +y
  double tile = 0.305;  ///< edge of one [m]
  int sensors = 1;      ///< of a tile: 1, or 4 at its corners
  double load = 20.0;   ///< that puts a foot down [N]
};

/// Trackers other than /body/pose.
struct TrackingSettings {
  Vector3 position = {0.0, 0.0, 0.0};  ///< the senders' origin in the scene [m]
  double yaw = 0.0;                    ///< the senders' room is turned by this about z [deg]
  std::vector<TrackerSource> sources;
  FloorSettings floor;
};

struct Scene {
  std::string name;
  std::string description;
  int seed = 1;
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
