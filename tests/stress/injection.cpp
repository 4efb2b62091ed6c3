// SPDX-License-Identifier: MIT
#include "tests/stress/injection.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace splash::stress {
namespace {

using sim::Fluid;
using sim::Moment;
using sim::Step;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Past all of the product's own ways to write there.
template <class T>
void poke(Fluid& fluid, const sim::Buffer<T>& buffer, std::size_t index, T value) {
  fluid.device().queue().enqueueWriteBuffer(buffer.memory(), CL_TRUE, index * sizeof(T), sizeof(T),
                                            &value);
}

template <class T>
T peek(Fluid& fluid, const sim::Buffer<T>& buffer, std::size_t index) {
  T value{};
  fluid.device().queue().enqueueReadBuffer(buffer.memory(), CL_TRUE, index * sizeof(T), sizeof(T),
                                           &value);
  return value;
}

std::size_t part(const Fluid& fluid, std::size_t axis, int place) {
  return axis * static_cast<std::size_t>(fluid.params().capacity) + static_cast<std::size_t>(place);
}

Injection put_place(const std::string& name, Moment moment, std::size_t axis, float value) {
  return {name, moment, [=](Fluid& fluid, Step&, int place) {
            poke(fluid, fluid.particles().position, part(fluid, axis, place), value);
          }};
}

Injection put_velocity(const std::string& name, Moment moment, std::size_t axis, float value) {
  return {name, moment, [=](Fluid& fluid, Step&, int place) {
            poke(fluid, fluid.particles().velocity, part(fluid, axis, place), value);
          }};
}

Injection put_density(const std::string& name, float value) {
  // Between the halves: the step makes its densities itself.
  return {name, Moment::between, [=](Fluid& fluid, Step&, int place) {
            poke(fluid, fluid.density(), static_cast<std::size_t>(place), value);
          }};
}

/// Puts the particle where the middle one of the arrays is, shifted by `apart` [m] along x.
void move_to_middle(Fluid& fluid, int place, float apart) {
  const int other = fluid.params().count / 2;
  const int mine = place == other ? place + 1 : place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float x = peek(fluid, fluid.particles().position, part(fluid, axis, other));
    poke(fluid, fluid.particles().position, part(fluid, axis, mine), axis == 0 ? x + apart : x);
  }
}

/// Moves the particle by `way` spacings along x, towards the tank's middle.
Injection move_by(const std::string& name, float way) {
  return {name, Moment::between, [=](Fluid& fluid, Step&, int place) {
            const sim::FluidParams& p = fluid.params();
            const float x = peek(fluid, fluid.particles().position, part(fluid, 0, place));
            const float middle = 0.5F * (p.walls[1].offset - p.walls[2].offset);
            const float step = way * p.spacing;
            poke(fluid, fluid.particles().position, part(fluid, 0, place),
                 x < middle ? x + step : x - step);
          }};
}

/// Puts the particle onto the one that is nearest to it: the shortest of all ways to coincide. The
/// water has pairs in the corners that lie together anyway: they are passed over.
void move_to_neighbour(Fluid& fluid, int place) {
  const std::vector<float> x = fluid.snapshot().position;
  const auto count = static_cast<std::size_t>(fluid.params().count);
  const auto mine = static_cast<std::size_t>(place);
  const auto at = [&](std::size_t axis, std::size_t i) {
    return x[axis * static_cast<std::size_t>(fluid.params().capacity) + i];
  };
  std::size_t nearest = mine;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < count; ++i) {
    const float apart =
        std::hypot(at(0, i) - at(0, mine), at(1, i) - at(1, mine), at(2, i) - at(2, mine));
    if (i == mine || !(apart < least) || apart < 0.1F * fluid.params().spacing) continue;
    least = apart;
    nearest = i;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    poke(fluid, fluid.particles().position, part(fluid, axis, place), at(axis, nearest));
  }
}

