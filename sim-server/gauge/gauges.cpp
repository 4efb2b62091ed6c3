// SPDX-License-Identifier: MIT
#include "sim-server/gauge/gauges.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/air/air_cells.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/gauge/body_push.hpp"
#include "sim-server/gauge/face.hpp"
#include "sim-server/gauge/film_force.hpp"
#include "sim-server/gauge/sensors.hpp"
#include "sim-server/gauge/thrust.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> gauge();
}  // namespace kernels

namespace {

/// Frames end on time up to this [s].
constexpr double kSlack = 1.0e-9;

/// Radius over which a pressure sensor feels what is let into a wall or a body [supports].
constexpr double kFace = 1.0;

const std::vector<std::string>& quantities(GaugeKind kind) {
  static const std::map<GaugeKind, std::vector<std::string>> kNames = {
      {GaugeKind::height, {"height", "wetted"}},
      {GaugeKind::pressure, {"pressure"}},
      {GaugeKind::velocity, {"vx", "vy", "vz", "colour"}},
      {GaugeKind::front, {"front"}},
      {GaugeKind::body,
       {"x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz", "wx", "wy", "wz", "fx", "fy", "fz",
        "tx", "ty", "tz"}},
      {GaugeKind::energy, {"kinetic", "potential", "compression", "total"}},
      {GaugeKind::momentum, {"x", "y", "z", "fastest", "rms"}},
      {GaugeKind::spread, {"x", "y", "z", "sx", "sy", "sz"}},
      {GaugeKind::cavity, {"open", "enclosed", "pocket"}}};
  return kNames.at(kind);
}

bool needs_pressures(GaugeKind kind) {
  return kind == GaugeKind::pressure || kind == GaugeKind::body || kind == GaugeKind::energy;
}

template <class Values>
void append(std::vector<double>& row, const Values& values) {
  row.insert(row.end(), values.begin(), values.end());
}

/// True if the scene uses the grid solver, which computes the forces on bodies itself.
bool is_on_grid(const Scene& scene) {
  return scene.fluid.solver == PressureKind::grid_projected;
}

std::vector<BodyState> states_at(double seconds, const Bodies& bodies) {
  std::vector<BodyState> states;
  for (std::size_t b = 0; b < bodies.count(); ++b) states.push_back(bodies.state(b, seconds));
  return states;
}

/// The force of the water on a body that is not free, summed over the particles' pressures.
BodyForce force_on(std::size_t body, double seconds, const Scene& scene, const WaterState& water,
                   const Bodies& bodies) {
  const std::vector<BodyState> states = states_at(seconds, bodies);
  const auto owner = static_cast<int>(body);
  const BodyForce pushes = body_force(water, bodies.points(), owner, states[body]);
  const auto skin = film_skin(scene.bodies[body].shape, owner, water.spacing);
  const BodyForce film =
      film_force(water, {scene, tank_at(scene, seconds), states}, bodies.points(), skin, body);
  return {pushes.force + film.force, pushes.torque + film.torque};
}

void add_body(const GaugeSettings& probe, double seconds, const Scene& scene,
              const WaterState& water, const Bodies& bodies, std::vector<double>& row) {
  const BodyState state = bodies.state(probe.body, seconds);
  const bool is_known = bodies.is_free(probe.body) || is_on_grid(scene);
  const BodyForce force =
      is_known ? bodies.force(probe.body) : force_on(probe.body, seconds, scene, water, bodies);
  append(row, state.position);
  append(row, state.rotation);
  append(row, state.velocity);
  append(row, state.spin);
  append(row, force.force);
  append(row, force.torque);
}

/// Where a probe is now [m].
Vector3 place_of(const GaugeSettings& probe, double seconds, const Bodies& bodies) {
  if (!probe.rides) return probe.place;
  const BodyState body = bodies.state(probe.body, seconds);
  return body.position + rotate(body.rotation, probe.place);
}

double pressure_on(const std::optional<Face>& face, const Vector3& place, const Scene& scene,
                   const WaterState& water, const Bodies& bodies,
                   std::span<const BodyState> states) {
  // The grid's pressures are right up to the walls: particles there need not push on a face.
  if (is_on_grid(scene) || !face) return pressure_at(water, place);
  return thrust_on(*face, water, bodies.points(), states);
}

double pressure(const GaugeSettings& probe, double seconds, const Scene& scene,
                const WaterState& water, const Bodies& bodies) {
  const std::vector<BodyState> states = states_at(seconds, bodies);
  const double slope_from =
      scene.slope.present ? scene.slope.foot : std::numeric_limits<double>::infinity();
  const Surfaces surfaces = {tank_at(scene, seconds), slope_from, scene.bodies, states,
                             probe.rides ? static_cast<int>(probe.body) : -1};
  const auto face_of = [&](const Vector3& place) {
    return face_at(place, surfaces, kLetIn * water.spacing, kFace * water.support);
  };
  const Vector3 place = place_of(probe, seconds, bodies);
  const auto face = face_of(place);
  if (probe.radius == 0.0 || !face) {
    return pressure_on(face, place, scene, water, bodies, states);
  }
  double sum = 0.0;
  int count = 0;
  for (const Vector3& part : disc_on(*face, probe.radius, surfaces.tank)) {
    const auto around = face_of(part);
    if (!around) continue;  // beyond the body's edge
    sum += pressure_on(around, part, scene, water, bodies, states);
    ++count;
  }
  return sum / std::max(count, 1);
}

void add_cavity(const GaugeSettings& probe, double seconds, const Scene& scene,
                const WaterState& water, const Bodies& bodies, std::vector<double>& row) {
  const std::vector<BodyState> states = states_at(seconds, bodies);
  const auto solid = [&](const Vector3& place) {
    for (std::size_t b = 0; b < states.size(); ++b) {
      const Vector3 local = rotate(inverse(states[b].rotation), place - states[b].position);
      if (distance_to(scene.bodies[b].shape, local) < 0.0) return true;
    }
    return false;
  };
  const auto points = with_images(water.position, tank_at(scene, seconds), water.support);
  const Cavity cavity = find_cavity(points, water, probe.lower, probe.upper, solid);
  append(row, std::array{cavity.open, cavity.enclosed, cavity.pocket});
}

const Scene& with_probes(const Scene& scene) {
  if (!scene.gauges.probes.empty()) return scene;
  throw program::Failure(program::kExitConfig,
                         "the scene " + scene.name +
                             " names no gauges; add 'gauges:' with 'probes:' to it "
                             "(configs/README.md) or leave out --gauges");
}

program::WriteError cannot_write(const std::filesystem::path& path) {
  return {"cannot write gauges to " + path.string(), errno};
}

}  // namespace

