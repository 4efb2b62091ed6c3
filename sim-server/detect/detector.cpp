// SPDX-License-Identifier: MIT
#include "sim-server/detect/detector.hpp"

#include <algorithm>

#include "sim-server/detect/added_mass.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> detect();
}  // namespace kernels

namespace {

/// A point that nobody has looked at yet.
Touch unseen() {
  Touch touch = {};
  touch.nz = -1.0F;
  return touch;
}

/// Bubbles alive at once: the paper's scenes hold 1 to 6 per cent of the particles.
std::size_t bubble_room(int particles) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(particles) / 4, 1024, 65536);
}

cl::Program build(Device& device) {
  return build_program(device, kernels::detect(), {});
}

std::vector<float> places(const std::vector<SkinPoint>& skin) {
  std::vector<float> all;
  for (const SkinPoint& point : skin) {
    for (const double part : point.place) all.push_back(static_cast<float>(part));
  }
  return all;
}

/// `seen`: the least distance that they look [m].
std::vector<float> facings(const std::vector<SkinPoint>& skin, const std::vector<double>& faces,
                           double seen) {
  std::vector<float> all;
  for (const SkinPoint& point : skin) {
    for (const double part : point.normal) all.push_back(static_cast<float>(part));
    const double face = faces[static_cast<std::size_t>(point.owner)];
    all.push_back(static_cast<float>(std::max(reach_of_blow(face), seen)));
  }
  return all;
}

std::vector<int> owners(const std::vector<SkinPoint>& skin) {
  std::vector<int> owners;
  for (const SkinPoint& point : skin) owners.push_back(point.owner);
  return owners;
}

/// By how much SurfaceDistance tells the water's surface too near [m]: it expects the outermost
/// particles to lie kSurfaceLoss deeper than half a spacing, which on a grid they do not.
double seems_nearer(const FluidParams& p) {
  const bool grid = p.solver == SPLASH_GRID_PROJECTED;
  return grid ? kSurfaceLoss * static_cast<double>(p.spacing) : 0.0;
}

SurfaceDistance distance_of(const FluidParams& p) {
  return {static_cast<double>(p.spacing), static_cast<double>(p.support),
          static_cast<double>(p.layer_weight)};
}

}  // namespace

Detector::Detector(Fluid& fluid, const std::vector<SkinPoint>& skin, const DetectSettings& settings,
                   int seed, bool search_always)
    : fluid_(fluid),
      settings_(settings),
      points_(skin),
      faces_(faces_of(skin, static_cast<std::size_t>(fluid.boundary().body_count()))),
      skin_(fluid.device(), places(points_)),
      facing_(fluid.device(), facings(points_, faces_,
                                      kSpacingsSeen * static_cast<double>(fluid.params().spacing))),
      owner_(fluid.device(), owners(points_)),
      touches_(fluid.device(), points_.size()),
      mean_density_(fluid.device(), points_.empty() ? 1 : fluid.water_density().size()),
      touches_read_(points_.size(), unseen()),
      program_(build(fluid.device())),
      average_density_(program_, "average_density"),
      touch_water_(program_, "touch_water"),
      bubbles_(fluid, program_, settings, seed, bubble_room(fluid.params().count)),
      impacts_(faces_, settings, distance_of(fluid.params()), seems_nearer(fluid.params())),
      wakes_(gravity_of(fluid.params()), static_cast<double>(fluid.params().rest_density),
             fluid.params().count) {
  if (!settings.cavity_by_count) return;
  cavities_.emplace(fluid, program_, settings, bubble_room(fluid.params().count), search_always);
}

void Detector::enqueue(const Step& step, double frame, const Passes& passes) {
  touched_ = passes.contacts && !points_.empty();
  if (touched_) {
    enqueue_contacts(step);
  } else {
    for (Touch& touch : touches_read_) touch.colour = touch.gx = touch.gy = touch.gz = 0.0F;
  }
  if (passes.bubbles) {
    bubbles_.enqueue(step, frame);
  } else {
    bubbles_.skip();
  }
}

void Detector::enqueue_read() {
  if (touched_) touches_.enqueue_read(fluid_.device(), touches_read_);
  bubbles_.enqueue_read();
}

void Detector::rehearse(const Step& step) {
  bubbles_.pool().resize(1);
  enqueue(step, step.dt);
  if (cavities_) cavities_->rehearse(bubbles_);
  bubbles_.pool().clear();
  bubbles_.skip();
}

void Detector::enqueue_contacts(const Step& step) {
  const int count = fluid_.params().count;
  average_density_.run(fluid_.device().queue(), static_cast<std::size_t>(count),
                       {{"p", fluid_.params_buffer()},
                        {"cell_start", fluid_.grid().cell_start()},
                        {"position", fluid_.particles().position},
                        {"density", fluid_.water_density()},
                        {"count", count},
                        {"mean", mean_density_}},
                       fluid_.boundary().bodies_at(step));
  touch_water_.run(fluid_.device().queue(), points_.size(),
                   {{"p", fluid_.params_buffer()},
                    {"cell_start", fluid_.grid().cell_start()},
                    {"position", fluid_.particles().position},
                    {"velocity", fluid_.particles().velocity},
                    {"density", mean_density_},
                    {"points", static_cast<int>(points_.size())},
                    {"skin", skin_},
                    {"facing", facing_},
                    {"owner", owner_},
                    {"piston", static_cast<float>(step.piston)},
                    {"out", touches_}},
                   fluid_.boundary().steps_at(step));
}

void Detector::forget() {
  bubbles_.forget();
  impacts_.forget();
  wakes_.forget();
}

void Detector::set(const DetectSettings& settings) {
  settings_ = settings;
  bubbles_.set(settings);
  if (cavities_) cavities_->set(settings);
  impacts_.set(settings);
}

std::vector<Vector3> Detector::bubble_places() const {
  std::vector<Vector3> places;
  for (const PoolBubble& bubble : bubbles_.pool()) places.push_back(bubble.position);
  return places;
}

std::vector<SurfacePoint> Detector::surface() const {
  std::vector<SurfacePoint> points;
  points.reserve(touches_read_.size());
  for (std::size_t s = 0; s < touches_read_.size(); ++s) {
    points.push_back({points_[s].owner, points_[s].area, touches_read_[s]});
  }
  return points;
}

Detections Detector::collect(double time, double frame, std::uint32_t step) {
  Detections found;
  std::vector<SurfacePoint> skin = surface();
  found.impacts = impacts_.observe(time, frame, skin);
  if (!touched_) skin.clear();  // how fast it was is not known
  found.bubbles =
      bubbles_.collect(time, frame, step, wakes_.observe(time, frame, skin, impacts_, settings_));
  if (cavities_) found.cavities = cavities_->search(time, bubbles_);
  bubbles_.renew(time);
  return found;
}

}  // namespace splash::sim
