// SPDX-License-Identifier: MIT
// A ball that falls into still water at 1 m/s is heard at the same moment whether it is a sphere or
// a mesh of one.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/sim-server/detect/scene_run.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

constexpr double kRadius = 0.1;      // [m]
constexpr double kSpacing = 0.0238;  // of the scene's particles [m]

std::string plunge_of(const std::string& shape) {
  std::string text = scene_text("plunge.yaml");
  const std::size_t from = text.find("    shape:");
  return text.replace(from, text.find("    motion:") - from, "    shape: {" + shape + "}\n");
}

TEST(MeshPlunge, IsHeardWhenTheSpheresIs) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("ball.obj", obj_text(sphere_mesh(kRadius, 3)));
  const SceneRun sphere = run_scene(plunge_of("kind: sphere, size: [0.2, 0.2, 0.2]"), 2.2);
  const SceneRun mesh = run_scene(plunge_of("mesh: " + file.string()), 2.2);
  ASSERT_EQ(sphere.found.impacts.size(), 1U);
  ASSERT_EQ(mesh.found.impacts.size(), 1U);
  const DetectedImpact& one = sphere.found.impacts.front();
  const DetectedImpact& other = mesh.found.impacts.front();
  std::printf(
      "sphere %.4f s, mesh %.4f s (step %.2f ms); approach %.3f, %.3f m/s; %zu, %zu bubbles; "
      "%zu, %zu cavities\n",
      one.time, other.time, 1e3 * mesh.time_step, one.approach, other.approach,
      sphere.found.bubbles.size(), mesh.found.bubbles.size(), sphere.found.cavities.size(),
      mesh.found.cavities.size());
  // To a step, or the roughness of the particle surface: what the sphere is told to.
  EXPECT_NEAR(other.time, one.time, std::max(mesh.time_step, 0.1 * kSpacing));
  EXPECT_NEAR(other.speed, one.speed, 1.0e-3);
  EXPECT_NEAR(other.approach, one.approach, 0.1);
  EXPECT_NEAR(other.position[2], one.position[2], 0.1 * kSpacing);
  const auto bubbles = static_cast<double>(sphere.found.bubbles.size());
  EXPECT_NEAR(static_cast<double>(mesh.found.bubbles.size()), bubbles, 0.25 * bubbles);
  EXPECT_EQ(mesh.totals.resets, 0U);
}

}  // namespace
}  // namespace splash::sim
