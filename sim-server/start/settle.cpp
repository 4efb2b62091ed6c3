// SPDX-License-Identifier: MIT
#include "sim-server/start/settle.hpp"

#include <algorithm>
#include <cmath>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/pressure/grid_projected/grid_projected.hpp"
#include "sim-server/fluid/random_draw.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> pin();
}  // namespace kernels

namespace {

/// Part of the time that comes first: particles slip past each other into a better packing.
constexpr double kLoose = 0.6;

/// Then all motion is stopped again and again after this long [s]: a quarter of the period in which
/// a column half a metre deep breathes, 4 H / c0, so that what it stores is taken as it comes out.
constexpr double kBetweenStops = 0.025;

/// Then it is left alone for so long [s]: particles creep until they slip, some tenths of a second
/// later, into a better place. It is calm when nothing gets faster meanwhile than this part of the
/// longest wave; else it is stopped and left alone again.
constexpr double kWatch = 0.5;
constexpr double kCalm = 0.05;
/// However restless, it takes this many times what was asked for at most. What gets as fast as the
/// wave itself falls or flows off, and no waiting makes it calm.
constexpr double kMost = 4.0;

constexpr int kTold = 8;  ///< steps between two words on how far it is

/// A step after the other, of a fluid that is to come to rest.
class Settling {
 public:
  Settling(Fluid& fluid, const Step& step, int most, const Progress& tell, PinnedParticles* pinned)
      : fluid_(fluid), step_(step), most_(most), tell_(tell), pinned_(pinned) {}

  void advance() {
    if (tell_ && done_ % kTold == 0) {
      fluid_.device().queue().finish();
      tell_(static_cast<double>(done_) / most_);
    }
    fluid_.prepare(step_);
    fluid_.advance(step_);
    if (pinned_ != nullptr) pinned_->restore();
    ++done_;
  }

  /// Free for so many steps: the fastest that anything was, looked at now and then [m/s].
  double watch(int steps) {
    double fastest = 0.0;
    for (int k = 0; k < steps; ++k) {
      advance();
      if (k % kTold == kTold - 1 || k + 1 == steps) {
        fastest = std::max(fastest, fluid_.stats().speed);
      }
    }
    return fastest;
  }
  [[nodiscard]] int done() const noexcept { return done_; }

 private:
  Fluid& fluid_;
  Step step_;
  int most_;
  const Progress& tell_;
  PinnedParticles* pinned_;
  int done_ = 0;
};

}  // namespace

PinnedParticles::PinnedParticles(Fluid& fluid, const std::vector<bool>& kept)
    : fluid_(fluid),
      particles_(kept.size()),
      kept_count_(static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true))) {
  if (is_empty()) return;
  const Snapshot now = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  std::vector<float> place(now.position.size());
  for (std::size_t i = 0; i < now.id.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis * stride + static_cast<std::size_t>(now.id[i])] = now.position[axis * stride + i];
    }
  }
  kept_ = Buffer<int>(fluid.device(), std::vector<int>(kept.begin(), kept.end()));
  place_ = Buffer<float>(fluid.device(), place);
  put_back_ = Kernel(build_program(fluid.device(), kernels::pin(), {}), "put_back");
}

void PinnedParticles::restore() {
  if (is_empty()) return;
  const PointArrays& water = fluid_.particles();
  put_back_.run(fluid_.device().queue(), particles_,
                {{"p", fluid_.params_buffer()},
                 {"kept", kept_},
                 {"place", place_},
                 {"id", water.id},
                 {"position", water.position},
                 {"velocity", water.velocity}});
}

std::vector<BodyStep> at_rest(std::vector<BodyStep> bodies) {
  for (BodyStep& body : bodies) {
    body.vx = body.vy = body.vz = 0.0F;
    body.wx = body.wy = body.wz = body.speed = 0.0F;
  }
  return bodies;
}

void settle(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double seconds,
            double dt, const Progress& tell, PinnedParticles* pinned) {
  fluid.set_bodies(bodies);
  if (pinned != nullptr && pinned->has_all()) return;
  const int steps = static_cast<int>(seconds / dt);
  const int most = static_cast<int>(kMost * seconds / dt);
  const int between = std::max(1, static_cast<int>(kBetweenStops / dt));
  const int watched = std::max(1, static_cast<int>(kWatch / dt));
  Settling water(fluid, {dt, piston, 0.0, 0}, most, tell, pinned);
  for (int k = 0; k < steps; ++k) {
    water.advance();
    if (k > kLoose * steps && k % between == 0) fluid.zero_velocities();
  }
  fluid.zero_velocities();
  const double wave = static_cast<double>(fluid.params().wave_speed);
  for (bool restless = wave > 0.0; restless && water.done() + watched <= most;
       fluid.zero_velocities()) {
    const double fastest = water.watch(watched);
    restless = fastest > kCalm * wave && fastest < wave;
  }
}

namespace {

/// Of the cube of the lattice that a particle is in the middle of [spacings].
constexpr double kHalfCube = 0.5;

/// Enough for the state equation's pressures to fade: after 100 and after 300 a drop of ten
/// spacings in radius is the same to 1e-5 of its size.
constexpr int kPackingSteps = 100;

/// As many as move particles that press as far. A step from rest moves them by dt^2 a, in
/// proportion to the square of the way that sound goes in it; the grid's spacing has its own sound.
int packing_steps(const FluidParams& params) {
  if (params.solver != SPLASH_GRID_PROJECTED) return kPackingSteps;
  const double longer = static_cast<double>(params.advective_cfl) / kGridAdvectiveCfl;
  const double way = kSpacingWay / kAcousticCfl;
  return static_cast<int>(std::ceil(kPackingSteps / (longer * way * way)));
}

/// Uniform on [-1, 1) along each axis.
Vector3 displacement(std::uint32_t seed, int particle) {
  const auto shares = random_draw({static_cast<std::uint32_t>(particle), 0U, 0U, 0U},
                                  {seed, 0x7061636BU});  // "pack"
  return {2.0 * shares[0] - 1.0, 2.0 * shares[1] - 1.0, 2.0 * shares[2] - 1.0};
}

void scatter(Fluid& fluid, const std::vector<bool>& loose, std::uint32_t seed) {
  Snapshot state = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const double most = kHalfCube * static_cast<double>(fluid.params().spacing);
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    if (!loose[static_cast<std::size_t>(state.id[i])]) continue;
    const Vector3 way = most * displacement(seed, state.id[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state.position[axis * stride + i] += static_cast<float>(way[axis]);
    }
  }
  fluid.restore(state);
}

}  // namespace

void pack(Fluid& fluid, const std::vector<BodyStep>& bodies, double piston, double dt,
          const std::vector<bool>& loose, std::uint32_t seed) {
  if (std::find(loose.begin(), loose.end(), true) == loose.end()) return;
  std::vector<bool> others = loose;
  others.flip();
  PinnedParticles rest(fluid, others);
  scatter(fluid, loose, seed);
  fluid.set_bodies(bodies);
  fluid.disable_gravity();
  const int steps = packing_steps(fluid.params());
  for (int k = 0; k < steps; ++k) {
    const Step step = {dt, piston, 0.0, 0};
    fluid.prepare(step);
    fluid.advance(step);
    fluid.zero_velocities();
    rest.restore();
  }
  fluid.enable_gravity();
}

}  // namespace splash::sim
