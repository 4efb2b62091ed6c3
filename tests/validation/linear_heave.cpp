// SPDX-License-Identifier: MIT
// Laplace's equation in cells, a quarter of the tank: the rate of the potential is -g eta at the
// surface, its slope the cuboid's speed below that. The part of the water's push that its own
// acceleration makes is the added mass of a surface that gives way, and goes to its mass.
#include "tests/validation/linear_heave.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace splash::validation {

namespace {

constexpr double kGravity = 9.81;
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

}  // namespace

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

}  // namespace splash::validation
