// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kGravity = 9.81;  ///< [m/s2]

/// Of a solve, at most.
constexpr int kIterations = 40;
/// Of one for how bodies' pushes change: its error counts by its square (felt.cl).
constexpr int kAnswerIterations = 4;

std::size_t cells_in(const MacGrid& grid) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.nx + 1) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Two cells with vectors, one without (gather.cl).
std::size_t strips_in(const MacGrid& grid, const Device& device) {
  const MacLevel& level = grid.level[0];
  const int across = level.nx / (device.lanes() > 1 ? 2 : 1) + 1;
  return static_cast<std::size_t>(across) * static_cast<std::size_t>(level.ny + 1) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Vectors of cells from the lowest layer to the one above the last (mac_cell.h).
std::size_t vectors_in(const MacGrid& grid, const Device& device) {
  const MacLevel& level = grid.level[0];
  return static_cast<std::size_t>(level.layer / device.lanes()) *
         static_cast<std::size_t>(level.nz + 1);
}

/// Work-items of the work-group that solves.
std::size_t solvers(const Device& device) {
  return device.profile().team > 1 ? device.profile().judges : 1;
}

}  // namespace

double filter_rate(double spacing) {
  return 0.5 * std::sqrt(kGravity / spacing);
}

GridProjected::GridProjected(Device& device, const FluidParams& params,
                             const std::vector<std::string>& defines, bool solids)
    : grid_(lay_mac_grid(params)),
      part_(static_cast<double>(params.advective_cfl) / kGridAdvectiveCfl),
      particles_(static_cast<std::size_t>(params.count)),
      cells_(cells_in(grid_)),
      strips_(strips_in(grid_, device)),
      vectors_(vectors_in(grid_, device)),
      room_(mac_room(grid_)),
      grid_buffer_(device, std::span<const MacGrid>(&grid_, 1)),
      mean_(device, 3 * room_),
      weight_(device, 3 * room_),
      fill_(device, room_),
      deviation_(device, 3 * static_cast<std::size_t>(params.capacity)),
      seen_(device, 3 * room_),
      change_(device, 3 * room_),
      carried_(device, 3 * static_cast<std::size_t>(params.capacity)),
      pressure_(device, room_),
      wet_(device, room_),
      most_(device, 1),
      solids_(solids),
      gap_(device, solids ? 3 * room_ : 1),
      upper_(device, solids ? 3 * room_ : 1),
      space_(device, solids ? room_ : 1),
      owner_(device, solids ? room_ : 1),
      seen_space_(device, solids ? room_ : 1),
      filled_(device, solids ? room_ : 1),
      no_body_(device, 1),
      grip_(device, 1),
      stopped_(device, 1),
      tied_(device, 1),
      tuggings_(device, 1),
      felt_grip_(device, 1),
      surface_(device, 1),
      answer_(device, 1),
      answer_state_(device, 1),
      jolt_(device, 1),
      given_(device, 1),
      taken_(device, 1),
      whose_(device, 1),
      parts_(device, 1),
      link_(device, 3 * room_),
      open_(device, room_),
      damped_(device, room_),
      x_(device, room_),
      b_(device, room_),
      r_(device, room_),
      found_(device, room_),
      way_(device, room_),
      along_(device, room_),
      state_(device, 1),
      state_read_{} {
  const cl::Program program = build_program(device, grid_projected_sources(), defines);
  const std::size_t group = device.profile().group;
  gather_faces_ = Kernel(program, "gather_faces");
  gather_again_ = Kernel(program, "gather_again");
  find_deviation_ = Kernel(program, "find_deviation", group);
  cut_cells_ = Kernel(program, "cut_cells", std::min<std::size_t>(group, 16));
  open_faces_ = Kernel(program, "open_faces", group);
  fill_beside_solids_ = Kernel(program, "fill_beside_solids", group);
  let_fall_ = Kernel(program, "let_fall", 1);
  grip_water_ = Kernel(program, "grip_water");
  push_bodies_ = Kernel(program, "push_bodies", solvers(device));
  tie_bodies_ = Kernel(program, "tie_bodies", 1);
  tell_tugs_ = Kernel(program, "tell_tugs", 1);
  weigh_pressure_ = Kernel(program, "weigh_pressure", solvers(device));
  ask_for_answer_ = Kernel(program, "ask_for_answer");
  weigh_answer_ = Kernel(program, "weigh_answer", solvers(device));
  mark_faces_ = Kernel(program, "mark_faces");
  weigh_faces_ = Kernel(program, "weigh_faces", solvers(device));
  weigh_given_ = Kernel(program, "weigh_given", device.profile().team);
  sum_given_ = Kernel(program, "sum_given", 1);
  push_faces_ = Kernel(program, "push_faces", group);
  lay_system_ = Kernel(program, "lay_system", group);
  solve_pressure_ = Kernel(program, "solve_pressure", solvers(device));
  project_faces_ = Kernel(program, "project_faces", group);
  find_spacing_ = Kernel(program, "find_spacing", group);
  move_particles_ = Kernel(program, "move_particles", group);
  sample_pressure_ = Kernel(program, "sample_pressure", group);
}

