// SPDX-License-Identifier: MIT
// The page at a glance, in one browser that draws few pixels: what page_test.cpp looks at closely.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "protocol/udp_socket.hpp"
#include "tests/view/stage.hpp"
#include "view-server/server.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Glance : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }
};

/// Whether the second tile is brighter while it sounds, again and again, since software may draw
/// less than a picture in a tone's second.
bool lights_a_tile(Stage& stage) {
  Chromium& browser = stage.browser();
  const Json tile = stage.seen({{0.1, -0.1, 0.0}});
  const int before = stage.drawn(tile)[0][0];
  browser.press("o");
  browser.evaluate(
      "setInterval(() => [...document.querySelectorAll('#channels button')]"
      ".find((one) => one.textContent === '2').click(), 300)");
  EXPECT_TRUE(browser.wait_for("splash.peaks()[1] > 0.02", 30.0));
  const std::string drawn = browser.evaluate("splash.pictures() + 2").dump();
  EXPECT_TRUE(browser.wait_for("splash.pictures() > " + drawn, kTimeout));
  return stage.drawn(tile)[0][0].get<int>() > before + 20;
}

TEST_F(Glance, WaterIsSeenATileIsLitAndAHandIsDraggedIntoTheWater) {
  Stage stage(kWaits, "?share=0.4", "420,300");
  Chromium& browser = stage.browser();
  EXPECT_EQ(browser.evaluate("document.title"), "small - splash");
  const Json water = stage.seen({{0.0, -0.2, 0.1}, {-0.1, -0.2, 0.1}, {0.2, 0.0, 0.1}});
  const Json beside = stage.seen({{-0.45, -0.2, 0.0}, {0.45, 0.2, 0.0}});
  for (const Json& colour : stage.drawn(water)) EXPECT_GT(turquoise(colour), 25.0) << colour;
  for (const Json& colour : stage.drawn(beside)) EXPECT_LT(turquoise(colour), 22.0) << colour;
  EXPECT_TRUE(browser.wait_for("splash.peaks() && splash.peaks().length === 4", kTimeout));
  EXPECT_TRUE(lights_a_tile(stage));
  EXPECT_THAT(browser.errors(), IsEmpty());

  stage.load("?points");  // drawn fast enough to follow the mouse
  const Json way = stage.way_down();
  browser.mouse("mouseMoved", way[0][0], way[0][1]);
  browser.mouse("mousePressed", way[0][0], way[0][1]);
  EXPECT_TRUE(browser.wait_for("splash.grabs.holds(0)", 10.0));
  drag(browser, way[0], way[1], 0.3);
  EXPECT_TRUE(browser.wait_for("splash.events.some((event) => event.kind === '/impact')", 20.0));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

// Pictures come 60 times a second and take 25 ms to be drawn, states 60 times, each up to 5 ms
// before its moment or 24 ms after.
TEST_F(Glance, ShownPicturesAreYoungWhereFramesComeInTime) {
  view::Options options;
  view::Server server(options);
  const std::jthread thread([&server] { server.run(); });
  Chromium browser("200,200");
  browser.call("Page.navigate",
               {{"url", "http://" + protocol::to_string(server.local()) + "/vector.js"}});
  const Json ages = browser.evaluate(R"js((async () => {
    const { Playout } = await import('/playout.js');
    const ages = [];
    for (const late of [-0.005, 0.005, 0.02]) {
      const playout = new Playout();
      for (let k = 0; k < 600; ++k) {
        const now = 100 + k / 60;
        const jitter = 0.004 * Math.sin(7 * k);
        playout.push({ moment: now - late - jitter, count: 1 }, now);
        const begun = now + 0.008;
        playout.finished(playout.at(begun).moment, begun, begun + 0.025);
      }
      ages.push(playout.age);
    }
    return ages;
  })())js");
  server.stop();
  for (const Json& age : ages) EXPECT_LT(age.get<double>(), 0.060) << ages;
  EXPECT_LT(ages[0].get<double>(), ages[2].get<double>());
}

}  // namespace
}  // namespace splash::tests
