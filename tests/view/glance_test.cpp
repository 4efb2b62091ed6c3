// SPDX-License-Identifier: MIT
// The page at a glance, in one browser that draws few pixels: what page_test.cpp looks at closely.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/recording.hpp"
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
  /// What a script that imports the page's modules gives, without a page.
  static Json with_the_modules(const std::string& script) {
    view::Options options;
    view::Server server(options);
    const std::jthread thread([&server] { server.run(); });
    Chromium browser("200,200");
    browser.call("Page.navigate",
                 {{"url", "http://" + protocol::to_string(server.local()) + "/vector.js"}});
    Json result = browser.evaluate(script);
    server.stop();
    return result;
  }
};

constexpr std::uint32_t kGrabbed = 4;

/// Whether it becomes true in time, however slow the machine is.
template <typename Condition>
bool becomes(const Condition& condition) {
  const double end = protocol::monotonic_now() + kTimeout;
  while (protocol::monotonic_now() < end) {
    if (condition()) return true;
    sleep(0.02);
  }
  return false;
}

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
  return becomes([&] { return stage.drawn(tile)[0][0].get<int>() > before + 20; });
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
  const std::string wav = temporary_path("glance.wav");
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
  const auto is_held = [&] {
    viewer.ask();
    const protocol::ViewFrame frame = viewer.read();
    return frame.size() > 56 + 28 + 4 &&
           (protocol::frame_number<std::uint32_t>(&frame[56 + 28]) & kGrabbed) != 0;
  };
  EXPECT_TRUE(becomes(is_held));
  browser.kill();
  EXPECT_TRUE(becomes([&] { return !is_held(); })) << "still grabbed, though the page is gone";
  EXPECT_TRUE(becomes([&] {
    viewer.ask();
    const protocol::ViewFrame frame = viewer.read();
    return frame.size() > 56 + 28 + 4 &&
           std::abs(protocol::frame_number<float>(&frame[56 + 8]) - 0.35F) < 0.01F;
  })) << "not back on its own way";

  stage.synth().process().signal(SIGTERM);
  EXPECT_EQ(stage.synth().process().wait_for_end(), 0) << stage.synth().process().output();
  EXPECT_GT(peak(read_recording(wav).channels.at(0)), 1e-3F) << "the tone was the second tile's";
  std::filesystem::remove(wav);
}

// Pictures come 60 times a second and take 25 ms to be drawn, states 60 times, each up to 5 ms
// before its moment or 24 ms after.
TEST_F(Glance, ShownPicturesAreYoungWhereFramesComeInTime) {
  const Json ages = with_the_modules(R"js((async () => {
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
  for (const Json& age : ages) EXPECT_LT(age.get<double>(), 0.060) << ages;
  EXPECT_LT(ages[0].get<double>(), ages[2].get<double>());
}

// Eight particles between x = y = 0 and 1 m, in the middle but for two near the x wall, one of
// which flies, and one in a corner.
TEST_F(Glance, OnlyWaterNearWallsAndDropsAreDrawnSeveralTimes) {
  const Json drawn = with_the_modules(R"js((async () => {
    const { several, WORDS } = await import('/several.js');
    const places = [[0.5, 0.5], [0.01, 0.5], [0.99, 0.5], [0.99, 0.01], [0.5, 0.5], [0.5, 0.5],
      [0.5, 0.5], [0.5, 0.5]];
    const particles = new Uint16Array(4 * places.length);
    places.forEach(([x, y], i) =>
      particles.set([1000 * x, 1000 * y, 500, i === 2 ? 4 << 8 : 0], 4 * i));
    const state = { count: 8, lower: [0, 0, 0], unit: 0.001,
      particles: new Uint8Array(particles.buffer) };
    const tank = { lower: [0, 0, 0], upper: [1, 1, 1] };
    const { mirrored, drops } = several({ older: state, newer: state },
      { tank, paddle: 0, spacing: 0.01 });
    const placed = (points) => Array.from({ length: points.count }, (_, k) =>
      [points.used[WORDS * k] & 0xffff, points.used[WORDS * k + 4]]);
    return [placed(mirrored), placed(drops)];
  })())js");
  EXPECT_EQ(drawn[0], Json({{10, 0}, {990, 0}, {990, 1}, {990, 2}}));
  EXPECT_EQ(drawn[1], Json({{990, 10}, {990, 11}, {990, 12}, {990, 13}, {990, 14}}));
}