void GridProjected::release(Device& device, std::size_t count) {
  grip_ = Buffer<float>(device, 6 * room_);
  stopped_ = Buffer<float>(device, SPLASH_KEPT_FLOATS * count);
  tied_ = Buffer<FreeBody>(device, count);
  tuggings_ = Buffer<float>(device, SPLASH_TUG_FLOATS * count);
}

void GridProjected::recall_pressure(Fluid& fluid, const Step& step) {
  if (step.dt > 0.0) return;
  sample_pressure_.run(fluid.device().queue(), fluid.groups(),
                       {{"p", fluid.params_buffer()},
                        {"g", grid_buffer_},
                        {"position", fluid.particles().position},
                        {"density", fluid.density()},
                        {"wet", wet_},
                        {"pressure", pressure_},
                        {"term", fluid.pressure_term()}});
}

void GridProjected::accelerate(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const PointArrays& particles = fluid.particles();
  const Boundary& boundary = fluid.boundary();
  const Buffer<int>& cells = fluid.grid().cell_start();
  const Buffer<float>& places = particles.position;
  gather_faces_.run(queue, strips_,
                    {{"p", params},
                     {"g", grid_buffer_},
                     {"cell_start", cells},
                     {"position", places},
                     {"value", particles.velocity},
                     {"mean", mean_},
                     {"weight", weight_},
                     {"fill", fill_}});
  find_deviation_.run(queue, fluid.groups(),
                      {{"p", params},
                       {"g", grid_buffer_},
                       {"position", particles.position},
                       {"velocity", particles.velocity},
                       {"mean", mean_},
                       {"deviation", deviation_}});
  gather_again_.run(queue, strips_,
                    {{"p", params},
                     {"g", grid_buffer_},
                     {"cell_start", cells},
                     {"position", places},
                     {"value", deviation_},
                     {"weight", weight_},
                     {"mean", seen_}});
  if (solids_) place_solids(fluid, step);
  solve(fluid, step);
  const double sound = kSpacingWay * static_cast<double>(fluid.params().support) / step.dt;
  const double slower = sound / static_cast<double>(fluid.params().sound_speed);
  find_spacing_.run(queue, fluid.groups(),
                    {{"p", params},
                     {"slower", as_float(part_ * slower * slower)},
                     {"cell_start", fluid.grid().cell_start()},
                     {"position", particles.position},
                     {"term", fluid.pressure_term()},
                     {"images", fluid.body_images()},
                     {"body_start", boundary.grid().cell_start()},
                     {"body_position", boundary.points().position},
                     {"body_volume", boundary.volume()},
                     {"body_stride", boundary.points().stride},
                     {"bodies", boundary.steps()},
                     {"first_body", step.first_body},
                     {"body_count", boundary.body_count()},
                     {"piston", as_float(step.piston)},
                     {"acceleration", fluid.acceleration()},
                     {"moving", fluid.moving()},
                     {"feels", static_cast<int>(feels_)},
                     {"by_bodies", jolt_}});
}

