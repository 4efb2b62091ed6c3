// SPDX-License-Identifier: MIT
// Bubbles among water, bodies, walls and each other, against the brute-force double-precision
// reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

/// Relative to the sum of the magnitudes of the terms; measured at most 5e-6.
constexpr double kBound = 2.0e-5;
/// At the rim of the support 1 - q^2 is a small difference: its absolute error stays.
constexpr double kRim = 1.0e-6;
constexpr double kFrame = 0.004;

struct Worst {
  double colour = 0.0;
  double upward = 0.0;
  double place = 0.0;
  int lonely = 0;
};

class CarryBubbles : public ::testing::TestWithParam<int> {
 protected:
  static void compare(const FluidState& state, const std::vector<Vector3>& places,
                      const BubbleState& bubble, Worst& worst) {
    const auto i = static_cast<std::size_t>(bubble.id);
    const double colour = reference_bubble_colour(state.params, places, i);
    const double colour_error = std::abs(static_cast<double>(bubble.colour) - colour);
    ASSERT_LE(colour_error, kBound * colour + kRim);
    worst.colour = std::max(worst.colour, colour_error);
    if (colour == 0.0) ++worst.lonely;

    const ReferenceSum upward = reference_upward(state, places, places[i]);
    const double upward_error = std::abs(static_cast<double>(bubble.upward) - upward.value);
    ASSERT_LE(upward_error, kBound * upward.scale + kRim);
    worst.upward = std::max(worst.upward, upward_error);

    const Vector3 moved = places[i] + kFrame * reference_water_velocity(state, places[i]);
    const Vector3 place = {static_cast<double>(bubble.x), static_cast<double>(bubble.y),
                           static_cast<double>(bubble.z)};
    const double place_error = length(place - moved);
    ASSERT_LT(place_error, 1.0e-6);
    worst.place = std::max(worst.place, place_error);
  }
};

TEST_P(CarryBubbles, IsTheTwins) {
  Device device(-1, false, GetParam());
  Worst worst;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.5, 91);
    Bubbles bubbles(*water.fluid, detect_program(device), {}, 1, 500);
    auto places = random_places(370, {0, 0, 0}, {0.4, 0.25, 0.25}, 92);
    const auto thin = random_places(63, {-0.05, -0.05, 0.2}, {0.6, 0.4, 0.9}, 93);
    places.insert(places.end(), thin.begin(), thin.end());
    places = as_floats(places);
    fill_pool(bubbles, places);
    detect(water, bubbles, kFrame);
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    ASSERT_EQ(bubbles.states().size(), places.size());
    std::vector<int> seen(places.size(), 0);
    for (const BubbleState& bubble : bubbles.states()) {
      ASSERT_GE(bubble.id, 0);
      ASSERT_LT(static_cast<std::size_t>(bubble.id), places.size());
      ASSERT_EQ(++seen[static_cast<std::size_t>(bubble.id)], 1);
      compare(state, places, bubble, worst);
    }
  }
  std::printf("worst error of c_b %.1e, gradient %.1e, place %.1e m; %d alone\n", worst.colour,
              worst.upward, worst.place, worst.lonely);
  EXPECT_GT(worst.lonely, 20);
}

INSTANTIATE_TEST_SUITE_P(Lanes, CarryBubbles, kLaneCounts, lanes_name);

}  // namespace
}  // namespace splash::sim
