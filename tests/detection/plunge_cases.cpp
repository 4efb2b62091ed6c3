// SPDX-License-Identifier: MIT
// One entry into water at rest: any speed, spacing, shape, tilt, direction and solver.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "sim-server/scene/mesh/triangle_mesh.hpp"
#include "tests/detection/script.hpp"
#include "tests/detection/sweeps.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"

namespace splash::detection {
namespace {

constexpr double kBefore = 0.15;    ///< a run begins so long before the entry [s]
constexpr double kLeastGap = 0.03;  ///< and so far above the level [m]
constexpr double kAfter = 0.6;      ///< it ends so long after the entry [s]
constexpr double kDepth = 0.12;     ///< the body stops so deep [m]
constexpr double kDensity = 998.0;  ///< [kg/m3]

/// One body on a straight way into a basin.
struct Plunge {
  std::string name;
  sim::Vector3 velocity = {0.0, 0.0, -1.0};  ///< [m/s]
  sim::Shape shape = hand();
  std::string as_text;  ///< of the shape; empty: what shape_text says
  sim::Quaternion turn = {0.0, 0.0, 0.0, 1.0};
  Basin basin;
  double inside = 0.0;      ///< moves for so long after the entry [s]; 0: until kDepth
  double added_mass = 0.0;  ///< [kg]
  bool quick = false;
};

Case case_of(const std::string& sweep, const Plunge& plunge) {
  const double down = -plunge.velocity[2];
  const double gap = std::max(kLeastGap, kBefore * down);
  const double before = gap / down;
  const double inside = plunge.inside > 0.0 ? plunge.inside : std::min(kDepth / down, kAfter);
  sim::BodyState at_origin;
  at_origin.rotation = plunge.turn;
  const double low = lowest_point(plunge.shape, at_origin)[2];
  const double middle = 0.5 * (before + inside);
  Way way({-middle * plunge.velocity[0], 0.0, plunge.basin.level + gap - low}, plunge.turn);
  way.go(plunge.velocity, before + inside).wait(1.0);
  const std::string shape = plunge.as_text.empty() ? shape_text(plunge.shape) : plunge.as_text;
  Case item = {sweep, plunge.name, plunge.basin.scene({body_text("body", shape, way.text())}),
               before + kAfter};
  item.wishes.added_mass = plunge.added_mass;
  item.quick = plunge.quick;
  return item;
}

/// Of one side of a flat rectangle (events that a disc makes: 0.24 rho A^1.5) [kg].
double plate_mass(double length, double width, double slenderness) {
  const double area = length * width;
  return 0.24 * slenderness * kDensity * area * std::sqrt(area);
}

constexpr double kHandSlenderness = 0.88;  ///< of two to one

Plunge of_hand(double speed) {
  Plunge plunge;
  plunge.name = digits(speed) + " m/s";
  plunge.velocity = {0.0, 0.0, -speed};
  plunge.added_mass = plate_mass(0.18, 0.09, kHandSlenderness);
  return plunge;
}

void add_speeds(std::vector<Case>& all) {
  for (const double speed : {0.05, 0.06, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0}) {
    Plunge plunge = of_hand(speed);
    plunge.quick = speed == 0.1 || speed == 1.0 || speed == 3.0;
    all.push_back(case_of("speed", plunge));
  }
}

void add_spacings(std::vector<Case>& all) {
  Basin fine;
  fine.length = 0.36;
  fine.width = 0.27;
  fine.level = 0.21;
  fine.spacing = 0.015;
  Basin coarse;
  coarse.spacing = 0.03;
  for (const Basin& basin : {coarse, fine}) {
    for (const double speed : {0.1, 0.5, 1.0, 2.0, 5.0}) {
      Plunge plunge = of_hand(speed);
      plunge.basin = basin;
      plunge.name = digits(1.0e3 * basin.spacing) + " mm, " + plunge.name;
      all.push_back(case_of("spacing", plunge));
    }
  }
}

void add_shapes(std::vector<Case>& all, const std::filesystem::path& folder) {
  for (const double size : {0.05, 0.1, 0.2}) {
    Plunge plunge;
    if (size > 0.1) plunge.basin.length = plunge.basin.width = 0.5;
    const std::string name = digits(100.0 * size) + " cm ";
    plunge.shape = box({size, size, size});
    plunge.name = name + "box";
    plunge.added_mass = plate_mass(size, size, 0.95);
    all.push_back(case_of("shape", plunge));
    plunge.shape = ball(size);
    plunge.name = name + "sphere";
    plunge.added_mass = 0.34 * kDensity * 0.125 * size * size * size;
    plunge.quick = size == 0.1;
    all.push_back(case_of("shape", plunge));
    // Its lowest vertices are as low as the sphere, or a little less.
    const auto file = folder / ("ball_" + digits(1000.0 * size) + ".obj");
    const sim::TriangleMesh mesh = sim::sphere_mesh(0.5 * size, 1);
    std::ofstream(file) << sim::obj_text(mesh);
    plunge.as_text = "mesh: " + file.string();
    plunge.name = name + "mesh";
    plunge.quick = false;
    all.push_back(case_of("shape", plunge));
  }
}

void add_tilts(std::vector<Case>& all) {
  for (const double tilt : {5.0, 10.0, 20.0, 30.0, 45.0}) {
    for (const double speed : {0.5, 1.0, 2.0}) {
      if (speed != 1.0 && tilt != 10.0 && tilt != 45.0) continue;
      Plunge plunge = of_hand(speed);
      plunge.added_mass = 0.0;
      plunge.turn = pitched(tilt);
      plunge.name = digits(tilt) + " degrees, " + plunge.name;
      plunge.quick = tilt == 20.0;
      all.push_back(case_of("tilt", plunge));
    }
  }
}

void add_slants(std::vector<Case>& all) {
  const auto add = [&](double down, double along) {
    Plunge plunge = of_hand(down);
    plunge.velocity = {along, 0.0, -down};
    plunge.basin.length = 0.9;
    plunge.basin.level = 0.2;
    plunge.inside = 0.06;
    plunge.name = digits(down) + " down, " + digits(along) + " along";
    plunge.quick = along == 3.0;
    all.push_back(case_of("oblique", plunge));
  };
  for (const double along : {0.5, 1.0, 2.0, 4.0}) add(0.5, along);
  for (const double along : {0.0, 1.0, 2.1, 3.0}) add(0.2, along);
}

}  // namespace

std::vector<Case> plunge_cases(const std::filesystem::path& folder) {
  std::vector<Case> all;
  add_speeds(all);
  add_spacings(all);
  add_shapes(all, folder);
  add_tilts(all);
  add_slants(all);
  return all;
}

}  // namespace splash::detection