void GridProjected::place_solids(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Boundary& boundary = fluid.boundary();
  cut_cells_.run(queue, vectors_,
                 {{"p", params},
                  {"g", grid_buffer_},
                  {"shapes", boundary.shapes()},
                  {"meshes", boundary.meshes()},
                  {"bodies", boundary.steps()},
                  {"first_body", step.first_body},
                  {"body_count", boundary.body_count()},
                  {"piston", as_float(step.piston)},
                  {"lower", gap_},
                  {"upper", upper_},
                  {"room", space_},
                  {"owner", owner_}});
  open_faces_.run(queue, vectors_,
                  {{"p", params},
                   {"g", grid_buffer_},
                   {"owner", owner_},
                   {"upper", upper_},
                   {"room", space_},
                   {"gap", gap_},
                   {"seen", seen_space_}});
  fill_beside_solids_.run(queue, vectors_,
                          {{"g", grid_buffer_},
                           {"gap", gap_},
                           {"room", space_},
                           {"seen", seen_space_},
                           {"fill", fill_},
                           {"filled", filled_}});
}

int GridProjected::free_count(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies == nullptr ? 0 : static_cast<int>(bodies->bodies().size());
}

const Buffer<FreeBody>& GridProjected::frees(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies == nullptr ? no_body_ : bodies->on_device();
}

bool GridProjected::has_hung(Fluid& fluid) const {
  const FreeBodies* bodies = fluid.free_bodies();
  return bodies != nullptr && std::any_of(bodies->bodies().begin(), bodies->bodies().end(),
                                          [](const FreeBody& body) { return body.spring > 0.0F; });
}

const Buffer<FreeBody>& GridProjected::solved_frees(Fluid& fluid) const {
  return has_hung(fluid) ? tied_ : frees(fluid);
}

void GridProjected::let_fall(Fluid& fluid, const Step& step) {
  const int count = free_count(fluid);
  let_fall_.run(fluid.device().queue(), static_cast<std::size_t>(count),
                {{"p", fluid.params_buffer()},
                 {"dt", as_float(step.dt)},
                 {"free_count", count},
                 {"frees", frees(fluid)},
                 {"bodies", fluid.boundary().steps()},
                 {"first_body", step.first_body},
                 {"kept", stopped_}});
  if (!has_hung(fluid)) return;
  const int first_anchor = step.first_body / fluid.boundary().body_count() * count;
  tie_bodies_.run(fluid.device().queue(), static_cast<std::size_t>(count),
                  {{"p", fluid.params_buffer()},
                   {"dt", as_float(step.dt)},
                   {"free_count", count},
                   {"frees", frees(fluid)},
                   {"bodies", fluid.boundary().steps()},
                   {"first_body", step.first_body},
                   {"kept", stopped_},
                   {"anchors", fluid.free_bodies()->anchors()},
                   {"first_anchor", first_anchor},
                   {"tied", tied_},
                   {"tuggings", tuggings_}});
}

void GridProjected::push_bodies(Fluid& fluid, const Step& step) {
  push_bodies_.run_teams(fluid.device().queue(), 1,
                         {{"p", fluid.params_buffer()},
                          {"g", grid_buffer_},
                          {"free_count", free_count(fluid)},
                          {"frees", solved_frees(fluid)},
                          {"bodies", fluid.boundary().steps()},
                          {"first_body", step.first_body},
                          {"owner", owner_},
                          {"grip", grip_},
                          {"found", found_},
                          {"kept", stopped_},
                          {"felt", fluid.free_bodies()->felt()}});
  if (!has_hung(fluid)) return;
  const auto count = static_cast<std::size_t>(free_count(fluid));
  tell_tugs_.run(fluid.device().queue(), count,
                 {{"free_count", free_count(fluid)},
                  {"frees", frees(fluid)},
                  {"bodies", fluid.boundary().steps()},
                  {"first_body", step.first_body},
                  {"tuggings", tuggings_},
                  {"tugs", fluid.free_bodies()->tugs()}});
}