/// Puts all of the water into one cell, a tenth of a spacing from one to the next: every particle
/// is every other's neighbour.
void move_all_to_one_cell(Fluid& fluid) {
  const sim::FluidParams& p = fluid.params();
  const auto stride = static_cast<std::size_t>(p.capacity);
  std::vector<float> place(3 * stride);
  const std::array<float, 3> middle = {0.5F * (p.walls[1].offset - p.walls[2].offset),
                                       0.5F * (p.walls[3].offset - p.walls[4].offset),
                                       p.walls[0].offset + 2.0F * p.spacing};
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
    const std::array<std::size_t, 3> rank = {i % 10, i / 10 % 10, i / 100};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis * stride + i] = middle[axis] + 0.1F * p.spacing * static_cast<float>(rank[axis]);
    }
  }
  fluid.device().queue().enqueueWriteBuffer(fluid.particles().position.memory(), CL_TRUE, 0,
                                            place.size() * sizeof(float), place.data());
}

Injection double_a_name(const std::string& name) {
  return {name, Moment::between, [](Fluid& fluid, Step&, int place) {
            const int other = place == 0 ? 1 : 0;
            const int id = peek(fluid, fluid.particles().id, static_cast<std::size_t>(other));
            poke(fluid, fluid.particles().id, static_cast<std::size_t>(place), id);
          }};
}

/// `factor` times as long as is stable.
Injection longer_step(const std::string& name, double factor) {
  return {name, Moment::between, [=](Fluid& fluid, Step& step, int) {
            step.dt = factor * sim::largest_time_step(fluid.params(), 0.0, 0.0, 1.0);
          }};
}

}  // namespace

std::vector<Injection> injections() {
  std::vector<Injection> all = {
      put_place("NaN place", Moment::before, 0, kNaN),
      put_place("infinite place", Moment::before, 2, kInfinity),
      put_place("NaN place within a step", Moment::between, 1, -kNaN),
      put_velocity("NaN velocity", Moment::before, 1, kNaN),
      put_velocity("infinite velocity", Moment::between, 2, -kInfinity),
      put_density("NaN density", kNaN),
      put_density("infinite density", kInfinity),
      put_velocity("1e6 m/s", Moment::before, 0, 1.0e6F),
      put_velocity("1e6 m/s within a step", Moment::between, 2, 1.0e6F),
      put_place("beyond the tank", Moment::before, 0, -10.0F),
      put_place("far beyond the tank", Moment::between, 2, 1.0e7F),
      double_a_name("a lost particle"),
      longer_step("a step fifty times as long", 50.0),
      move_by("half a spacing farther within a step", 0.5F),
      {"onto its neighbour within a step", Moment::between,
       [](Fluid& fluid, Step&, int place) { move_to_neighbour(fluid, place); }},
      {"all in one cell", Moment::before,
       [](Fluid& fluid, Step&, int) { move_all_to_one_cell(fluid); }},
  };
  for (const Moment moment : {Moment::before, Moment::between}) {
    all.push_back({moment == Moment::before ? "two at one place" : "two at one place within a step",
                   moment,
                   [](Fluid& fluid, Step&, int place) { move_to_middle(fluid, place, 0.0F); }});
  }
  return all;
}

std::vector<Single> single_faults() {
  using sim::Fault;
  return {{Fault::not_finite, put_density("NaN density", kNaN)},
          {Fault::stray, move_by("a hundredth of a spacing farther", 0.01F)},
          {Fault::speed, put_velocity("1e6 m/s", Moment::between, 2, 1.0e6F)},
          {Fault::density, put_density("thinner than a particle alone", 100.0F)},
          {Fault::lost, double_a_name("a lost particle")},
          {Fault::changed, put_velocity("a small push", Moment::before, 0, 0.3F)},
          {Fault::step, longer_step("a step 2.1 times as long", 2.1)}};
}

}  // namespace splash::stress
