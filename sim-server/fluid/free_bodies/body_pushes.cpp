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
      bodies_(fluid.device(), std::span<const FreeBody>(bodies)),
      sums_(fluid.device(), kSums * bodies.size()),
      read_(kSums * bodies.size()) {
  if (fluid.solver().has_pushes()) return;
  Device& device = fluid.device();
  const cl::Program program =
      build_program(device, kernels::free_bodies(), kernel_defines(fluid.parts()));
  reach_ = BodyReach(device, program, fluid.params(), bodies.size());
  films_ = Films(device, program, bodies, skin);
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
  const Buffer<float>& pressure = fluid.pressure_term();
  reach_.find(fluid, step, bodies_);
  films_.press(fluid, step, {bodies_, pressure, reach_.reach, reach_.reached});
  reach_.weigh(fluid, step, bodies_, pressure, step.dt, step.dt);
  sum_pushes_.run(fluid.device().queue(), list_.size(),
                  {{"body_count", count_},
                   {"bodies", bodies_},
                   {"parts", reach_.parts},
                   {"pressed", films_.pressed() ? as_float(step.dt) : 0.0F},
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
