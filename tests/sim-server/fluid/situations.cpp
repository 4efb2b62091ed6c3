// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/situations.hpp"

#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::sim {
namespace {

constexpr double kSpacing = 0.02;

/// A count that is neither a multiple of 4 nor of 16.
void make_odd(std::vector<Vector3>& particles) {
  while (particles.size() % 4 != 3 || particles.size() % 16 == 0) particles.pop_back();
}

Water lone_particles() {
  const Scene scene = tank_scene(kSpacing, {0.4, 0.3, 0.4}, 0.2);
  return {"lone particles", scene, {{0.2, 0.15, 0.2}, {0.21, 0.16, 0.2}, {0.01, 0.01, 0.01}}};
}

/// Particles at one x, few in each row of cells: a vector of neighbours that starts in one row runs
/// on into the next, whose particles are neighbours too and must not count twice.
Water spray_curtain() {
  const Scene scene = tank_scene(kSpacing, {0.5, 0.5, 0.4}, 0.2);
  std::vector<Vector3> particles;
  for (int k = 0; k < 19; ++k) {
    for (int j = 0; j < 23; ++j) particles.push_back({0.24, 0.02 + 0.02 * j, 0.01 + 0.02 * k});
  }
  return {"spray curtain", scene, particles};
}

/// Behind walls, above and far beyond the grid, and pairs at one place.
Water strays() {
  const Scene scene = tank_scene(kSpacing, {0.3, 0.2, 0.3}, 0.2);
  auto particles = random_places(400, {0, 0, 0}, {0.3, 0.2, 0.2}, 4);
  for (const auto& [lower, upper] :
       std::vector<std::pair<Vector3, Vector3>>{{{0.0, 0.0, -0.1}, {0.3, 0.2, 0.0}},
                                                {{-0.1, -0.1, 0.0}, {0.0, 0.0, 0.2}},
                                                {{0.3, 0.2, 0.0}, {0.5, 0.4, 0.2}},
                                                {{0.0, 0.0, 0.75}, {0.3, 0.2, 0.95}},
                                                {{10.0, 0.0, 0.0}, {10.05, 0.05, 0.05}},
                                                {{0.0, 0.0, -30.0}, {0.05, 0.05, -29.95}}}) {
    const auto some = random_places(41, lower, upper, 5);
    particles.insert(particles.end(), some.begin(), some.end());
  }
  for (std::size_t i = 0; i < 5; ++i) particles.push_back(particles[i]);
  return {"strays", scene, particles};
}

}  // namespace

Water resting_lattice() {
  const Scene scene = tank_scene(kSpacing, {0.3, 0.2, 0.4}, 0.16);
  auto particles = initial_particles(scene);
  make_odd(particles);
  return {"lattice", scene, particles};
}

Water crowd() {
  Scene scene = tank_scene(kSpacing, {0.4, 0.3, 0.4}, 0.2);
  scene.fluid.pull = {5.0, 0.0, 12.0};
  scene.fluid.pull_centre = {0.2, 0.0, 0.1};
  return {"crowd", scene, random_places(1501, {0, 0, 0}, {0.25, 0.2, 0.2}, 1)};
}

Water spray() {
  const Scene scene = tank_scene(kSpacing, {0.4, 0.3, 0.4}, 0.2);
  return {"spray", scene, random_places(301, {0, 0, 0}, {0.4, 0.3, 0.9}, 2)};
}

Water beach() {
  Scene scene = tank_scene(kSpacing, {0.6, 0.2, 0.4}, 0.15);
  scene.slope = {true, 0.2, 0.3};
  scene.wave_maker = {true, 0.1, 2.0};
  auto particles = initial_particles(scene);
  const auto loose = random_places(350, {0.03, 0.0, 0.0}, {0.6, 0.2, 0.3}, 3);
  particles.insert(particles.end(), loose.begin(), loose.end());
  make_odd(particles);
  return {.name = "beach", .scene = scene, .particles = particles, .piston = {0.037, 0.4}};
}

Water two_bodies() {
  Scene scene = tank_scene(kSpacing, {0.4, 0.4, 0.4}, 0.14);
  scene.bodies = {body_of("box", {ShapeKind::box, {0.16, 0.07, 0.05}, 0.01, 0.3}),
                  body_of("ball", {ShapeKind::sphere, {0.09, 0.09, 0.09}})};
  auto particles = random_places(1100, {0, 0, 0}, {0.4, 0.4, 0.2}, 6);
  make_odd(particles);
  Water water = {"two bodies", scene, particles};
  water.motions = {
      [](double t) {
        return BodyState{{0.17 + 0.5 * t, 0.2, 0.12 - t},
                         from_turn({0.2, -0.4, 0.9}),
                         {0.5, 0.0, -1.0},
                         {3.0, -2.0, 5.0}};
      },
      [](double) {
        return BodyState{
            {0.3, 0.25, 0.1}, from_turn({2.0, 0.1, 0.0}), {0.0, 0.8, 0.1}, {0.0, 0.0, -4.0}};
      }};
  return water;
}

namespace {

/// The same of meshes, one of them askew and beside its own origin.
Water two_meshes() {
  Water water = two_bodies();
  water.name = "two meshes";
  const TriangleMesh box = box_mesh({0.13, 0.07, 0.06});
  water.scene.bodies[0].shape =
      mesh_shape(make_solid(placed(box, from_turn({0.5, 0.3, -0.2}), {0.02, 0.0, 0.01}), kSpacing));
  water.scene.bodies[1].shape = mesh_shape(make_solid(sphere_mesh(0.05, 2), kSpacing));
  return water;
}

}  // namespace

std::vector<Water> situations() {
  std::vector<Water> all;
  for (auto make_one : {resting_lattice, crowd, spray, spray_curtain, lone_particles, beach, strays,
                        two_bodies, two_meshes}) {
    all.push_back(make_one());
  }
  return all;
}

}  // namespace splash::sim
