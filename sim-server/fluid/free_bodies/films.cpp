// SPDX-License-Identifier: MIT
#include "sim-server/fluid/free_bodies/films.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {
namespace {

/// Whether two boxes, grown by `margin`, overlap along one axis.
bool overlap(float a_lower, float a_upper, float b_lower, float b_upper, float margin) {
  return a_upper + margin > b_lower && a_lower - margin < b_upper;
}

bool boxes_meet(const BodyStep& a, const BodyStep& b, float margin) {
  return overlap(a.lower_x, a.upper_x, b.lower_x, b.upper_x, margin) &&
         overlap(a.lower_y, a.upper_y, b.lower_y, b.upper_y, margin) &&
         overlap(a.lower_z, a.upper_z, b.lower_z, b.upper_z, margin);
}

/// Whether a corner of the body's box, grown by `margin`, is behind the wall, which may have moved
/// by `piston` [m].
bool meets_wall(const BodyStep& b, const WallPlane& wall, float piston, float margin) {
  const float deepest = std::min(wall.nx * b.lower_x, wall.nx * b.upper_x) +
                        std::min(wall.ny * b.lower_y, wall.ny * b.upper_y) +
                        std::min(wall.nz * b.lower_z, wall.nz * b.upper_z);
  return deepest - margin < wall.offset + piston;
}

}  // namespace

Films::Films(Device& device, const cl::Program& program, const std::vector<FreeBody>& bodies,
             const std::vector<SkinFace>& skin)
    : rims_(device, bodies.size() * SPLASH_PUSH_PARTS * SPLASH_RIM_ENTRIES),
      parts_(device, bodies.size() * SPLASH_PUSH_PARTS * SPLASH_FILM_ENTRIES),
      kept_(device, 2 * bodies.size()),
      lists_(device, 3 * bodies.size()),
      push_(device, 6 * bodies.size()) {
  const auto lanes = static_cast<std::size_t>(device.lanes());
  std::vector<SkinFace> sorted;
  std::vector<int> from = {0};
  for (const FreeBody& body : bodies) {
    free_.push_back(body.body);
    std::copy_if(skin.begin(), skin.end(), std::back_inserter(sorted),
                 [&](const SkinFace& face) { return face.owner == body.body; });
    // Whole vectors: what fills them up is at the last place and has no area.
    while (sorted.size() % lanes != 0) sorted.push_back({sorted.back().place, {}, body.body});
    from.push_back(static_cast<int>(sorted.size()));
  }
  skin_stride_ = static_cast<int>(sorted.size());
  std::vector<float> numbers(6 * sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis * sorted.size() + i] = as_float(sorted[i].place[axis]);
      numbers[(3 + axis) * sorted.size() + i] = as_float(sorted[i].area[axis]);
    }
  }
  skin_ = sorted.empty() ? Buffer<float>(device, 1) : Buffer<float>(device, numbers);
  skin_from_ = Buffer<int>(device, from);
  const std::size_t group = device.profile().group;
  measure_rims_ = Kernel(program, "measure_rims", group);
  press_films_ = Kernel(program, "press_films", group);
  sum_films_ = Kernel(program, "sum_films", 1);
}

bool Films::any_near(const Fluid& fluid, const Step& step) const {
  const std::vector<BodyStep>& given = fluid.boundary().given_steps();
  const auto count = static_cast<std::size_t>(fluid.boundary().body_count());
  const std::size_t steps = given.size() / count;
  const auto frame = as_float(step.dt * static_cast<double>(steps));
  const FluidParams& p = fluid.params();
  for (const int free : free_) {
    const BodyStep& one = given[static_cast<std::size_t>(free)];
    for (int k = 0; k < p.wall_count; ++k) {
      const float moved = k == p.piston ? as_float(step.piston) : 0.0F;
      if (meets_wall(one, p.walls[k], moved, frame * one.speed)) return true;
    }
    for (std::size_t other = 0; other < count; ++other) {
      if (static_cast<int>(other) == free) continue;
      if (boxes_meet(one, given[other], frame * (one.speed + given[other].speed))) return true;
    }
  }
  return false;
}

void Films::press(Fluid& fluid, const Step& step, const Now& now) {
  if (skin_stride_ == 0) return;
  if (step.first_body == 0) {
    const bool before = pressed_;
    pressed_ = any_near(fluid, step);
    if (before && !pressed_) forget(fluid.device());
  }
  if (!pressed_) return;
  ++steps_;
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Boundary& boundary = fluid.boundary();
  const auto count = static_cast<int>(free_.size());
  const auto dt = as_float(step.dt);
  const auto piston = as_float(step.piston);
  const std::size_t items = free_.size() * SPLASH_PUSH_PARTS;
  const std::array near_surfaces = {KernelArg{"p", params},
                                    KernelArg{"piston", piston},
                                    KernelArg{"free_count", count},
                                    KernelArg{"frees", now.bodies},
                                    KernelArg{"steps", boundary.steps()},
                                    KernelArg{"first_body", step.first_body},
                                    KernelArg{"body_count", boundary.body_count()},
                                    KernelArg{"skin", skin_},
                                    KernelArg{"skin_from", skin_from_},
                                    KernelArg{"skin_stride", skin_stride_},
                                    KernelArg{"position", fluid.particles().position},
                                    KernelArg{"density", fluid.density()},
                                    KernelArg{"pressure", now.pressure},
                                    KernelArg{"reach", now.reach},
                                    KernelArg{"reached", now.reached},
                                    KernelArg{"rims", rims_}};
  measure_rims_.run(queue, items, {}, near_surfaces, boundary.outlines());
  press_films_.run(queue, items, {{"dt", dt}, {"kept", kept_}, {"parts", parts_}}, near_surfaces,
                   boundary.outlines());
  sum_films_.run(queue, 1,
                 {{"p", params},
                  {"dt", dt},
                  {"free_count", count},
                  {"frees", now.bodies},
                  {"steps", boundary.steps()},
                  {"first_body", step.first_body},
                  {"rims", rims_},
                  {"parts", parts_},
                  {"kept", kept_},
                  {"lists", lists_},
                  {"push", push_}});
}

}  // namespace splash::sim
