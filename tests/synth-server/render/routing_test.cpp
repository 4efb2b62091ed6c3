// SPDX-License-Identifier: MIT
// Which channels an event reaches, and with what gain from metres to full scale.
#include "synth-server/render/routing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

TEST(Routing, CountsFullScaleGainAndTrims) {
  Rig rig = open_rig();
  rig.outputs[0].full_scale = 0.02;
  rig.outputs[0].gain_db = 6.0;
  rig.outputs[0].trims_db = {-20.0};
  Routing routing(rig, {});
  std::vector<Route> routes(static_cast<std::size_t>(routing.max_routes()));
  const auto reach = routing.route({{}, -1, 100.0}, routes);
  ASSERT_EQ(reach.routes, 1);
  EXPECT_NEAR(routes[0].gain, std::pow(10.0, -14.0 / 20.0) / 0.02, 1e-9);
  EXPECT_NEAR(reach.floor, 1e-6 / routes[0].gain, 1e-12) << "120 dB below full scale";
}

TEST(Routing, HasRoomForAllTilesInReachWhereverTheEventIs) {
  for (const double reach : {0.23, 0.4, 0.7, 1.5}) {
    Rig rig = floor_rig();
    rig.outputs[0].reach = reach;
    Routing routing(rig, {});
    std::vector<Route> routes(static_cast<std::size_t>(routing.max_routes()));
    const double level = 1.0 / rig.outputs[0].full_scale;
    for (float x = 0.0F; x < 1.83F; x += 0.037F) {
      for (float y = 0.0F; y < 1.83F; y += 0.037F) {
        const auto found = routing.route({{x, y, 0.0F}, -1, 100.0}, routes);
        double power = 0.0;
        for (int r = 0; r < found.routes; ++r) {
          const double gain = routes[static_cast<std::size_t>(r)].gain / level;
          power += gain * gain;
        }
        ASSERT_NEAR(power, 1.0, 1e-6) << "a route was lost at " << x << ", " << y;
      }
    }
  }
}

TEST(Routing, TellsOutOfBandFromUnheard) {
  Routing routing(floor_rig(), {});
  std::vector<Route> routes(static_cast<std::size_t>(routing.max_routes()));
  using Result = Routing::Result;
  EXPECT_EQ(routing.route({{0.9F, 0.9F, 0.0F}, -1, 751.0}, routes).result, Result::out_of_band);
  EXPECT_EQ(routing.route({{0.9F, 0.9F, 0.0F}, -1, 749.0}, routes).result, Result::heard);
  EXPECT_EQ(routing.route({{9.0F, 0.9F, 0.0F}, -1, 749.0}, routes).result, Result::unheard);
}

}  // namespace
}  // namespace splash::synth
