// SPDX-License-Identifier: MIT
// A plate strikes weightless water on a grid: the change of the water's momentum against the sum of
// the forces on the plate. Pressures act on volumes, but particles get the momentum. The force
// leaves out what particles far from the plate gain beyond the pressures there, unless the plate
// causes those pressures; this test sums that over all particles and faces in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/gauge/water_state.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

/// Water without walls around, a plate of `size` in or before it, and how that goes.
struct Blow {
  const char* says;
  double spacing;
  std::string water;
  std::string size;
  double begins;                       ///< x of the plate's middle [m]
  std::function<double(double)> goes;  ///< along x, by time [m]
  double lasts;                        ///< [s]
};

/// The largest that the water's momentum along x was, how far what the forces gave was ever from
/// it, and the same with what the water got elsewhere [N s].
struct Balance {
  double most = 0.0;
  double off = 0.0;
  double left = 0.0;
};

/// Where a place is between those of the grid along an axis: faces along x, else middles.
struct Between {
  int lower;
  double share;
};

Between between(double from, double edge, int cells, bool faces, double x) {
  const double at = (x - from) / edge - (faces ? 0.0 : 0.5);
  const int lower = std::clamp(static_cast<int>(std::floor(at)), 0, cells - (faces ? 1 : 2));
  return {lower, std::clamp(at - lower, 0.0, 1.0)};
}

/// Momentum along x that the particles, which were at `places`, gained in the last step beyond that
/// of the pressures at faces far from the felt body, less the part of it that the body's force
/// includes: sum_faces (sum_i m w_i / W_i du - I), with I as in given.cl [N s].
double given_elsewhere(Fluid& fluid, const std::vector<Vector3>& places, double dt) {
  const auto& solver = dynamic_cast<const GridProjected&>(fluid.solver());
  const MacGrid& g = solver.fields().grid;
  const MacLevel& l = g.level[0];
  const auto cells = static_cast<std::size_t>(l.cells);
  const auto read = [&](const Buffer<float>& buffer) {  // of faces, those along x come first
    const std::vector<float> values = buffer.read(fluid.device(), cells);
    return std::vector<double>(values.begin(), values.end());
  };
  const auto change = read(solver.fields().gain), gap = read(solver.solids().gap());
  const auto unsharpened = read(solver.fields().change), weight_of = read(solver.fields().weight);
  const auto fill = read(solver.solids().fill());
  const std::vector<int> owner = solver.solids().owner().read(fluid.device(), cells);
  const auto pressure = read(solver.fields().pressure), wet = read(solver.fields().wet);
  const auto whose = read(solver.felt().given().whose());  // of faces far from the body
  const GivenMomentum& included = solver.felt().given();   // in the body's force
  const auto included_change = read(included.given()), included_push = read(included.taken());
  std::vector<double> mass(cells, 0.0);  // that takes over what a face changes [kg]
  for (const Vector3& place : places) {
    const Between x =
        between(static_cast<double>(g.x), static_cast<double>(g.hx), l.nx, true, place[0]);
    const Between y =
        between(static_cast<double>(g.y), static_cast<double>(g.hy), l.ny, false, place[1]);
    const Between z =
        between(static_cast<double>(g.z), static_cast<double>(g.hz), l.nz, false, place[2]);
    std::array<std::size_t, 8> face = {};
    std::array<double, 8> weight = {};
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
      const int i = x.lower + (k & 1), j = y.lower + (k >> 1 & 1), m = z.lower + (k >> 2);
      const auto at = static_cast<std::size_t>(k);
      face[at] = static_cast<std::size_t>((m + 1) * l.layer + (j + 1) * l.row + i + 1);
      if (change[face[at]] > 1.0e29) continue;  // no water beside it
      weight[at] = (k & 1 ? x.share : 1.0 - x.share) * (k & 2 ? y.share : 1.0 - y.share) *
                   (k & 4 ? z.share : 1.0 - z.share);
      sum += weight[at];
    }
    if (sum <= 1.0e-3) continue;  // it flies freely
    for (std::size_t k = 0; k < 8; ++k) {
      mass[face[k]] += static_cast<double>(fluid.params().mass) * weight[k] / sum;
    }
  }
  // The change of velocity that a face near the body got from faces far off by sharpening
  // (sharpen.h), which the body's force leaves out [m/s].
  const auto in_water = [&](std::size_t c) {
    return fill[c] > 0.5 && fill[c - 1] > 0.5 && unsharpened[c] < 1.0e29 && owner[c] < 0 &&
           owner[c - 1] < 0;
  };
  const auto exchanged = [&](std::size_t c) {
    if (!in_water(c)) return 0.0;
    double sum = 0.0;
    for (const int step : {1, l.row, l.layer}) {
      for (const std::size_t next :
           {c - static_cast<std::size_t>(step), c + static_cast<std::size_t>(step)}) {
        if (whose[next] < 0.0 || !in_water(next)) continue;
        sum += std::min(1.0, weight_of[next] / weight_of[c]) *
               (unsharpened[c] - unsharpened[next]) / 6.0;
      }
    }
    return sum;
  };
  const double area = static_cast<double>(g.hy) * static_cast<double>(g.hz);
  double given = 0.0;
  for (std::size_t c = 1; c < cells; ++c) {
    const double rise = wet[c] * pressure[c] - wet[c - 1] * pressure[c - 1];
    if (mass[c] == 0.0 && rise == 0.0) continue;
    if (whose[c] < 0.0) {
      given += mass[c] * exchanged(c);
      continue;
    }
    given += mass[c] > 0.0 ? mass[c] * (change[c] - included_change[c]) : 0.0;
    given += dt * area * gap[c] * rise + included_push[c];
  }
  return given;
}

