// SPDX-License-Identifier: MIT
// Bodies that the water moves: a cuboid that floats (Archimedes; its heave by the linear theory of
// waves in its tank, which the added mass of open water alone misses), and a cube that sinks (Wu et
// al. 2014, as replotted by Qiu et al. 2017).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/validation/cases.hpp"

namespace splash::validation {

namespace {

constexpr double kGravity = 9.81;

// How a cuboid heaves in a square tank by the linear theory of waves, which its walls send back:
// Laplace's equation in cells, a quarter of the tank. The rate of the potential is -g eta at the
// surface, its slope the cuboid's speed below that. The part of the water's push that its own
// acceleration makes is the added mass of a surface that gives way, and goes to its mass.

/// A cuboid of square plan in the middle of a square tank [m].
struct Heave {
  double half_width = 0.0;  ///< of the cuboid
  double draft = 0.0;       ///< at rest; its mass is that of the water there
  double half_tank = 0.0;
  double depth = 0.0;
  double edge = 0.0;  ///< of the cells, of which all of these are whole numbers
};

constexpr double kStep = 0.008;     // [s]
constexpr double kResidual = 1e-6;  // of the demand
constexpr int kIterations = 2000;

double dot(const Column& a, const Column& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

class Quarter {
 public:
  explicit Quarter(const Heave& heave)
      : body_(cells_of(heave.half_width, heave)),
        sunk_(cells_of(heave.draft, heave)),
        wide_(cells_of(heave.half_tank, heave)),
        high_(cells_of(heave.depth, heave)),
        edge_(heave.edge) {}

  [[nodiscard]] int wide() const noexcept { return wide_; }
  [[nodiscard]] bool under_body(int x, int y) const noexcept { return x < body_ && y < body_; }
  [[nodiscard]] Column zeros() const { return Column(cell(0, 0, high_), 0.0); }
  [[nodiscard]] std::size_t cell(int x, int y, int z) const noexcept {
    return static_cast<std::size_t>((z * wide_ + y) * wide_ + x);
  }
  [[nodiscard]] std::size_t top(int x, int y) const noexcept { return cell(x, y, high_ - 1); }

  /// The potential that is `surface` there and has the slope `speed` under the body; begins with
  /// `potential` (conjugate gradients).
  void solve(const Column& surface, double speed, Column& potential) const {
    Column demand = zeros();
    for (int y = 0; y < wide_; ++y) {
      for (int x = 0; x < wide_; ++x) {
        if (under_body(x, y)) {
          demand[cell(x, y, high_ - sunk_ - 1)] += edge_ * speed;
        } else {
          demand[top(x, y)] += 2.0 * surface[cell(x, y, 0)];
        }
      }
    }
    Column rest = applied(potential);
    for (std::size_t c = 0; c < rest.size(); ++c) rest[c] = demand[c] - rest[c];
    Column way = rest;
    double left = dot(rest, rest);
    const double enough = kResidual * kResidual * dot(demand, demand);
    for (int turn = 0; turn < kIterations && left > enough; ++turn) {
      const Column along = applied(way);
      const double far = left / dot(way, along);
      for (std::size_t c = 0; c < rest.size(); ++c) {
        potential[c] += far * way[c];
        rest[c] -= far * along[c];
      }
      const double now = dot(rest, rest);
      for (std::size_t c = 0; c < rest.size(); ++c) way[c] = rest[c] + now / left * way[c];
      left = now;
    }
  }

  /// Integral of a potential over the whole body's bottom, where its slope is `speed`.
  [[nodiscard]] double below_body(const Column& potential, double speed) const {
    double sum = 0.0;
    for (int y = 0; y < body_; ++y) {
      for (int x = 0; x < body_; ++x) {
        sum += potential[cell(x, y, high_ - sunk_ - 1)] + 0.5 * edge_ * speed;
      }
    }
    return 4.0 * edge_ * edge_ * sum;
  }

 private:
  static int cells_of(double length, const Heave& heave) {
    return static_cast<int>(std::lround(length / heave.edge));
  }

  [[nodiscard]] bool is_water(int x, int y, int z) const noexcept {
    return x >= 0 && y >= 0 && z >= 0 && x < wide_ && y < wide_ && z < high_ &&
           !(under_body(x, y) && z >= high_ - sunk_);
  }

  [[nodiscard]] Column applied(const Column& field) const {
    Column sum = field;
    for (int z = 0; z < high_; ++z) {
      for (int y = 0; y < wide_; ++y) {
        for (int x = 0; x < wide_; ++x) {
          if (!is_water(x, y, z)) continue;
          const std::size_t c = cell(x, y, z);
          double flow = z == high_ - 1 ? 2.0 * field[c] : 0.0;
          if (is_water(x - 1, y, z)) flow += field[c] - field[cell(x - 1, y, z)];
          if (is_water(x + 1, y, z)) flow += field[c] - field[cell(x + 1, y, z)];
          if (is_water(x, y - 1, z)) flow += field[c] - field[cell(x, y - 1, z)];
          if (is_water(x, y + 1, z)) flow += field[c] - field[cell(x, y + 1, z)];
          if (is_water(x, y, z - 1)) flow += field[c] - field[cell(x, y, z - 1)];
          if (is_water(x, y, z + 1)) flow += field[c] - field[cell(x, y, z + 1)];
          sum[c] = flow;
        }
      }
    }
    return sum;
  }

  int body_;
  int sunk_;
  int wide_;
  int high_;
  double edge_;
};

/// Times at which it passes the place where it floats, let go above it at 0, until `end` [s].
Column heave_passages(const Heave& heave, double end) {
  const Quarter water(heave);
  const double area = 4.0 * heave.half_width * heave.half_width;
  const double tank = 4.0 * heave.half_tank * heave.half_tank;
  const auto columns = water.cell(0, 0, 1);
  Column unit = water.zeros();
  water.solve(Column(columns, 0.0), 1.0, unit);
  const double inertia = heave.draft * area + water.below_body(unit, 1.0);  // over the density
  double height = 1.0;
  double speed = 0.0;
  Column eta(columns, -height * area / (tank - area));
  Column surface(columns, 0.0);
  Column rate = water.zeros();
  Column potential = water.zeros();
  Column passages;
  for (int step = 0; step * kStep < end; ++step) {
    Column weight(columns);
    for (std::size_t k = 0; k < columns; ++k) weight[k] = -kGravity * eta[k];
    water.solve(weight, 0.0, rate);
    speed -= kStep * (kGravity * area * height + water.below_body(rate, 0.0)) / inertia;
    for (std::size_t k = 0; k < columns; ++k) surface[k] += kStep * weight[k];
    water.solve(surface, speed, potential);
    for (int y = 0; y < water.wide(); ++y) {
      for (int x = 0; x < water.wide(); ++x) {
        if (water.under_body(x, y)) continue;
        const std::size_t k = water.cell(x, y, 0);
        eta[k] += kStep * 2.0 * (surface[k] - potential[water.top(x, y)]) / heave.edge;
      }
    }
    const double next = height + kStep * speed;
    if (height * next < 0.0) passages.push_back(kStep * (step + height / (height - next)));
    height = next;
  }
  return passages;
}

// Of float.yaml.
constexpr double kHeight = 0.12;  // of the cuboid [m]
constexpr double kDraft = 0.06;   // at half the water's density [m]
constexpr double kLate = 3.0;     // it floats calmly from here on [s]
constexpr double kHeaving = 1.6;  // and heaves until here [s]
constexpr int kLevels = 4;
const Heave kHeave = {
    .half_width = 0.12, .draft = kDraft, .half_tank = 0.4, .depth = 0.4, .edge = 0.02};

/// Twice the mean time between the passages of where it comes to rest while it heaves.
double period_of(const Column& passages) {
  Column early;
  for (const double t : passages) {
    if (t < kHeaving) early.push_back(t);
  }
  if (early.size() < 2) return std::nan("");
  return 2.0 * (early.back() - early.front()) / static_cast<double>(early.size() - 1);
}

Outcome evaluate_float(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Series& g = run.gauges;
  const Column& time = g["time"];
  const Column& z = g["cuboid_z"];
  const double end = time.back();
  double level = 0.0;
  for (int i = 0; i < kLevels; ++i) {
    const Column& height = g["level" + std::to_string(i) + "_height"];
    level += mean_between(time, height, kLate, end) / kLevels;
  }
  const double rest = mean_between(time, z, kLate, end);
  const double draft = level - (rest - kHeight / 2.0);
  const double spacing = run.scene.fluid.spacing;
  const double hydrostatic = 2.0 * std::numbers::pi * std::sqrt(kDraft / kGravity);
  const double period = period_of(zero_crossings(time, linear(1.0, z, -rest)));
  const double theory = period_of(heave_passages(kHeave, kHeaving));
  const double upright =
      1.0 - 2.0 * (std::pow(g["cuboid_qx"].back(), 2) + std::pow(g["cuboid_qy"].back(), 2));
  // Wanted: 3 % of the body's height or half a spacing, whichever is more.
  const double wanted = std::max(3.0, 100.0 * 0.5 * spacing / kHeight);
  return {
      {{"draft, error, of the height", 100.0 * (draft - kDraft) / kHeight, "%", -wanted, wanted},
       {"draft, error", (draft - kDraft) / spacing, "dp", -0.5, 0.5},
       {"heave period, error", 100.0 * (period / theory - 1.0), "%", -15.0, 15.0},
       {"heave period over the hydrostatic one", period / hydrostatic, "1", 1.0},
       {"the same by linear theory", theory / hydrostatic, "1"},
       {"tilt", 180.0 / std::numbers::pi * std::acos(std::min(upright, 1.0)), "degrees", 0.0, 5.0}},
      {{"", time, z}}};
}

std::vector<Curve> reference_float() {
  return {{"Archimedes", {0.0, 4.0}, {0.4 + kHeight / 2.0 - kDraft, 0.4 + kHeight / 2.0 - kDraft}}};
}

Outcome evaluate_sinking(const std::vector<Run>& runs) {
  const Run& run = runs.front();
  const Column& time = run.gauges["time"];
  const Column& z = run.gauges["cube_z"];
  const Series reference = reference_named("wu_2014_sinking_cube");
  const Column& at = reference["t"];
  const Column& fallen = reference["fallen"];
  double error = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    error += std::abs(z.front() - interpolate(time, z, at[k]) - fallen[k]) /
             static_cast<double>(at.size());
  }
  const Column way = linear(-1.0, z, z.front());
  const double landing = first_reach(time, way, fallen.back());
  return {{{"way, mean error, of all of it", 100.0 * error / fallen.back(), "%", 0.0, 10.0},
           {"time of landing, error", 100.0 * (landing / at.back() - 1.0), "%", -10.0, 10.0}},
          {{"", time, way}}};
}

std::vector<Curve> reference_sinking() {
  const Series series = reference_named("wu_2014_sinking_cube");
  return {{"Wu et al. 2014", series["t"], series["fallen"]}};
}

}  // namespace

Case floating() {
  return {.name = "float",
          .title = "A cuboid of half the water's density floats",
          .scenes = {"float"},
          .seconds = 5.0,
          .spacings = {0.04, 0.03, 0.02},
          .size = kHeight,
          .size_name = "h",
          .evaluate = evaluate_float,
          .reference = reference_float,
          .x_label = "time [s]",
          .y_label = "height of its centre [m]"};
}

Case sinking_cube() {
  return {.name = "sinking_cube",
          .title = "A cube of 20 mm and 2700 kg/m3 sinks",
          .scenes = {"sinking_cube"},
          .seconds = 0.8,
          .spacings = {0.006666667, 0.005, 0.004},
          .size = 0.02,
          .size_name = "a",
          .evaluate = evaluate_sinking,
          .reference = reference_sinking,
          .x_label = "time [s]",
          .y_label = "way down [m]"};
}

}  // namespace splash::validation