WallPush::WallPush(Fluid& fluid)
    : push_by_walls_(build_program(fluid.device(), kernels::gauge(), {}), "push_by_walls"),
      push_(fluid.device(), 3 * static_cast<std::size_t>(fluid.params().capacity)) {}

std::vector<Vector3> WallPush::read(Fluid& fluid, const Step& step) {
  push_by_walls_.run(fluid.device().queue(), fluid.groups(),
                     {{"p", fluid.params_buffer()},
                      {"position", fluid.particles().position},
                      {"pressure_term", fluid.pressure_term()},
                      {"piston", static_cast<float>(step.piston)},
                      {"push", push_}});
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  return as_vectors(push_.read(fluid.device(), 3 * stride), stride,
                    static_cast<std::size_t>(fluid.params().count));
}

Gauges::Gauges(const Scene& scene) : scene_(scene), columns_({"time"}) {
  for (const GaugeSettings& probe : scene_.gauges.probes) {
    for (const std::string& quantity : quantities(probe.kind)) {
      columns_.push_back(probe.name + "_" + quantity);
    }
    pressures_ = pressures_ || needs_pressures(probe.kind);
  }
}

bool Gauges::is_due(double seconds) const noexcept {
  return seconds >= next_ - kSlack;
}

std::vector<double> Gauges::read(double seconds, Fluid& fluid, const Bodies& bodies) {
  if (scene_.gauges.rate > 0.0) {
    // From the clock's beginning, not from the last sample: frames do not add up to periods.
    next_ = (std::floor(seconds * scene_.gauges.rate + 1.0e-6) + 1.0) / scene_.gauges.rate;
  }
  if (!pressures_) return read(seconds, read_water(fluid, false), bodies);
  const PistonState piston = piston_at(scene_.wave_maker, seconds);
  const Step now = {0.0, piston.offset, piston.speed, 0};
  fluid.set_bodies(bodies.at(seconds));
  fluid.prepare(now);
  WaterState water = read_water(fluid, true);
  if (!wall_push_) wall_push_.emplace(fluid);
  water.wall_push = wall_push_->read(fluid, now);
  return read(seconds, water, bodies);
}