void GridProjected::solve(Fluid& fluid, const Step& step) {
  const float dt = as_float(step.dt);
  cl::CommandQueue& queue = fluid.device().queue();
  const Buffer<FluidParams>& params = fluid.params_buffer();
  const Buffer<BodyStep>& bodies = fluid.boundary().steps();
  const auto room = static_cast<int>(room_);
  const int free = free_count(fluid);
  const Buffer<float>& fill = solids_ ? filled_ : fill_;
  push_faces_.run(queue, vectors_,
                  {{"p", params},
                   {"g", grid_buffer_},
                   {"dt", dt},
                   {"mean", mean_},
                   {"weight", weight_},
                   {"pushed", change_},
                   {"most", most_}});
  if (free > 0) let_fall(fluid, step);
  lay_system_.run(queue, vectors_,
                  {{"p", params},
                   {"g", grid_buffer_},
                   {"dt", dt},
                   {"bodies", bodies},
                   {"first_body", step.first_body},
                   {"piston_speed", as_float(step.piston_speed)},
                   {"gap", gap_},
                   {"owner", owner_},
                   {"fill", fill},
                   {"pushed", change_},
                   {"pressure", pressure_},
                   {"room", room},
                   {"link", link_},
                   {"open", open_},
                   {"x", x_},
                   {"right", b_},
                   {"rest", r_},
                   {"start", found_},
                   {"way", way_},
                   {"wet", wet_},
                   {"most", most_}});
  if (free > 0) {
    grip_water_.run(queue, cells_,
                    {{"g", grid_buffer_},
                     {"free_count", free},
                     {"frees", frees(fluid)},
                     {"bodies", bodies},
                     {"first_body", step.first_body},
                     {"gap", gap_},
                     {"owner", owner_},
                     {"wet", wet_},
                     {"grip", grip_}});
  }
  if (feels_) {
    queue.enqueueCopyBuffer(open_.memory(), surface_.memory(), 0, 0, room_ * sizeof(float));
  }
  run_solve(fluid, step, kIterations, found_, state_);
  if (free > 0) push_bodies(fluid, step);
  project_faces_.run(queue, vectors_,
                     {{"p", params},
                      {"g", grid_buffer_},
                      {"dt", dt},
                      {"gap", gap_},
                      {"fill", fill},
                      {"mean", mean_},
                      {"weight", weight_},
                      {"found", found_},
                      {"wet", wet_},
                      {"pushed", change_},
                      {"pressure", pressure_}});
}

void GridProjected::run_solve(Fluid& fluid, const Step& step, int iterations,
                              const Buffer<float>& found, const Buffer<SolveState>& state) {
  solve_pressure_.run_teams(fluid.device().queue(), 1,
                            {{"p", fluid.params_buffer()},
                             {"g", grid_buffer_},
                             {"iterations", iterations},
                             {"room", static_cast<int>(room_)},
                             {"free_count", free_count(fluid)},
                             {"frees", solved_frees(fluid)},
                             {"bodies", fluid.boundary().steps()},
                             {"first_body", step.first_body},
                             {"owner", owner_},
                             {"grip", grip_},
                             {"most", most_},
                             {"link", link_},
                             {"open", open_},
                             {"damped", damped_},
                             {"x", x_},
                             {"b", b_},
                             {"r", r_},
                             {"found", found},
                             {"way", way_},
                             {"along", along_},
                             {"state", state}});
}

void GridProjected::feel(Device& device, bool on) {
  feels_ = on && solids_;
  if (!feels_ || surface_.size() == room_) return;
  felt_grip_ = Buffer<float>(device, 6 * room_);
  surface_ = Buffer<float>(device, room_);
  answer_ = Buffer<float>(device, room_);
  jolt_ = Buffer<float>(device, carried_.size());
  given_ = Buffer<float>(device, 3 * room_);
  taken_ = Buffer<float>(device, 3 * room_);
  whose_ = Buffer<float>(device, 3 * room_);
}

void GridProjected::add_pushes(Fluid& /*fluid*/, const Step& /*step*/, const FeltBodies& felt) {
  if (feels_) felt_now_.emplace(felt);
}

void GridProjected::move(Fluid& fluid, const Step& step) {
  const double rate = filter_rate(static_cast<double>(fluid.params().spacing));
  move_particles_.run(fluid.device().queue(), fluid.groups(),
                      {{"p", fluid.params_buffer()},
                       {"g", grid_buffer_},
                       {"dt", as_float(step.dt)},
                       {"filtered", as_float(-std::expm1(-rate * step.dt))},
                       {"kick", as_float(part_ * kSpacingKick)},
                       {"piston", as_float(step.piston)},
                       {"piston_speed", as_float(step.piston_speed)},
                       {"shapes", fluid.boundary().shapes()},
                       {"meshes", fluid.boundary().meshes()},
                       {"bodies", fluid.boundary().steps()},
                       {"first_body", step.first_body},
                       {"body_count", fluid.boundary().body_count()},
                       {"change", change_},
                       {"seen", seen_},
                       {"deviation", deviation_},
                       {"acceleration", fluid.acceleration()},
                       {"position", fluid.particles().position},
                       {"velocity", fluid.particles().velocity},
                       {"carried", carried_},
                       {"feels", static_cast<int>(feels_)},
                       {"jolt", jolt_}});
  if (felt_now_) weigh_felt(fluid, step);
  felt_now_.reset();
}

