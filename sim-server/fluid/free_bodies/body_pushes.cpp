// SPDX-License-Identifier: MIT
#include "sim-server/fluid/free_bodies/body_pushes.hpp"

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/parts.hpp"

namespace splash::sim {
namespace {

constexpr std::size_t kSums = 12;  ///< of each body

}  // namespace

BodyPushes::BodyPushes(Fluid& fluid, const std::vector<FreeBody>& bodies,
                       const std::vector<SkinFace>& skin)
    : list_(bodies),
      wanted_(bodies.size(), true),
      count_(static_cast<int>(bodies.size())),
      groups_(fluid.groups()),
      bodies_(fluid.device(), std::span<const FreeBody>(bodies)),
      sums_(fluid.device(), kSums * bodies.size()),
      read_(kSums * bodies.size()) {
  if (fluid.solver().has_pushes()) return;
  Device& device = fluid.device();
  reach_ = Buffer<float>(device, bodies.size() * SPLASH_REACH_FIELDS *
                                     static_cast<std::size_t>(fluid.params().capacity));
  reached_ = Buffer<int>(device, bodies.size() * groups_);
  parts_ = Buffer<float>(device, bodies.size() * SPLASH_PUSH_PARTS * SPLASH_PUSH_ENTRIES);
  const cl::Program program =
      build_program(device, free_body_sources(), kernel_defines(fluid.parts()));
  films_ = Films(device, program, bodies, skin);
  reach_bodies_ = Kernel(program, "reach_bodies", device.profile().group);
  weigh_water_ = Kernel(program, "weigh_water", device.profile().team);
  sum_pushes_ = Kernel(program, "sum_pushes", 1);
}

void BodyPushes::begin(Fluid& fluid, const std::vector<bool>& wanted) {
  wanted_ = wanted;
  sums_.enqueue_clear(fluid.device());
}

void BodyPushes::add(Fluid& fluid, const Step& step) {
  if (fluid.solver().has_pushes()) {
    fluid.add_pushes(step, {list_, bodies_, wanted_, sums_});
  } else {
    add_particles(fluid, step);
  }
}

void BodyPushes::add_particles(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const Boundary& boundary = fluid.boundary();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Buffer<float>& places = fluid.particles().position;
  const auto dt = static_cast<float>(step.dt);
  reach_bodies_.run(queue, list_.size() * groups_,
                    {{"p", params},
                     {"dt", dt},
                     {"free_count", count_},
                     {"frees", bodies_},
                     {"bodies", boundary.steps()},
                     {"first_body", step.first_body},
                     {"cell_start", fluid.grid().cell_start()},
                     {"position", places},
                     {"velocity", fluid.particles().velocity},
                     {"density", fluid.density()},
                     {"images", fluid.body_images()},
                     {"pressure_term", fluid.pressure_term()},
                     {"body_velocity", boundary.points().velocity},
                     {"body_id", boundary.points().id},
                     {"owner", boundary.owner()},
                     {"reach", reach_},
                     {"reached", reached_}},
                    boundary.matter());
  films_.press(fluid, step, {bodies_, fluid.pressure_term(), reach_, reached_});
  weigh_water_.run_teams(queue, list_.size() * SPLASH_PUSH_PARTS,
                         {{"p", params},
                          {"pushing", dt},
                          {"rubbing", dt},
                          {"frees", bodies_},
                          {"bodies", boundary.steps()},
                          {"first_body", step.first_body},
                          {"position", places},
                          {"pressure", fluid.pressure_term()},
                          {"reach", reach_},
                          {"reached", reached_},
                          {"parts", parts_}});
  sum_pushes_.run(queue, list_.size(),
                  {{"body_count", count_},
                   {"bodies", bodies_},
                   {"parts", parts_},
                   {"pressed", films_.pressed() ? dt : 0.0F},
                   {"film", films_.push()},
                   {"sums", sums_}});
}

void BodyPushes::enqueue_read(Fluid& fluid) {
  sums_.enqueue_read(fluid.device(), read_);
}

std::vector<BodyPush> BodyPushes::pushes(double seconds) const {
  std::vector<BodyPush> all;
  for (std::size_t b = 0; b < list_.size(); ++b) {
    BodyPush push;
    push.body = list_[b].body;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto sum = [&](std::size_t field) {
        return static_cast<double>(read_[kSums * b + field + i]) / seconds;
      };
      push.force[i] = sum(0);
      push.torque[i] = sum(3);
      push.by_speed[i] = -sum(6);
      push.by_spin[i] = -sum(9);
    }
    all.push_back(push);
  }
  return all;
}

}  // namespace splash::sim