std::vector<double> Gauges::read(double seconds, const WaterState& water,
                                 const Bodies& bodies) const {
  std::vector<double> row = {seconds};
  for (const GaugeSettings& probe : scene_.gauges.probes) {
    add(probe, seconds, water, bodies, row);
  }
  return row;
}

void Gauges::add(const GaugeSettings& probe, double seconds, const WaterState& water,
                 const Bodies& bodies, std::vector<double>& row) const {
  const Tank tank = tank_at(scene_, seconds);
  switch (probe.kind) {
    case GaugeKind::height: {
      const auto near = near_line(water.position, probe.x, probe.y, water.support);
      const Height height = water_height(with_images(near, tank, water.support), water, probe.x,
                                         probe.y, floor_height(scene_, probe.x));
      append(row, std::array{height.top, height.wetted});
      break;
    }
    case GaugeKind::pressure:
      row.push_back(pressure(probe, seconds, scene_, water, bodies));
      break;
    case GaugeKind::velocity: {
      const FlowAt flow = flow_at(water, place_of(probe, seconds, bodies));
      append(row, flow.velocity);
      row.push_back(flow.colour);
      break;
    }
    case GaugeKind::front: {
      const std::size_t across = 1 - probe.axis;
      row.push_back(
          front_position(water, probe.axis, probe.sign, tank.upper[across] - tank.lower[across]));
      break;
    }
    case GaugeKind::body:
      add_body(probe, seconds, scene_, water, bodies, row);
      break;
    case GaugeKind::energy: {
      const Energies e = energies(water);
      append(row, std::array{e.kinetic, e.potential, e.compression, e.total()});
      break;
    }
    case GaugeKind::momentum: {
      const Momentum m = momentum(water);
      append(row, m.sum);
      append(row, std::array{m.fastest, m.rms});
      break;
    }
    case GaugeKind::spread: {
      const Spread s = spread(water);
      append(row, s.centre);
      append(row, s.deviation);
      break;
    }
    case GaugeKind::cavity:
      add_cavity(probe, seconds, scene_, water, bodies, row);
      break;
  }
}

template <class Values>
void GaugeFile::write(const Values& values) {
  const char* separator = "";
  for (const auto& value : values) out_ << std::exchange(separator, ",") << value;
  out_ << std::endl;  // so that what follows is lines, whoever reads along
  if (!out_) throw cannot_write(path_);
}

GaugeFile::GaugeFile(const std::filesystem::path& path, const Scene& scene)
    : path_(path), gauges_(with_probes(scene)) {
  reopen();
}

void GaugeFile::reopen() {
  errno = 0;
  out_ = std::ofstream(path_);
  out_.precision(9);
  write(gauges_.columns());
}

void GaugeFile::note(double seconds, Fluid& fluid, const Bodies& bodies) {
  if (!gauges_.is_due(seconds)) return;
  errno = 0;
  write(gauges_.read(seconds, fluid, bodies));
}

}  // namespace splash::sim