void GridProjected::weigh_felt(Fluid& fluid, const Step& step) {
  cl::CommandQueue& queue = fluid.device().queue();
  const FeltBodies& felt = *felt_now_;
  const int count = static_cast<int>(felt.list.size());
  const std::size_t entries = felt.list.size() * 6 * (SPLASH_PUSH_PARTS + 1);
  if (parts_.size() != entries) parts_ = Buffer<float>(fluid.device(), entries);
  grip_water_.run(queue, cells_,
                  {{"g", grid_buffer_},
                   {"free_count", count},
                   {"frees", felt.on_device},
                   {"bodies", fluid.boundary().steps()},
                   {"first_body", step.first_body},
                   {"gap", gap_},
                   {"owner", owner_},
                   {"wet", wet_},
                   {"grip", felt_grip_}});
  weigh_pressure_.run_teams(queue, 1,
                            {{"p", fluid.params_buffer()},
                             {"g", grid_buffer_},
                             {"body_count", count},
                             {"felt", felt.on_device},
                             {"bodies", fluid.boundary().steps()},
                             {"first_body", step.first_body},
                             {"owner", owner_},
                             {"grip", felt_grip_},
                             {"found", found_},
                             {"sums", felt.sums}});
  weigh_given(fluid, step, found_, -1, 0);
  for (int k = 0; k < count; ++k) {
    for (int part = 0; felt.wanted[static_cast<std::size_t>(k)] && part < 6; ++part) {
      ask_for_answer_.run(queue, cells_,
                          {{"g", grid_buffer_},
                           {"k", k},
                           {"part", part},
                           {"felt", felt.on_device},
                           {"owner", owner_},
                           {"grip", felt_grip_},
                           {"surface", surface_},
                           {"open", open_},
                           {"x", x_},
                           {"right", b_},
                           {"rest", r_},
                           {"start", answer_},
                           {"way", way_}});
      run_solve(fluid, step, kAnswerIterations, answer_, answer_state_);
      weigh_answer_.run_teams(queue, 1,
                              {{"p", fluid.params_buffer()},
                               {"g", grid_buffer_},
                               {"k", k},
                               {"part", part},
                               {"body_count", count},
                               {"felt", felt.on_device},
                               {"bodies", fluid.boundary().steps()},
                               {"first_body", step.first_body},
                               {"owner", owner_},
                               {"grip", felt_grip_},
                               {"found", answer_},
                               {"sums", felt.sums}});
      weigh_given(fluid, step, answer_, k, part);
    }
  }
}

void GridProjected::weigh_given(Fluid& fluid, const Step& step, const Buffer<float>& found,
                                int only, int part) {
  cl::CommandQueue& queue = fluid.device().queue();
  const std::size_t count = felt_now_->list.size();
  const KernelArg felt = {"felt", felt_now_->on_device};
  const KernelArg felt_count = {"felt_count", static_cast<int>(count)};
  mark_faces_.run(queue, cells_,
                  {{"p", fluid.params_buffer()},
                   {"g", grid_buffer_},
                   {"falls", only < 0 ? as_float(step.dt) : 0.0F},
                   felt_count,
                   felt,
                   {"bodies", fluid.boundary().steps()},
                   {"first_body", step.first_body},
                   {"owner", owner_},
                   {"gap", gap_},
                   {"fill", filled_},
                   {"wet", wet_},
                   {"found", found},
                   {"change", change_},
                   {"given", given_},
                   {"taken", taken_},
                   {"whose", whose_}});
  weigh_faces_.run_teams(queue, 1,
                         {{"g", grid_buffer_},
                          felt_count,
                          {"only", only},
                          felt,
                          {"bodies", fluid.boundary().steps()},
                          {"first_body", step.first_body},
                          {"taken", taken_},
                          {"whose", whose_},
                          {"parts", parts_}});
  weigh_given_.run_teams(queue, count * SPLASH_PUSH_PARTS,
                         {{"p", fluid.params_buffer()},
                          {"g", grid_buffer_},
                          {"dt", as_float(step.dt)},
                          {"only", only},
                          {"counts", static_cast<int>(only < 0)},
                          felt,
                          {"change", change_},
                          {"given", given_},
                          {"whose", whose_},
                          {"position", fluid.particles().position},
                          {"carried", carried_},
                          {"jolt", jolt_},
                          {"parts", parts_}},
                         fluid.boundary().outlines(), fluid.boundary().bodies_at(step));
  sum_given_.run(queue, count,
                 {felt_count,
                  {"only", only},
                  {"part", part},
                  felt,
                  {"parts", parts_},
                  {"sums", felt_now_->sums}});
}

