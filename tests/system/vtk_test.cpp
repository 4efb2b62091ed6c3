// SPDX-License-Identifier: MIT
// What --vtk writes, taken apart as ParaView's reader of legacy files does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;

/// Big-endian floats behind a line that begins with `head`.
std::vector<float> floats_behind(const std::string& text, const std::string& head,
                                 std::size_t count) {
  const auto line = text.find('\n' + head);
  EXPECT_NE(line, std::string::npos) << head;
  std::size_t at = text.find('\n', line + 1) + 1;
  if (head.starts_with("SCALARS")) at = text.find('\n', at) + 1;  // the name of the colours
  std::vector<float> all;
  for (std::size_t i = 0; i < count && at + 4 <= text.size(); ++i, at += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
      word = word << 8U | static_cast<unsigned char>(text[at + k]);
    all.push_back(std::bit_cast<float>(word));
  }
  EXPECT_EQ(all.size(), count);
  return all;
}

TEST(Vtk, EachFileHoldsTheWaterAndTheSeriesHasThemAll) {
  const SmallScene scene(plunging());
  const TemporaryFolder place;
  const fs::path folder = place / "vtk";
  const auto [code, said] = simulate(scene.path(), 0.2, {"--vtk", folder});
  ASSERT_EQ(code, 0) << said;
  const auto series = nlohmann::json::parse(text_of(folder / "water.vtk.series"));
  const auto& files = series.at("files");
  ASSERT_EQ(files.size(), 6U) << "one at the start, then every 40 ms";
  for (std::size_t k = 0; k < files.size(); ++k) {
    EXPECT_NEAR(files[k].at("time").get<double>(), 0.04 * static_cast<double>(k), 0.01);
    const std::string text = text_of(folder / files[k].at("name").get<std::string>());
    ASSERT_TRUE(text.starts_with("# vtk DataFile Version 3.0\n"));
    const auto points = text.find("\nPOINTS ") + 8;
    const auto count = static_cast<std::size_t>(std::stoul(text.substr(points)));
    ASSERT_GT(count, 1000U);
    const std::vector<float> places = floats_behind(text, "POINTS", 3 * count);
    const std::vector<float> speeds = floats_behind(text, "VECTORS", 3 * count);
    const std::vector<float> densities = floats_behind(text, "SCALARS density", count);
    double height = 0.0;
    double density = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      height += static_cast<double>(places[3 * i + 2]) / static_cast<double>(count);
      density += static_cast<double>(densities[i]) / static_cast<double>(count);
      ASSERT_LT(std::abs(speeds[3 * i + 2]), 5.0F);
    }
    EXPECT_NEAR(height, 0.5 * SmallScene::kLevel, 0.02);
    EXPECT_NEAR(density, 998.0, 50.0);
  }
}

TEST(Vtk, AFolderThatCannotBeMadeEndsTheRunBeforeItBegins) {
  const SmallScene scene(plunging());
  const auto [code, said] = simulate(scene.path(), 0.1, {"--vtk", scene.path() + "/water"});
  EXPECT_EQ(code, 74) << said;
  EXPECT_THAT(said, testing::HasSubstr("cannot write the water to"));
}

}  // namespace
}  // namespace splash::tests
