// SPDX-License-Identifier: MIT
#include "sim-server/show/scene_frame.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace splash::sim