Balance balance(const Blow& blow) {
  Device device;
  const Scene scene = parse_scene(
      "fluid: {settle: never, solver: grid_projected, spacing: " + std::to_string(blow.spacing) +
          ", gravity: [0, 0, 0]}\n" +
          "tank: {lower: [-1.4, -0.7, -0.8], upper: [1.4, 0.7, 1.0]}\nwater: [{" + blow.water +
          "}]\nbodies:\n  - name: plate\n    shape: {size: " + blow.size +
          "}\n    motion: {kind: osc}\n    rest: {position: [" + std::to_string(blow.begins) +
          ", 0, 0.3]}\n",
      "blow.yaml");
  Simulation simulation(device, scene, {});
  simulation.feel(true);
  const auto momentum_now = [&] { return momentum(read_water(simulation.fluid(), false)).sum[0]; };
  std::vector<Vector3> places;
  double dt = 0.0;
  double elsewhere = 0.0;
  const auto finish_step = [&](Fluid& fluid) {
    if (!places.empty()) elsewhere += given_elsewhere(fluid, places, dt);
    places.clear();
  };
  simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
    if (moment == Moment::before) finish_step(fluid);
    if (moment != Moment::between) return;
    places = read_water(fluid, false).position;
    dt = step.dt;
  });
  double expected = momentum_now();
  Balance balance;
  while (simulation.seconds() < blow.lasts) {
    const double now = simulation.seconds();
    static_cast<void>(simulation.live_body(0)->push({blow.begins + blow.goes(now), 0.0, 0.3},
                                                    {0.0, 0.0, 0.0, 1.0}, {now, {}}));
    const FrameResult frame = simulation.advance();
    finish_step(simulation.fluid());
    EXPECT_EQ(frame.pushes.size(), 1U);
    if (frame.pushes.empty()) return balance;
    expected -= (frame.seconds - now) * frame.pushes[0].force[0];
    const double found = momentum_now();
    balance.most = std::max(balance.most, std::abs(found));
    balance.off = std::max(balance.off, std::abs(found - expected));
    balance.left = std::max(balance.left, std::abs(found - expected - elsewhere));
  }
  std::printf(
      "%s, spacing %.3f m: momentum up to %.4f N s, by forces within %.2f %%, with what is "
      "given elsewhere within %.3f %%\n",
      blow.says, blow.spacing, balance.most, 100.0 * balance.off / balance.most,
      100.0 * balance.left / balance.most);
  return balance;
}

class FeltForceOnAGrid : public testing::TestWithParam<Blow> {};

TEST_P(FeltForceOnAGrid, IsAllTheMomentumThatTheWaterGets) {
  const Balance found = balance(GetParam());
  EXPECT_LT(found.off, 0.02 * found.most);
  EXPECT_LT(found.left, 0.001 * found.most);
}

const std::string kBall = "lower: [-0.1, -0.1, 0.2], upper: [0.1, 0.1, 0.4], form: sphere";
const std::string kBlock = "lower: [-0.4, -0.24, 0.06], upper: [0.4, 0.24, 0.54]";
const std::string kPlate = "[0.06, 0.16, 0.16]";
const std::string kOar = "[0.08, 0.1, 0.2]";

auto at(double speed) {
  return [speed](double time) { return speed * time; };
}

/// In and out, `far` to either side of its mean.
auto rowed(double far) {
  return [far](double time) { return far * (1.0 - std::cos(9.0 * time)); };
}

double away(double time) {
  return 0.16 * std::sin(7.0 * time) - 0.25 * time;
}

std::string name_of(const testing::TestParamInfo<Blow>& blow) {
  std::string name = blow.param.says;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Blows, FeltForceOnAGrid,
    testing::Values(Blow{"a ball struck slowly", 0.02, kBall, kPlate, -0.15, at(0.3), 0.5},
                    Blow{"a ball struck fast", 0.02, kBall, kPlate, -0.15, at(1.0), 0.22},
                    Blow{"a block struck", 0.02, kBlock, kPlate, -0.45, at(1.5), 0.2},
                    Blow{"through a block", 0.02, kBlock, kPlate, -0.2, at(1.0), 0.22},
                    Blow{"in and out", 0.02, kBlock, kOar, -0.48, rowed(0.12), 0.7},
                    Blow{"in and out coarse", 0.03, kBlock, kOar, -0.48, rowed(0.12), 0.7}),
    name_of);
INSTANTIATE_TEST_SUITE_P(
    Longer, FeltForceOnAGrid,
    testing::Values(Blow{"in and out for longer", 0.02, kBlock, kOar, -0.48, rowed(0.12), 1.2},
                    Blow{"a ball struck twice", 0.02, kBall, kPlate, -0.15, rowed(0.1), 1.2},
                    Blow{"in and out of the other side", 0.02, kBlock, kPlate, -0.3, away, 1.0}),
    name_of);

}  // namespace
}  // namespace splash::sim
