// SPDX-License-Identifier: MIT
// A scene's mesh is found beside it, and a free one is about its centre of mass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

const Vector3 kSize = {0.2, 0.12, 0.1};
const Vector3 kAway = {0.3, 0.0, -0.05};  ///< of the box's middle from the file's origin [m]

/// A folder with a scene's meshes, gone with the test.
class MeshScene : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("box.obj", obj_text(placed(box_mesh(1000.0 * kSize), no_turn_, 1000.0 * kAway)));
    TriangleMesh open = box_mesh(kSize);
    open.triangles.pop_back();
    folder_.write("open.obj", obj_text(open));
  }
  /// With the body's mappings.
  [[nodiscard]] Scene scene_with(const std::string& body) const {
    return parse_scene(
        "fluid: {spacing: 0.02}\n"
        "tank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
        "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\n"
        "bodies:\n  - name: crate\n" +
            body,
        (folder_ / "scene.yaml").string());
  }
  [[nodiscard]] std::string complaint(const std::string& body) const {
    return tests::refusal([&] { return scene_with(body); });
  }

  const Quaternion no_turn_ = {0.0, 0.0, 0.0, 1.0};
  const tests::TemporaryFolder folder_;
};

TEST_F(MeshScene, ATrackedMeshKeepsItsOwnOrigin) {
  const Scene scene = scene_with(
      "    shape: {mesh: box.obj, scale: 0.001}\n    rest: {position: [0.5, 0.5, 0.5]}\n");
  const BodySettings& body = scene.bodies[0];
  EXPECT_EQ(body.shape.kind, ShapeKind::mesh);
  EXPECT_EQ(body.rest.position, (Vector3{0.5, 0.5, 0.5}));
  EXPECT_NEAR(distance_to(body.shape, kAway), -0.05, 1e-6);
  EXPECT_NEAR(distance_to(body.shape, kAway + Vector3{0.0, 0.0, 0.07}), 0.02, 1e-6);
  EXPECT_TRUE(is_inside(body.shape, kAway));
  EXPECT_FALSE(is_inside(body.shape, {0.0, 0.0, 0.0}));
  EXPECT_NEAR(volume_of(body.shape), 0.2 * 0.12 * 0.1, 1e-12);
  EXPECT_LT(length(body.shape.size - kSize), 1e-12);
}

TEST_F(MeshScene, AFreeMeshIsAboutItsCentreOfMass) {
  const Scene scene = scene_with(
      "    shape: {mesh: box.obj, scale: 0.001}\n"
      "    rest: {position: [0.5, 0.5, 0.5], rotation: [0, 0, 1, 0]}\n"
      "    motion: {kind: free, density: 500}\n");
  const BodySettings& body = scene.bodies[0];
  EXPECT_NEAR(distance_to(body.shape, {0.0, 0.0, 0.0}), -0.05, 1e-6);
  EXPECT_LT(length(farthest_of(body.shape) - 0.5 * kSize), 1e-12);
  // Half a turn about z carries the box's middle to the other side of the origin.
  EXPECT_LT(length(body.rest.position - Vector3{0.2, 0.5, 0.45}), 1e-12);
  EXPECT_NEAR(inertia_of(body.shape, 12.0)[0], 0.12 * 0.12 + 0.1 * 0.1, 1e-12);
}

TEST_F(MeshScene, WhatIsWrongIsToldWhereItIs) {
  const std::string rest = "    rest: {position: [0.5, 0.5, 0.5]}\n";
  const auto shape = [&](const std::string& keys) { return "    shape: {" + keys + "}\n" + rest; };
  EXPECT_THAT(complaint(shape("mesh: box.stl")), HasSubstr("scene.yaml:6:"));
  EXPECT_THAT(complaint(shape("mesh: box.stl")), HasSubstr("there is no file"));
  EXPECT_THAT(complaint(shape("mesh: ''")), HasSubstr("must not be empty"));
  EXPECT_THAT(complaint(shape("mesh: box.obj")), HasSubstr("box.obj:1:"));
  EXPECT_THAT(complaint(shape("mesh: box.obj")), HasSubstr("scale: 0.001"));
  EXPECT_THAT(complaint(shape("mesh: open.obj")), HasSubstr("open.obj:12:"));
  EXPECT_THAT(complaint(shape("mesh: open.obj")), HasSubstr("not closed"));
  EXPECT_THAT(complaint(shape("mesh: box.obj, scale: 0.0001")), HasSubstr("too thin"));
  EXPECT_THAT(complaint(shape("mesh: box.obj, scale: 0")), HasSubstr("1e-06..1000 m"));
  EXPECT_THAT(complaint(shape("mesh: box.obj, size: [1, 1, 1]")), HasSubstr("unknown key"));
  EXPECT_THAT(complaint("    shape: {mesh: open.obj}\n" + rest +
                        "    motion: {kind: free, density: 500}\n"),
              HasSubstr("not closed"));
  EXPECT_THAT(complaint("    shape: {mesh: box.obj, scale: 0.001}\n"
                        "    motion: {kind: trc, markers: [a, b, c], sole: true}\n"),
              HasSubstr("only a box has a sole"));
}

}  // namespace
}  // namespace splash::sim
