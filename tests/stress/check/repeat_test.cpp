// SPDX-License-Identifier: MIT
// Group 13, repeatability: the same scene and seed give the same water and the same events to the
// last bit; another seed gives other bubbles in the same water. Kernels of other vector widths
// round otherwise: they stay together as rounding allows, and so do their waters for ever in the
// mean.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/stress/faults.hpp"
#include "tests/stress/trial_parts.hpp"

namespace splash::stress {
namespace {

constexpr double kCoarse = 0.05;  // [m]

/// A ball falls into water that foams easily.
sim::Scene splashing(sim::PressureKind solver, int seed) {
  sim::Scene scene =
      with(basin(kCoarse), {moved(ball({}), {{0.0, {0.2, 0.2, 0.4}}, {0.2, {0.2, 0.2, 0.1}}})});
  scene.fluid.solver = solver;
  scene.seed = seed;
  scene.detect.bubble_speed = 0.05;
  scene.detect.bubble_gradient = 0.0;  // so that coarse water makes some
  return scene;
}

struct Story {
  std::vector<double> events;  ///< all their numbers, in order
  sim::Snapshot water;
  sim::FluidParams params;
};

Story run(sim::Device& device, const sim::Scene& scene, double seconds) {
  sim::Simulation simulation(device, scene, {});
  Story story;
  sim::Detections found;
  while (simulation.seconds() < seconds) {
    tests::append_found(found, simulation.advance().found);
  }
  story.events = tests::numbers_of(found);
  story.water = simulation.fluid().snapshot();
  story.params = simulation.fluid().params();
  return story;
}

class Repeats : public testing::TestWithParam<sim::PressureKind> {};

TEST_P(Repeats, TheSameSeedGivesTheSameBits) {
  sim::Device device;
  const Story first = run(device, splashing(GetParam(), 1), 0.5);
  const Story second = run(device, splashing(GetParam(), 1), 0.5);
  EXPECT_GT(first.events.size(), 20U);
  EXPECT_EQ(first.events, second.events);
  EXPECT_EQ(first.water.id, second.water.id);
  EXPECT_EQ(first.water.position, second.water.position);
  EXPECT_EQ(first.water.velocity, second.water.velocity);
  EXPECT_EQ(first.water.peak_density, second.water.peak_density);
  const Story other = run(device, splashing(GetParam(), 2), 0.5);
  EXPECT_NE(first.events, other.events) << "a seed that does nothing";
  EXPECT_EQ(first.water.position, other.water.position);
}

/// By id, in spacings: the largest distance of a particle from itself in the other story.
double apart(const Story& a, const Story& b) {
  const auto stride = [](const Story& s) { return static_cast<std::size_t>(s.params.capacity); };
  std::vector<std::size_t> where(b.water.id.size());
  for (std::size_t i = 0; i < where.size(); ++i) {
    where[static_cast<std::size_t>(b.water.id[i])] = i;
  }
  double most = 0.0;
  for (std::size_t i = 0; i < a.water.id.size(); ++i) {
    const std::size_t j = where[static_cast<std::size_t>(a.water.id[i])];
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(a.water.position[axis * stride(a) + i] -
                                           b.water.position[axis * stride(b) + j]);
      square += d * d;
    }
    most = std::max(most, std::sqrt(square));
  }
  return most / kCoarse;
}

/// Of the centre of mass [m].
double height(const Story& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.water.id.size(); ++i) {
    sum +=
        static_cast<double>(s.water.position[2 * static_cast<std::size_t>(s.params.capacity) + i]);
  }
  return sum / static_cast<double>(s.water.id.size());
}

/// One frame from `start`, which is water at `seconds`.
Story one_frame(sim::Device& device, const sim::Scene& scene, const Story& start, double seconds) {
  sim::Simulation simulation(device, scene, {});
  simulation.resume(start.water, seconds);
  static_cast<void>(simulation.advance());
  return {{}, simulation.fluid().snapshot(), simulation.fluid().params()};
}

TEST_P(Repeats, KernelsOfAllWidthsDoAlikeToWithinRounding) {
  sim::Device fast;
  sim::Device reference(-1, false, 1);
  const sim::Scene scene = splashing(GetParam(), 1);
  constexpr double kMidst = 0.15;  // of the splash [s]
  const Story start = run(fast, scene, kMidst);
  const Story a = one_frame(fast, scene, start, kMidst);
  const Story b = one_frame(reference, scene, start, kMidst);
  ASSERT_EQ(a.params.capacity, b.params.capacity);
  EXPECT_GT(apart(start, a), 0.02);
  std::printf("moved %.2e spacings in a frame, apart %.2e\n", apart(start, a), apart(a, b));
  // Coordinates of half a metre round to 6e-8 m, 1e-6 spacings, in each of the frame's few steps.
  EXPECT_LT(apart(a, b), 1.0e-5);
}

// What differs in the last bit soon is another splash; its water is as much, and stands as high.
TEST(RepeatsInTheMean, WithOtherKernels) {
  sim::Device fast;
  sim::Device reference(-1, false, 1);
  const double high = height(run(fast, splashing(sim::PressureKind::weakly_compressible, 1), 1.5));
  EXPECT_NEAR(height(run(reference, splashing(sim::PressureKind::weakly_compressible, 1), 1.5)),
              high, 0.01 * kCoarse);
}

INSTANTIATE_TEST_SUITE_P(Waters, Repeats, testing::ValuesIn(kBothSolvers),
                         [](const auto& solver) { return sim::name_of(solver.param); });

}  // namespace
}  // namespace splash::stress
