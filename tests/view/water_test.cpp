// SPDX-License-Identifier: MIT
// The page's picture of still water, which is the same on every machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/median.hpp"
#include "tests/view/picture.hpp"
#include "tests/view/played_page.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

constexpr double kDepth = 0.1;  ///< [m]; so low, the disc hides none of the far walls

class DrawnWater : public InABrowser {
 protected:
  /// Water has a quarter of the picture's pixels along each axis.
  static void SetUpTestSuite() {
    if (Chromium::is_there()) page().load("?share=0.25", 300, 200, kDepth);
  }
  void SetUp() override {
    InABrowser::SetUp();
    if (IsSkipped()) return;
    browser().evaluate("splash.camera.frame(splash.world().tank, -0.7, 0.87)");
    ASSERT_TRUE(fill(kDepth));
  }
  /// Whether all that the page shows has water of this depth [m].
  static bool fill(double level) {
    page().fill(level);
    const auto count = std::to_string(std::lround(level / 0.1 * 2000.0));
    return browser().wait_for(
        "splash.playout.states.every((state) => state.count === " + count + ")", kTimeout);
  }
  static PlayedPage& page() { return PlayedPage::shared(); }
  static Chromium& browser() { return page().browser(); }
};

/// The mean of green along lines on the surface, each from one place to another.
double brightness(Chromium& browser, const std::vector<std::array<double, 4>>& lines) {
  Json places = Json::array();
  for (const auto& [x0, y0, x1, y1] : lines) {
    for (double t = 0.0; t < 1.0; t += 0.05) {
      places.push_back({x0 + t * (x1 - x0), y0 + t * (y1 - y0), kDepth});
    }
  }
  double sum = 0.0;
  for (const Json& colour : drawn(browser, seen(browser, places))) sum += colour[1].get<double>();
  return sum / static_cast<double>(places.size());
}

// A ray that meets a far wall under the surface goes on to the floor, as bright as in the middle.
// Without that, it would see the dark beyond the tank.
TEST_F(DrawnWater, TheFarWallsMirrorTheFloor) {
  constexpr double kNear = PlayedPage::kHalf - 0.03;  // of the walls
  const double far =
      brightness(browser(), {{-0.15, kNear, 0.15, kNear}, {-kNear, -0.15, -kNear, 0.15}});
  const double front = brightness(browser(), {{-0.1, -0.1, 0.15, -0.1}, {0.1, -0.15, 0.1, 0.1}});
  EXPECT_GT(far, 0.8 * front);
  RecordProperty("far_to_front", std::to_string(far / front));
  EXPECT_THAT(browser().errors(), IsEmpty());
}

// Shallow water over a beach: the ray meets the slope, not the level floor below it.
TEST_F(DrawnWater, TheFarWallMirrorsABeach) {
  const auto build = [](const std::string& slope) {
    browser().evaluate("splash.solids.build(Object.assign(splash.world(), { slope: " + slope +
                       " }))");
  };
  build("{ foot: -0.2, gradient: 0.4 }");
  constexpr double kNear = PlayedPage::kHalf - 0.008;  // of the wall; the water is 2 to 6 cm deep
  const double far = brightness(browser(), {{-0.1, kNear, 0.0, kNear}});
  const double front = brightness(browser(), {{-0.1, -0.1, 0.0, -0.1}});
  build("null");
  EXPECT_GT(far, 0.8 * front);
  RecordProperty("far_to_front", std::to_string(far / front));
  EXPECT_THAT(browser().errors(), IsEmpty());
}

