// SPDX-License-Identifier: MIT
#include "sim-server/fluid/free_bodies/free_bodies.hpp"

#include <cmath>
#include <utility>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/parts.hpp"

namespace splash::sim {
namespace {

/// Coulomb's coefficients as free_bodies/contact.h wants them: a row for each free body, of its own
/// on what goes its way and on walls, of the geometric mean of both on another free one, but for
/// pairs that have one of theirs.
std::vector<float> friction_table(const std::vector<FreeBody>& bodies, int body_count,
                                  const std::vector<PairFriction>& pairs) {
  const auto across = static_cast<std::size_t>(body_count) + 1;
  std::vector<float> table;
  for (const FreeBody& one : bodies) {
    std::vector<float> row(across, one.friction);
    for (const FreeBody& other : bodies) {
      row[static_cast<std::size_t>(other.body)] = std::sqrt(one.friction * other.friction);
    }
    for (const PairFriction& pair : pairs) {
      for (const auto& [first, second] :
           {std::pair{pair.one, pair.other}, std::pair{pair.other, pair.one}}) {
        if (first != one.body) continue;
        row[second < 0 ? across - 1 : static_cast<std::size_t>(second)] = as_float(pair.friction);
      }
    }
    table.insert(table.end(), row.begin(), row.end());
  }
  return table;
}

}  // namespace

FreeBodies::FreeBodies(Device& device, const FluidParams& params,
                       const std::vector<std::string>& defines, const std::vector<FreeBody>& bodies,
                       const std::vector<SkinFace>& skin, int body_count,
                       const std::vector<PairFriction>& pairs)
    : list_(bodies),
      count_(static_cast<int>(bodies.size())),
      bodies_(device, std::span<const FreeBody>(bodies)),
      answer_(device, 6 * bodies.size()),
      contacts_(device, bodies.size() * SPLASH_CONTACTS * SPLASH_CONTACT_FLOATS * sizeof(float)),
      kept_pushes_(device, bodies.size() * SPLASH_CONTACTS + 1),
      friction_(device, friction_table(bodies, body_count, pairs)),
      felt_(device, 6 * bodies.size()),
      force_(device, 6 * bodies.size()),
      tugs_(device, 6 * bodies.size()),
      anchors_(device, 1),
      force_read_(6 * bodies.size()),
      tugs_read_(6 * bodies.size()) {
  const cl::Program program = build_program(device, kernels::free_bodies(), defines);
  reach_ = BodyReach(device, program, params, bodies.size());
  films_ = Films(device, program, bodies, skin);
  const std::size_t group = device.profile().group;
  const std::size_t team = device.profile().team;
  answer_bodies_ = Kernel(program, "answer_bodies", team);
  carry_water_ = Kernel(program, "carry_water", group);
  keep_out_of_free_ = Kernel(program, "keep_out_of_free", group);
  move_bodies_ = Kernel(program, "move_bodies", 1);
}

void FreeBodies::hang(Device& device, const std::vector<Anchor>& anchors) {
  if (anchors.size() > anchors_.size()) anchors_ = Buffer<Anchor>(device, 2 * anchors.size());
  uploaded_ = anchors;
  anchors_.enqueue_write(device, uploaded_);
}

void FreeBodies::answer(Fluid& fluid, const Step& step) {
  reach_.find(fluid, step, bodies_);
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
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const int first_anchor = step.first_body / fluid.boundary().body_count() * count_;
  if (occasion.falling > 0.0) {
    films_.press(fluid, step, {bodies_, *occasion.pressure, reach_.reach, reach_.reached});
  }
  reach_.weigh(fluid, step, bodies_, *occasion.pressure, occasion.pushing, occasion.rubbing);
  answer_bodies_.run_teams(queue, list_.size(),
                           {{"p", params},
                            {"falling", as_float(occasion.falling)},
                            {"frees", bodies_},
                            {"parts", reach_.parts},
                            {"films", films_.pressed() ? 1 : 0},
                            {"film", films_.push()},
                            {"anchors", anchors_},
                            {"first_anchor", first_anchor},
                            {"answer", answer_},
                            {"felt", felt_},
                            {"tugs", tugs_}},
                           fluid.boundary().steps_at(step));
  carry_water_.run(queue, reach_.groups,
                   {{"p", params},
                    {"free_count", count_},
                    {"factor", as_float(occasion.factor)},
                    {"frees", bodies_},
                    {"answer", answer_},
                    {"position", fluid.particles().position},
                    {"reach", reach_.reach},
                    {"reached", reach_.reached},
                    {"velocity", *occasion.velocity}},
                   fluid.boundary().steps_at(step));
}

void FreeBodies::move(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Boundary& boundary = fluid.boundary();
  const PointArrays& particles = fluid.particles();
  const auto piston = as_float(step.piston);
  const auto speed = as_float(step.piston_speed);
  keep_out_of_free_.run(queue, reach_.groups,
                        {{"p", params},
                         {"dt", as_float(step.dt)},
                         {"piston", piston},
                         {"piston_speed", speed},
                         {"free_count", count_},
                         {"frees", bodies_},
                         {"position_before", fluid.particles_before().position},
                         {"source", fluid.grid().source()},
                         {"position", particles.position},
                         {"velocity", particles.velocity},
                         {"reach", reach_.reach},
                         {"reached", reach_.reached}},
                        boundary.outlines(), boundary.steps_at(step));
  answer(fluid, step,
         {.pressure = &fluid.pressure_term(), .rubbing = 1.0, .velocity = &particles.velocity});
  move_bodies_.run(queue, 1,
                   {{"p", params},
                    {"dt", as_float(step.dt)},
                    {"piston", piston},
                    {"piston_speed", speed},
                    {"free_count", count_},
                    {"frees", bodies_},
                    {"contacts", contacts_},
                    {"kept", kept_pushes_},
                    {"friction", friction_},
                    {"felt", felt_},
                    {"force", force_}},
                   boundary.outlines(), boundary.bodies_at(step));
  next_ = static_cast<std::size_t>(step.first_body) +
          static_cast<std::size_t>(fluid.boundary().body_count());
}

void FreeBodies::enqueue_read(Fluid& fluid) {
  steps_read_.resize(static_cast<std::size_t>(fluid.boundary().body_count()));
  fluid.boundary().steps().enqueue_read(fluid.device(), steps_read_, next_);
  force_.enqueue_read(fluid.device(), force_read_);
  tugs_.enqueue_read(fluid.device(), tugs_read_);
}

std::vector<FreeBodyEnd> FreeBodies::ends() const {
  std::vector<FreeBodyEnd> ends;
  for (std::size_t k = 0; k < list_.size(); ++k) {
    FreeBodyEnd end;
    end.step = steps_read_[static_cast<std::size_t>(list_[k].body)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      end.force[axis] = static_cast<double>(force_read_[6 * k + axis]);
      end.torque[axis] = static_cast<double>(force_read_[6 * k + 3 + axis]);
      end.tug[axis] = static_cast<double>(tugs_read_[6 * k + axis]);
      end.twist[axis] = static_cast<double>(tugs_read_[6 * k + 3 + axis]);
    }
    ends.push_back(end);
  }
  return ends;
}

}  // namespace splash::sim
