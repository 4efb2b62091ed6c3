// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/small_water.hpp"

#include <random>

#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {
namespace {

/// A body that moves as a formula says.
class FormulaMotion : public Motion {
 public:
  explicit FormulaMotion(std::function<BodyState(double)> formula) : formula_(std::move(formula)) {}
  [[nodiscard]] BodyState at(double seconds) const override { return formula_(seconds); }

 private:
  std::function<BodyState(double)> formula_;
};

std::vector<Vector3> by_id(const Snapshot& snapshot, const std::vector<float>& parts) {
  std::vector<Vector3> all(snapshot.id.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all.at(static_cast<std::size_t>(snapshot.id[i])) = vector_at(parts, parts.size() / 3, i);
  }
  return all;
}

}  // namespace

Scene tank_scene(double spacing, const Vector3& upper, double depth) {
  Scene scene;
  scene.name = "test";
  scene.fluid.spacing = spacing;
  scene.fluid.sound_speed = 15.0;
  scene.tank.lower = {0.0, 0.0, 0.0};
  scene.tank.upper = upper;
  scene.water = {{scene.tank.lower, {upper[0], upper[1], depth}}};
  return scene;
}

BodySettings body_of(const std::string& name, const Shape& shape, const BodyState& start) {
  BodySettings body;
  body.name = name;
  body.shape = shape;
  body.rest.position = start.position;
  body.rest.rotation = start.rotation;
  body.motion.velocity = start.velocity;
  body.motion.spin = start.spin;
  return body;
}

std::vector<Vector3> random_places(std::size_t count, const Vector3& lower, const Vector3& upper,
                                   unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vector3> places(count);
  for (Vector3& place : places) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Not std::uniform_real_distribution: its draws differ between libraries.
      const double share = static_cast<double>(random()) / 4294967296.0;
      place[axis] = lower[axis] + share * (upper[axis] - lower[axis]);
    }
  }
  return places;
}

void Water::start(Device& device, const KernelBuild& build) {
  params = make_params(scene, particles);
  const double support = scene_support(scene);
  std::vector<std::unique_ptr<Motion>> moved;
  for (const auto& motion : motions) moved.push_back(std::make_unique<FormulaMotion>(motion));
  bodies = std::make_unique<Bodies>(sample_bodies(scene.bodies, scene.fluid.spacing, support),
                                    std::move(moved), support);
  const std::vector<BoundaryPoint> boundary(bodies->points().begin(), bodies->points().end());
  fluid = std::make_unique<Fluid>(
      device, params, settle ? settled(scene, particles, scene_sound_speed(scene)) : particles,
      boundary, body_outlines(scene.bodies), build);
  time = 0.0;
}

void Water::stir(double speed, unsigned seed) {
  const auto velocities =
      random_places(particles.size(), {-speed, -speed, -speed}, {speed, speed, speed}, seed);
  change_particles(*fluid, [&](int id, Vector3&, Vector3& velocity) {
    velocity = velocities[static_cast<std::size_t>(id)];
  });
}

Step Water::step_at(double dt) const {
  return {dt, piston.offset, piston.speed, 0};
}

void Water::step(double dt, const std::function<void(Fluid&)>& between) {
  const Step step = step_at(dt);
  fluid->set_bodies(bodies->at(time));
  fluid->prepare(step);
  between(*fluid);
  fluid->advance(step);
  fluid->device().queue().finish();  // set_bodies writes without waiting: once a frame
  time += dt;
}

std::vector<Vector3> places_of(Fluid& fluid) {
  const Snapshot now = fluid.snapshot();
  return by_id(now, now.position);
}

std::vector<Vector3> velocities_of(Fluid& fluid) {
  const Snapshot now = fluid.snapshot();
  return by_id(now, now.velocity);
}

void change_particles(Fluid& fluid, const std::function<void(int, Vector3&, Vector3&)>& change) {
  Snapshot now = fluid.snapshot();
  const std::size_t stride = now.position.size() / 3;
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    Vector3 place = now.place(i);
    Vector3 velocity = vector_at(now.velocity, stride, i);
    change(now.id[i], place, velocity);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now.position[axis * stride + i] = static_cast<float>(place[axis]);
      now.velocity[axis * stride + i] = static_cast<float>(velocity[axis]);
    }
  }
  fluid.restore(now);
}

Water fill(const Scene& scene, PressureKind solver) {
  Water water = {.scene = scene, .particles = initial_particles(scene), .settle = true};
  water.scene.fluid.solver = solver;
  return water;
}

void run(Water& water, double seconds) {
  const double dt = largest_time_step(water.params, 3.0, 10.0, 1.0);
  const double end = water.time + seconds;
  while (water.time < end) water.step(dt);
}

void start_at_rest(Device& device, Water& water) {
  water.start(device);
  const double dt = largest_time_step(water.params, 0.0, 9.81, 1.0);
  settle(*water.fluid, {}, 0.0, 1.0, dt);
}

}  // namespace splash::sim
