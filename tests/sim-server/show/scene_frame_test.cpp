// SPDX-License-Identifier: MIT
// What viewers are told of a scene: each shipped one as it is, each body as a closed surface.
#include "sim-server/show/scene_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

TEST(SceneFrame, TellsOfEveryShippedScene) {
  const std::vector<std::string> names = tests::scene_names();
  for (const std::string& name : names) {
    const Scene scene = read_scene(tests::scene_file(name));
    const auto json = nlohmann::json::parse(describe_for_viewers(scene, 123, 0.02));
    EXPECT_EQ(json.at("scene"), scene.name);
    EXPECT_EQ(json.at("particles"), 123);
    EXPECT_EQ(json.at("solver"), name_of(scene.fluid.solver));
    EXPECT_EQ(json.at("tank").at("upper"), scene.tank.upper);
    EXPECT_EQ(json.at("slope").is_null(), !scene.slope.present);
    ASSERT_EQ(json.at("bodies").size(), scene.bodies.size());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      EXPECT_EQ(json.at("bodies")[b].at("name"), scene.bodies[b].name);
      EXPECT_EQ(json.at("bodies")[b].at("size"), scene.bodies[b].shape.size);
      EXPECT_EQ(json.at("bodies")[b].at("kind"), name_of(scene.bodies[b].shape.kind));
      const auto& shown = json.at("bodies")[b].at("mesh");
      EXPECT_FALSE(shown.at("triangles").empty());
      for (const int corner : shown.at("triangles")) {
        ASSERT_LT(3 * static_cast<std::size_t>(corner), shown.at("vertices").size());
      }
    }
  }
  EXPECT_GE(names.size(), 9U);
}

TEST(SceneFrame, IsJsonBehindTheHead) {
  Scene scene;
  scene.name = "odd \xff \"name\"";
  const protocol::ViewFrame frame = scene_frame(scene, 1, 0.5);
  EXPECT_EQ(protocol::frame_kind(frame.data()), protocol::kSceneFrame);
  EXPECT_EQ(protocol::frame_number<std::uint32_t>(&frame[4]), frame.size());
  const std::string text(reinterpret_cast<const char*>(&frame[16]), frame.size() - 16);
  EXPECT_EQ(nlohmann::json::parse(text).at("spacing"), 0.5);
}

/// Edges along which triangles do not go as often one way as the other.
int open_edges(const TriangleMesh& mesh) {
  std::map<std::array<int, 2>, int> times;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      times[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return static_cast<int>(
      std::count_if(times.begin(), times.end(), [](const auto& edge) { return edge.second != 0; }));
}

TEST(BodyMesh, IsTheClosedSurfaceOfEachForm) {
  for (const std::string& name : shape_names()) {
    const Shape shape = {shape_kind(name), {0.2, 0.2, 0.2}, 0.0, 0.0};
    const TriangleMesh mesh = body_mesh(shape);
    EXPECT_EQ(open_edges(mesh), 0) << name;
    EXPECT_NEAR(signed_volume(mesh) / volume_of(shape), 1.0, 0.02) << name;
    for (const Vector3& corner : mesh.vertices) {
      EXPECT_NEAR(distance_to(shape, corner), 0.0, 1e-12) << name;
    }
  }
}

TEST(BodyMesh, FollowsACurvedSole) {
  const Shape sole = {ShapeKind::box, {0.29, 0.1, 0.07}, 0.03, 0.5};
  const TriangleMesh mesh = body_mesh(sole);
  EXPECT_EQ(open_edges(mesh), 0);
  EXPECT_NEAR(signed_volume(mesh) / volume_of(sole), 1.0, 0.01);
}

TEST(BodyMesh, OfABoxIsItsTwelveTriangles) {
  const Shape box = {ShapeKind::box, {0.3, 0.2, 0.1}, 0.0, 0.0};
  EXPECT_EQ(body_mesh(box).triangles.size(), 12U);
  EXPECT_EQ(body_mesh(box).vertices.size(), 8U);
}

}  // namespace
}  // namespace splash::sim
