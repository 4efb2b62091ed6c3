// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/free_float.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/bodies/skin.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

Vector3 Balance::all() const {
  return water + bodies;
}

void FreeFloat::add(const Shape& shape, double density, const BodyState& start) {
  const std::string name = "body " + std::to_string(scene.bodies.size());
  scene.bodies.push_back(body_of(name, shape, start));
  scene.bodies.back().motion.kind = MotionKind::free;
  scene.bodies.back().motion.density = density;
}

void FreeFloat::add_led(const Shape& shape, const BodyState& start) {
  add(shape, 1.0, start);
  scene.bodies.back().motion.kind = MotionKind::script;
}

void FreeFloat::start(Device& device) {
  auto particles = initial_particles(scene);
  // Nothing settles here: what is too near to a body would push it away.
  std::erase_if(particles, [this](const Vector3& x) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodySettings& body) {
      const Vector3 local = rotate(inverse(body.rest.rotation), x - body.rest.position);
      return distance_to(body.shape, local) < 0.5 * scene.fluid.spacing;
    });
  });
  const FluidParams params = make_params(scene, particles);
  const double support = scene_support(scene);
  std::vector<std::unique_ptr<Motion>> motions;
  for (const BodySettings& body : scene.bodies) {
    motions.push_back(std::make_unique<FreeMotion>(
        BodyState{body.rest.position, body.rest.rotation, body.motion.velocity, body.motion.spin}));
  }
  bodies = std::make_unique<Bodies>(sample_bodies(scene.bodies, scene.fluid.spacing, support),
                                    std::move(motions), support);
  const std::vector<BoundaryPoint> boundary(bodies->points().begin(), bodies->points().end());
  fluid = std::make_unique<Fluid>(device, params, particles, boundary, body_outlines(scene.bodies));
  fluid->release(free_bodies(scene.bodies), film_skins(scene.bodies, scene.fluid.spacing),
                 scene.frictions);
  steps = bodies->at(0.0);
  dt = largest_time_step(params, 3.0, 9.81, 1.0);
}

void FreeFloat::run(double seconds) {
  const double end = time + seconds - 0.5 * dt;
  while (time < end) {
    const Step step = {dt, 0.0, 0.0, 0};
    fluid->set_bodies(steps);
    fluid->prepare(step);
    fluid->advance(step);
    static_cast<void>(fluid->stats());
    const std::vector<FreeBodyEnd> ends = fluid->free_bodies()->ends();
    for (std::size_t k = 0; k < ends.size(); ++k) steps[k] = ends[k].step;
    for (std::size_t k = ends.size(); k < steps.size(); ++k) {
      BodyStep& led = steps[k];
      const auto way = static_cast<float>(dt) * led.vx;
      led.px += way;
      led.lower_x += way;
      led.upper_x += way;
    }
    time += dt;
  }
}

Balance FreeFloat::balance() {
  Balance sum;
  const std::vector<Vector3> places = places_of(*fluid);
  const std::vector<Vector3> velocities = velocities_of(*fluid);
  const auto mass = static_cast<double>(fluid->params().mass);
  const auto add = [&sum](double m, const Vector3& x, const Vector3& v, Vector3& to) {
    to = to + m * v;
    sum.turning = sum.turning + m * cross(x, v);
    sum.scale += m * length(v);
  };
  for (std::size_t i = 0; i < places.size(); ++i) add(mass, places[i], velocities[i], sum.water);
  for (std::size_t b = 0; b < steps.size(); ++b) {
    const BodyState s = state(b);
    const double m = mass_of(scene.bodies[b]);
    const Vector3 inertia = inertia_of(scene.bodies[b].shape, m);
    const Quaternion axes = compose(s.rotation, principal_axes(scene.bodies[b].shape));
    Vector3 spin = rotate(inverse(axes), s.spin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum.energy +=
          0.5 * (inertia[axis] * spin[axis] * spin[axis] + m * s.velocity[axis] * s.velocity[axis]);
      spin[axis] *= inertia[axis];
    }
    add(m, s.position, s.velocity, sum.bodies);
    sum.spin = sum.spin + rotate(axes, spin);
    sum.turning = sum.turning + rotate(axes, spin);
  }
  return sum;
}

}  // namespace splash::sim