/// How bumpy the water's end along a straight line of the picture is: the median distance from its
/// own median distance from that line, over all columns [pixels]. A bar that crosses does not
/// count.
double bumps(Chromium& browser, const Json& from, const Json& to) {
  constexpr int kReach = 6;  // rows on both sides
  constexpr std::size_t kRows = 2 * kReach + 1;
  constexpr double kGround = 20.0;  // turquoise of pixels without water, at most
  constexpr double kWater = 60.0;   // of those full of it, at least
  const double x0 = from[0];
  const double slope = (to[1].get<double>() - from[1].get<double>()) / (to[0].get<double>() - x0);
  const double last = std::max<double>(x0, to[0]) - 4.0;
  Json places = Json::array();
  std::vector<double> lines;
  for (double x = std::ceil(std::min<double>(x0, to[0])) + 4.0; x < last; ++x) {
    lines.push_back(from[1].get<double>() + slope * (x - x0));
    for (int row = -kReach; row <= kReach; ++row) {
      places.push_back({x, std::round(lines.back()) + row});
    }
  }
  const Json colours = drawn(browser, places);
  std::vector<double> off;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t first = i * kRows;
    double rows = 0.0;
    for (std::size_t k = 0; k < kRows; ++k) {
      rows += std::clamp((turquoise(colours[first + k]) - kGround) / (kWater - kGround), 0.0, 1.0);
    }
    off.push_back(std::round(lines[i]) - rows - lines[i]);
  }
  const double usual = median(off);
  for (double& value : off) value = std::abs(value - usual);
  return median(off);
}

// A pixel of the water is four of the picture, which would make steps of the edges.
TEST_F(DrawnWater, TheFarEdgesAreStraightThoughTheWaterIsCoarse) {
  browser().evaluate(
      "Object.assign(splash.camera, { distance: 0.6 * splash.camera.distance, "
      "target: [-0.1, 0.1, 0.1] })");
  constexpr double kWall = PlayedPage::kHalf;
  const Json ends =
      seen(browser(), {{-kWall, -kWall, kDepth}, {-kWall, kWall, kDepth}, {kWall, kWall, kDepth}});
  const double left = bumps(browser(), ends[0], ends[1]);
  const double right = bumps(browser(), ends[1], ends[2]);
  EXPECT_LT(left, 0.4);
  EXPECT_LT(right, 0.4);
  RecordProperty("left", std::to_string(left));
  RecordProperty("right", std::to_string(right));
  EXPECT_THAT(browser().errors(), IsEmpty());
}

// A place before the far wall, over the water and under it.
TEST_F(DrawnWater, WaterIsWhereTheNewestStateHasIt) {
  const auto deep = [&] {
    return turquoise(drawn(browser(), seen(browser(), {{0.1, 0.2, 0.15}}))[0]);
  };
  const double shallow = deep();
  EXPECT_LT(shallow, 22.0);
  ASSERT_TRUE(fill(0.2));
  EXPECT_GT(deep(), 25.0);
  EXPECT_THAT(browser().errors(), IsEmpty());
}

// However few pictures a page draws, each finds the newest state; who draws none fetches none.
TEST_F(DrawnWater, StatesComeAtTheirOwnRateWhilePicturesAreDrawn) {
  browser().evaluate(R"js({
    window.usual = requestAnimationFrame;
    window.came = 0;
    const { playout } = splash;
    const { push } = playout;
    playout.push = (...given) => {
      came += 1;
      push.apply(playout, given);
    };
    requestAnimationFrame = (act) => setTimeout(act, 250);
  })js");
  const auto passed = [] {
    return browser().evaluate(R"js((async () => {
      const before = [came, splash.pictures()];
      await new Promise((done) => { setTimeout(done, 2000); });
      return [came - before[0], splash.pictures() - before[1]];
    })())js");
  };
  const Json slow = passed();
  EXPECT_GT(slow[0], 2 * slow[1].get<int>()) << slow;
  browser().evaluate("requestAnimationFrame = (act) => { window.next = act; }");
  static_cast<void>(passed());
  EXPECT_EQ(passed(), Json({0, 0})) << "no picture, no state";
  browser().evaluate("requestAnimationFrame = usual; next()");
  EXPECT_TRUE(browser().wait_for(
      "splash.pictures() > " + browser().evaluate("splash.pictures() + 2").dump(), kTimeout));
  browser().evaluate("delete splash.playout.push");
  EXPECT_THAT(browser().errors(), IsEmpty());
}

}  // namespace
}  // namespace splash::tests
