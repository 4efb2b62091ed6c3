// SPDX-License-Identifier: MIT
#include "sim-server/detect/detector.hpp"

#include <algorithm>

#include "sim-server/fluid/kernel_sources.hpp"
#include "sim-server/fluid/set_up.hpp"

namespace splash::sim {
namespace kernels {
std::vector<KernelSource> detect();
}  // namespace kernels

namespace {

static_assert(sizeof(Touch) == 64);

/// Bubbles alive at once: the paper's scenes hold 1 to 6 per cent of the particles.
std::size_t bubble_room(int particles) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(particles) / 4, 1024, 65536);
}

cl::Program build(Device& device) {
  std::vector<KernelSource> sources = fluid_sources();
  const std::vector<KernelSource> own = kernels::detect();
  sources.insert(sources.end(), own.begin(), own.end());
  return build_program(device, sources, {}, false);
}

std::vector<BodyPoint> surface_of(const std::vector<BodyPoint>& points) {
  std::vector<BodyPoint> surface;
  std::copy_if(points.begin(), points.end(), std::back_inserter(surface),
               [](const BodyPoint& point) { return point.surface; });
  return surface;
}

std::vector<float> skins(const std::vector<BodyPoint>& points) {
  std::vector<float> places;
  for (const BodyPoint& point : points) {
    for (const double part : point.skin) places.push_back(static_cast<float>(part));
  }
  return places;
}

std::vector<int> owners(const std::vector<BodyPoint>& points) {
  std::vector<int> owners;
  for (const BodyPoint& point : points) owners.push_back(point.owner);
  return owners;
}

SurfaceDistance distance_of(const FluidParams& p) {
  return {static_cast<double>(p.spacing), static_cast<double>(p.support),
          static_cast<double>(p.layer_weight)};
}

}  // namespace

Detector::Detector(Fluid& fluid, const std::vector<BodyPoint>& points,
                   const DetectSettings& settings, int seed, bool search_always)
    : fluid_(fluid),
      surface_points_(surface_of(points)),
      skin_(fluid.device(), skins(surface_points_)),
      owner_(fluid.device(), owners(surface_points_)),
      touches_(fluid.device(), surface_points_.size()),
      touches_read_(surface_points_.size()),
      program_(build(fluid.device())),
      touch_water_(program_, "touch_water"),
      bubbles_(fluid, program_, settings, seed, bubble_room(fluid.params().count)),
      cavities_(fluid, program_, settings, bubble_room(fluid.params().count), search_always),
      impacts_(static_cast<std::size_t>(fluid.boundary().body_count()), settings,
               distance_of(fluid.params())) {}

void Detector::enqueue(const Step& step, double frame, const Passes& passes) {
  if (passes.contacts && !surface_points_.empty()) {
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

void Detector::rehearse(const Step& step) {
  bubbles_.pool().resize(1);
  enqueue(step, step.dt);
  cavities_.rehearse(bubbles_);
  bubbles_.pool().clear();
  bubbles_.skip();
}

void Detector::enqueue_contacts(const Step& step) {
  touch_water_.run(fluid_.device().queue(), surface_points_.size(), fluid_.params_buffer().memory(),
                   fluid_.grid().cell_start(), fluid_.particles().position.memory(),
                   fluid_.particles().velocity.memory(), fluid_.water_density().memory(),
                   static_cast<int>(surface_points_.size()), skin_.memory(), owner_.memory(),
                   fluid_.boundary().steps().memory(), step.first_body, touches_.memory());
  touches_.enqueue_read(fluid_.device(), touches_read_);
}

std::vector<SurfacePoint> Detector::surface() const {
  std::vector<SurfacePoint> points;
  points.reserve(touches_read_.size());
  for (std::size_t s = 0; s < touches_read_.size(); ++s) {
    points.push_back({surface_points_[s].owner, touches_read_[s]});
  }
  return points;
}

Detections Detector::collect(double time, double frame, std::uint32_t step) {
  Detections found;
  found.impacts = impacts_.observe(time, frame, surface());
  found.bubbles = bubbles_.collect(time, frame, step);
  found.cavities = cavities_.search(time, bubbles_);
  bubbles_.renew(time);
  return found;
}

}  // namespace splash::sim