// A machine on which a picture takes a time in proportion to its pixels: pictures get coarser until
// they come often enough, and sharper again on one that is fast.
TEST_F(Glance, APictureThatTakesLongGetsCoarser) {
  const Json shares = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const pace = new Pace(null);
    const run = (seconds, whole) => { // whole: what all pixels take [s]
      for (const end = now + 1000 * seconds; now < end;) {
        const drawing = whole * pace.sharp ** 2 * (0.5 + 0.5 * pace.share ** 2);
        now += 1000 * Math.max(drawing, 1 / 60);
        pace.step(drawing);
      }
      return [pace.sharp, pace.share, pace.rate];
    };
    return [run(1, 0.001), run(3, 0.12), run(60, 0.001)];
  })())js");
  EXPECT_EQ(shares[0][0], 1) << shares;
  EXPECT_LT(shares[1][0], 1) << shares;
  EXPECT_GT(shares[1][2], 40) << shares;
  EXPECT_EQ(shares[2][0], 1) << shares;
  EXPECT_EQ(shares[2][1], 1) << shares;
}

// Simulated graphics: a picture of water takes `whole` seconds at full resolution and less in
// proportion to its pixels; a picture of points takes 2 ms.
TEST_F(Glance, PointsBecomeWaterAgainOnceThereIsTimeForIt) {
  const Json seen = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const run = (pace, seconds, whole) => {
      let tries = 0;
      let water = 0; // pictures of it
      for (const end = now + 1000 * seconds; now < end;) {
        const points = pace.isTooSlow;
        const drawing = points ? 0.002 : whole * pace.sharp ** 2 * (0.5 + 0.5 * pace.share ** 2);
        now += 1000 * Math.max(drawing, 1 / 60);
        pace.step(drawing);
        tries += points && !pace.isTooSlow ? 1 : 0;
        water += points ? 0 : 1;
      }
      return { tries, water, points: pace.isTooSlow, sharp: pace.sharp, share: pace.share };
    };
    const passes = new Pace(null);
    const stays = new Pace(null);
    return [run(passes, 10, 3), run(passes, 60, 0.001), run(stays, 10, 3), run(stays, 1200, 3)];
  })())js");
  EXPECT_EQ(seen[0]["points"], true) << seen;
  EXPECT_EQ(seen[1]["points"], false) << seen;
  EXPECT_EQ(seen[1]["sharp"], 1) << seen;
  EXPECT_EQ(seen[1]["share"], 1) << seen;
  EXPECT_EQ(seen[2]["points"], true) << seen;
  EXPECT_GE(seen[3]["tries"], 3) << seen;
  EXPECT_LE(seen[3]["tries"], 8) << "it flickers between both";
  EXPECT_LE(seen[3]["water"], 60) << seen;
}

// A page that is out of sight, in which the browser takes no pictures, is not a slow one.
TEST_F(Glance, ATimeWithoutPicturesIsNotASlowOne) {
  const Json pace = with_the_modules(R"js((async () => {
    const { Pace } = await import('/pace.js');
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const pace = new Pace(null);
    for (let i = 0; i < 60; ++i) {
      now += 1000 / 60;
      pace.step(0.005);
    }
    now += 60000;
    pace.begin();
    for (let i = 0; i < 60; ++i) {
      now += 1000 / 60;
      pace.step(0.005);
    }
    return [pace.sharp, pace.share, pace.isTooSlow];
  })())js");
  EXPECT_EQ(pace, Json({1, 1, false}));
}

}  // namespace
}  // namespace splash::tests
