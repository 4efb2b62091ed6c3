// SPDX-License-Identifier: MIT
#include "tests/sim-server/detect/impact_stories.hpp"

#include <utility>

#include "sim-server/fluid/params/smoothing.hpp"

namespace splash::sim {

SurfaceDistance surface_distance() {
  // Layer weight of a cubic lattice: its colour is 1 in the depth.
  const double support = kSupportSpacings * kSpacing;
  double sum = 0.0;
  for (int k = -2; k <= 2; ++k) sum += plane_marginal(k * kSpacing, support);
  return {kSpacing, support, 1.0 / sum};
}

void add_body(std::vector<SurfacePoint>& points, int body, const Scenery& at) {
  const SurfaceDistance distance = surface_distance();
  for (int k = 0; k < 16; ++k) {
    SurfacePoint point;
    point.body = body;
    point.area = kUnderside / 16.0;
    const double gap = at.underside - at.level;
    const bool any = at.water && gap < distance.farthest();
    point.touch.colour = any ? static_cast<float>(distance.colour_at(gap)) : 0.0F;
    point.touch.all_colour =
        at.water ? static_cast<float>(distance.colour_at(gap - at.thin)) : 0.0F;
    point.touch.gz = any ? -30.0F : 0.0F;
    point.touch.x = 0.02F * static_cast<float>(k % 4);
    point.touch.y = 0.02F * static_cast<float>(k / 4);
    point.touch.nz = -1.0F;
    point.touch.z = static_cast<float>(at.underside);
    point.touch.u = static_cast<float>(at.drift);
    point.touch.w = static_cast<float>(at.speed);
    point.touch.water_w = any ? static_cast<float>(at.flow) : 0.0F;
    point.touch.ahead = at.water ? static_cast<float>(at.ahead) : 0.0F;
    points.push_back(point);
  }
}

std::vector<Announced> live_through(ImpactWatch& watch, double seconds, const Sights& sights) {
  std::vector<Announced> all;
  for (int k = 0; k * kStoryFrame < seconds; ++k) {
    const double time = k * kStoryFrame;
    for (const DetectedImpact& impact : watch.observe(time, kStoryFrame, sights(time))) {
      all.push_back({time, impact});
    }
  }
  return all;
}

std::vector<Announced> live_through(double seconds, const Sights& sights) {
  ImpactWatch watch({kUnderside}, {}, surface_distance());
  return live_through(watch, seconds, sights);
}

std::vector<Announced> watch(const std::vector<Story>& bodies, double seconds,
                             const DetectSettings& settings, double nearer) {
  ImpactWatch watch(std::vector<double>(bodies.size(), kUnderside), settings, surface_distance(),
                    nearer);
  return live_through(watch, seconds, [&](double time) {
    std::vector<SurfacePoint> points;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      add_body(points, static_cast<int>(b), bodies[b](time));
    }
    return points;
  });
}

std::vector<Announced> watch(const Story& body, double seconds, const DetectSettings& settings,
                             double nearer) {
  return watch(std::vector<Story>{body}, seconds, settings, nearer);
}

Story path(double from, std::vector<Leg> legs) {
  return [from, legs = std::move(legs)](double time) {
    double start = 0.0;
    double height = from;
    for (const Leg& leg : legs) {
      if (time < leg.until) {
        const double speed = (leg.height - height) / (leg.until - start);
        return Scenery{.underside = height + speed * (time - start), .speed = speed};
      }
      start = leg.until;
      height = leg.height;
    }
    return Scenery{.underside = height};
  };
}

}  // namespace splash::sim
