// SPDX-License-Identifier: MIT
#include "sim-server/fluid/free_bodies/free_bodies.hpp"

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {
namespace {

static_assert(sizeof(FreeBody) == 12 * sizeof(float));

float as_float(double value) {
  return static_cast<float>(value);
}

}  // namespace

FreeBodies::FreeBodies(Device& device, const FluidParams& params,
                       const std::vector<std::string>& defines, const std::vector<FreeBody>& bodies,
                       const std::vector<SkinFace>& skin)
    : list_(bodies),
      count_(static_cast<int>(bodies.size())),
      groups_(device.vectors_of(params.count)),
      bodies_(device, std::span<const FreeBody>(bodies)),
      reach_(device,
             bodies.size() * SPLASH_REACH_FIELDS * static_cast<std::size_t>(params.capacity)),
      reached_(device, bodies.size() * groups_),
      parts_(device, bodies.size() * SPLASH_PUSH_PARTS * SPLASH_PUSH_ENTRIES),
      answer_(device, 6 * bodies.size()),
      contacts_(device, bodies.size() * SPLASH_CONTACTS * SPLASH_CONTACT_FLOATS),
      kept_pushes_(device, 2 * (bodies.size() * SPLASH_CONTACTS + 1)),
      felt_(device, 6 * bodies.size()),
      force_(device, 6 * bodies.size()),
      no_solve_(device, 1),
      force_read_(6 * bodies.size()) {
  const cl::Program program = build_program(device, free_body_sources(), defines);
  films_ = Films(device, program, bodies, skin);
  const std::size_t group = device.profile().group;
  const std::size_t team = device.profile().team;
  reach_bodies_ = Kernel(program, "reach_bodies", group);
  weigh_water_ = Kernel(program, "weigh_water", team);
  answer_bodies_ = Kernel(program, "answer_bodies", team);
  carry_water_ = Kernel(program, "carry_water", group);
  keep_out_of_free_ = Kernel(program, "keep_out_of_free", group);
  move_bodies_ = Kernel(program, "move_bodies", 1);
}

void FreeBodies::reach(Fluid& fluid, const Step& step, const Buffer<float>& velocity,
                       const Buffer<float>& response) {
  const PointArrays& points = fluid.boundary().points();
  reach_bodies_.run(fluid.device().queue(), list_.size() * groups_, fluid.params_buffer().memory(),
                    as_float(step.dt), count_, bodies_.memory(), fluid.boundary().steps().memory(),
                    step.first_body, fluid.grid().cell_start(), fluid.particles().position.memory(),
                    velocity.memory(), fluid.density().memory(), fluid.body_images().memory(),
                    fluid.pressure_term().memory(), response.memory(),
                    fluid.boundary().grid().cell_start(), points.position.memory(),
                    points.velocity.memory(), fluid.boundary().volume().memory(),
                    points.id.memory(), fluid.boundary().owner().memory(), points.stride,
                    reach_.memory(), reached_.memory());
}

void FreeBodies::answer(Fluid& fluid, const Step& step) {
  reach(fluid, step, fluid.particles().velocity, fluid.density());
  answer(fluid, step,
         {.pressure = &fluid.pressure_term(),
          .pushing = step.dt,
          .rubbing = step.dt,
          .falling = step.dt,
          .factor = 1.0 / step.dt,
          .velocity = &fluid.acceleration()});
}

void FreeBodies::answer(Fluid& fluid, const Step& step, const Occasion& occasion) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const cl::Buffer& state = (occasion.state != nullptr ? *occasion.state : no_solve_).memory();
  const cl::Buffer& steps = fluid.boundary().steps().memory();
  const cl::Buffer& places = fluid.particles().position.memory();
  const int k = occasion.iteration;
  if (occasion.falling > 0.0) {
    films_.press(fluid, step, {bodies_, *occasion.pressure, reach_, reached_});
  }
  weigh_water_.run_teams(queue, list_.size() * SPLASH_PUSH_PARTS, params, k, state, count_,
                         as_float(occasion.pushing), as_float(occasion.rubbing), bodies_.memory(),
                         steps, step.first_body, places, occasion.pressure->memory(),
                         reach_.memory(), reached_.memory(), parts_.memory());
  answer_bodies_.run_teams(queue, list_.size(), params, k, state, count_,
                           as_float(occasion.falling), bodies_.memory(), steps, step.first_body,
                           parts_.memory(), films_.pressed() ? 1 : 0, films_.push().memory(),
                           answer_.memory(), felt_.memory());
  const bool wants_rate = occasion.rate != nullptr;
  carry_water_.run(queue, groups_, params, k, state, count_, as_float(occasion.factor),
                   bodies_.memory(), steps, step.first_body, answer_.memory(), places,
                   reach_.memory(), reached_.memory(), occasion.velocity->memory(),
                   wants_rate ? 1 : 0, (wants_rate ? *occasion.rate : answer_).memory());
}

void FreeBodies::move(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const cl::Buffer& params = fluid.params_buffer().memory();
  const cl::Buffer& shapes = fluid.boundary().shapes().memory();
  const cl::Buffer& meshes = fluid.boundary().meshes().memory();
  const PointArrays& particles = fluid.particles();
  const auto piston = as_float(step.piston);
  const auto speed = as_float(step.piston_speed);
  keep_out_of_free_.run(queue, groups_, params, as_float(step.dt), piston, speed, count_,
                        bodies_.memory(), shapes, meshes, fluid.boundary().steps().memory(),
                        step.first_body, fluid.particles_before().position.memory(),
                        fluid.grid().source(), particles.position.memory(),
                        particles.velocity.memory(), reach_.memory(), reached_.memory());
  answer(fluid, step,
         {.pressure = &fluid.pressure_term(), .rubbing = 1.0, .velocity = &particles.velocity});
  move_bodies_.run(queue, 1, params, as_float(step.dt), piston, speed, count_, bodies_.memory(),
                   shapes, meshes, step.first_body, fluid.boundary().body_count(),
                   fluid.boundary().steps().memory(), contacts_.memory(), kept_pushes_.memory(),
                   felt_.memory(), force_.memory());
  next_ = static_cast<std::size_t>(step.first_body) +
          static_cast<std::size_t>(fluid.boundary().body_count());
}

void FreeBodies::enqueue_read(Fluid& fluid) {
  steps_read_.resize(static_cast<std::size_t>(fluid.boundary().body_count()));
  fluid.boundary().steps().enqueue_read(fluid.device(), steps_read_, next_);
  force_.enqueue_read(fluid.device(), force_read_);
}

std::vector<FreeBodyEnd> FreeBodies::ends() const {
  std::vector<FreeBodyEnd> ends;
  for (std::size_t k = 0; k < list_.size(); ++k) {
    FreeBodyEnd end;
    end.step = steps_read_[static_cast<std::size_t>(list_[k].body)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      end.force[axis] = static_cast<double>(force_read_[6 * k + axis]);
      end.torque[axis] = static_cast<double>(force_read_[6 * k + 3 + axis]);
    }
    ends.push_back(end);
  }
  return ends;
}

}  // namespace splash::sim
