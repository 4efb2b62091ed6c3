// SPDX-License-Identifier: MIT
// The page at a glance, in one browser that draws few pixels: what page_test.cpp looks at closely.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "protocol/udp_socket.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"
#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Glance : public InABrowser {};

/// Whether a picture shows the second tile brighter while it sounds, again and again, since
/// software may draw less than a picture in a tone's second.
bool lights_a_tile(Stage& stage) {
  Chromium& browser = stage.browser();
  const Json tile = stage.seen({{0.1, -0.1, 0.0}});
  const int before = stage.drawn(tile)[0][0];
  browser.press("o");
  browser.evaluate(
      "setInterval(() => [...document.querySelectorAll('#channels button')]"
      ".find((one) => one.textContent === '2').click(), 300)");
  return eventually([&] { return stage.drawn(tile)[0][0].get<int>() > before + 20; }, kTimeout);
}

/// Whether the mouse, which holds the disc, drags it into the water so that the page is told of an
/// impact and of a level of the first tile. A busy machine may leave out a drag's poses or its
/// sound; then it is dragged again.
bool splashes(Stage& stage, const Json& way) {
  Chromium& browser = stage.browser();
  browser.evaluate(
      "{ window.level = 0; setInterval(() => "
      "{ level = Math.max(level, splash.peaks()?.[0] ?? 0); }, 10); }");
  for (int i = 0; i < 10; ++i) {
    drag(browser, way[0], way[1], 0.3);
    if (browser.wait_for("level > 1e-3 && splash.events.some((event) => event.kind === '/impact')",
                         5.0)) {
      return true;
    }
    drag(browser, way[1], way[0], 0.3);
    sleep(1.0);
  }
  return false;
}

TEST_F(Glance, WaterIsSeenATileIsLitAndAHandIsDraggedIntoTheWater) {
  const TemporaryFolder folder;
  const std::string wav = folder / "glance.wav";
  Stage stage(kWaits, "?share=0.4", "420,300", wav);
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
  EXPECT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  EXPECT_TRUE(splashes(stage, way));
  EXPECT_THAT(browser.errors(), IsEmpty());

  // The page dies with the disc in its hand: the disc goes back to its own way.
  const FrameViewer viewer(protocol::parse_endpoint(stage.sim_show(), 0));
  static_cast<void>(viewer.read());
  EXPECT_TRUE(eventually([&] { return shown_disc(viewer).grabbed; }, kTimeout));
  browser.kill();
  EXPECT_TRUE(eventually([&] { return !shown_disc(viewer).grabbed; }, kTimeout))
      << "still grabbed, though the page is gone";
  EXPECT_TRUE(
      eventually([&] { return std::abs(shown_disc(viewer).height - 0.35F) < 0.01F; }, kTimeout))
      << "not back on its own way";

  EXPECT_EQ(stage.synth().end(), 0) << stage.synth().process().output();
  EXPECT_GT(peak(read_recording(wav).channels.at(0)), 1e-3F) << "the tone was the second tile's";
}

}  // namespace
}  // namespace splash::tests