const Buffer<float>& GridProjected::carried(const Fluid& /*fluid*/) const {
  return carried_;
}

// As coupling.h does it for those that the water moves: - p V K.
std::vector<Press> GridProjected::press(Device& device, std::size_t bodies) {
  std::vector<Press> all(bodies);
  if (!solids_) return all;
  const MacLevel& l = grid_.level[0];
  const auto cells = static_cast<std::size_t>(l.cells);
  const std::vector<float> gap = gap_.read(device, 3 * cells);
  const std::vector<float> pressure = pressure_.read(device, cells);
  const std::vector<int> owner = owner_.read(device, cells);
  const std::array<std::size_t, 3> step = {1, static_cast<std::size_t>(l.row),
                                           static_cast<std::size_t>(l.layer)};
  const Vector3 lower = {static_cast<double>(grid_.x), static_cast<double>(grid_.y),
                         static_cast<double>(grid_.z)};
  const Vector3 edge = {static_cast<double>(grid_.hx), static_cast<double>(grid_.hy),
                        static_cast<double>(grid_.hz)};
  for (std::size_t c = step[2]; c + step[2] < cells; ++c) {
    if (owner[c] < 0 || static_cast<std::size_t>(owner[c]) >= bodies || pressure[c] == 0.0F) {
      continue;
    }
    Press& press = all[static_cast<std::size_t>(owner[c])];
    const std::array<std::size_t, 3> at = {c % step[2] % step[1], c % step[2] / step[1],
                                           c / step[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double area = edge[0] * edge[1] * edge[2] / edge[axis];
      const std::size_t face = axis * cells + c;
      for (const std::size_t side : {0U, 1U}) {
        Vector3 place;
        for (std::size_t k = 0; k < 3; ++k) {
          const double off = k == axis ? static_cast<double>(side) : 0.5;
          place[k] = lower[k] + (static_cast<double>(at[k]) - 1.0 + off) * edge[k];
        }
        Vector3 force = {0.0, 0.0, 0.0};
        force[axis] = (side == 0U ? 1.0 : -1.0) * area * static_cast<double>(pressure[c]) *
                      static_cast<double>(gap[face + side * step[axis]]);
        press.force = press.force + force;
        press.torque = press.torque + cross(place, force);
      }
    }
  }
  return all;
}

void GridProjected::enqueue_work(Device& device) {
  state_.enqueue_read(device, state_read_);
}

SolveWork GridProjected::work() const {
  const SolveState& s = state_read_[0];
  return {s.solves, s.total, s.most, s.given_up, static_cast<double>(s.error)};
}

void GridProjected::forget_work(Device& device) {
  state_.enqueue_clear(device);
  state_read_ = {};
}

void GridProjected::forget_pressure(Device& device) {
  pressure_.enqueue_clear(device);
  wet_.enqueue_clear(device);
  stopped_.enqueue_clear(device);
  note_recalled(device);
}

// What a step that went wrong left in its own arrays would go on from one to the next.
void GridProjected::note_recalled(Device& device) {
  for (Buffer<float>* array :
       {&link_, &open_, &damped_, &x_, &b_, &r_, &found_, &way_, &along_, &answer_}) {
    array->enqueue_clear(device);
  }
}

}  // namespace splash::sim
