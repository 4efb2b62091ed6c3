// SPDX-License-Identifier: MIT
// What hands hold besides a mouse: a game controller, a pen, two fingers; and what a person keeps:
// pictures and films.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Inputs : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }
};

/// Whether the newest state's disc comes to a place for which `condition` of x, y and z holds.
bool disc_comes(Chromium& browser, const std::string& condition) {
  return browser.wait_for(
      "(([x, y, z]) => " + condition + ")(splash.playout.states.at(-1)?.bodies[0].place ?? [])",
      kTimeout);
}

constexpr const char* kController = R"js({
  window.pad = { index: 0, connected: true, axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ pressed: false })) };
  navigator.getGamepads = () => [null, pad];
})js";

TEST_F(Inputs, AGameControllerHoldsTheDisc) {
  Stage stage(kWaits, "?points", "420,300");
  Chromium& browser = stage.browser();
  browser.evaluate(kController);
  browser.evaluate("pad.axes[3] = 1");  // nothing is held yet
  browser.evaluate("pad.buttons[0].pressed = true");
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  EXPECT_TRUE(disc_comes(browser, "z < 0.30")) << "the right stick down is down";
  browser.evaluate("pad.axes = [1, 0, 0, 0]");
  // From the camera, to the right is towards +x and +y; the tank's walls stop it.
  EXPECT_TRUE(disc_comes(browser, "x > 0.05 && y > 0.03"));
  browser.evaluate("pad.axes = [0, 0, 0, 0]; pad.buttons[0].pressed = false");
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));
  EXPECT_TRUE(disc_comes(browser, "Math.hypot(x, y, z - 0.35) < 0.01")) << "back on its own way";
  browser.evaluate("pad.buttons[7].pressed = true");  // the right trigger
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  browser.evaluate("pad.connected = false");
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout)) << "it was unplugged";
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Inputs, APenHoldsTheDisc) {
  Stage stage(kWaits, "?points", "420,300");
  Chromium& browser = stage.browser();
  browser.evaluate(
      "window.kinds = new Set(); document.getElementById('water')"
      ".addEventListener('pointermove', (event) => kinds.add(event.pointerType))");
  const Json way = stage.way_down();
  const auto pen = [&](const char* type, double share) {
    const auto at = [&](int axis) {
      return way[0][axis].get<double>() +
             share * (way[1][axis].get<double>() - way[0][axis].get<double>());
    };
    const std::string name = type;
    browser.call("Input.dispatchMouseEvent", {{"type", type},
                                              {"x", at(0)},
                                              {"y", at(1)},
                                              {"button", name == "mouseMoved" ? "none" : "left"},
                                              {"buttons", name == "mouseReleased" ? 0 : 1},
                                              {"clickCount", 1},
                                              {"force", 0.5},
                                              {"pointerType", "pen"}});
  };
  pen("mousePressed", 0.0);
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  for (int i = 1; i <= 10; ++i) pen("mouseMoved", 0.05 * i);
  // Half of the way down, 0.27 m as seen from above.
  EXPECT_TRUE(disc_comes(browser, "Math.abs(z - 0.215) < 0.03"))
      << browser.evaluate("splash.playout.states.at(-1)?.bodies[0]").dump();
  EXPECT_EQ(browser.evaluate("[...kinds]"), Json({"pen"}));
  pen("mouseReleased", 0.5);
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

/// `points`: [[x, y], ...] of the fingers that touch the page, each under its number.
void touch(Chromium& browser, const char* type, const Json& points) {
  Json fingers = Json::array();
  for (const Json& point : points) {
    fingers.push_back({{"x", point[0]}, {"y", point[1]}, {"id", fingers.size()}});
  }
  browser.call("Input.dispatchTouchEvent", {{"type", type}, {"touchPoints", fingers}});
}

TEST_F(Inputs, OneFingerHoldsTheDiscWhileAnotherTurnsTheCameraAndTwoZoom) {
  Stage stage(kWaits, "?points", "420,300");
  Chromium& browser = stage.browser();
  const Json way = stage.way_down();
  const double azimuth = browser.evaluate("splash.camera.azimuth");
  touch(browser, "touchStart", {way[0], {20, 150}});
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  touch(browser, "touchMove", {way[1], {60, 150}});
  EXPECT_TRUE(browser.wait_for(
      "Math.abs(splash.camera.azimuth - (" + std::to_string(azimuth) + " - 40 * 0.006)) < 1e-3",
      kTimeout))
      << browser.evaluate("splash.camera.azimuth");
  EXPECT_TRUE(disc_comes(browser, "z < 0.30"));
  touch(browser, "touchEnd", Json::array());
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));

  const double distance = browser.evaluate("splash.camera.distance");
  touch(browser, "touchStart", {{20, 140}, {20, 180}});
  touch(browser, "touchMove", {{20, 130}, {20, 190}});
  touch(browser, "touchMove", {{20, 120}, {20, 200}});
  EXPECT_TRUE(browser.wait_for(
      "Math.abs(splash.camera.distance / " + std::to_string(distance) + " - 0.5) < 1e-3", kTimeout))
      << browser.evaluate("splash.camera.distance").dump() << " of " << distance;
  touch(browser, "touchEnd", Json::array());
  EXPECT_FALSE(browser.evaluate("splash.grabs.holds(0)"));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

/// What the page saves goes to `saved` instead of a file: its name, its kind and its bytes.
constexpr const char* kKeep = R"js({
  window.saved = [];
  const blobs = new Map();
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => {
    const url = make(blob);
    blobs.set(url, blob);
    return url;
  };
  HTMLAnchorElement.prototype.click = async function () {
    const bytes = new Uint8Array(await blobs.get(this.href).arrayBuffer());
    saved.push({ name: this.download, bytes });
  };
})js";

/// The pictures in a WebM file (Matroska, RFC 9559): its blocks of track 1, in clusters of a
/// segment.
constexpr const char* kPictures = R"js((bytes) => {
  const number = (at, marked) => { // EBML's variable size (RFC 8794, section 4)
    const length = Math.clz32(bytes[at]) - 23;
    let value = marked ? bytes[at] : bytes[at] & (0xff >> length);
    for (let i = 1; i < length; ++i) value = 256 * value + bytes[at + i];
    return { value, next: at + length };
  };
  const INSIDE = [0x18538067, 0x1f43b675, 0xa0]; // segment, cluster, group of a block
  const BLOCKS = [0xa3, 0xa1];
  let pictures = 0;
  for (let at = 0; at < bytes.length;) {
    const id = number(at, true);
    const size = number(id.next, false);
    if (BLOCKS.includes(id.value) && number(size.next, false).value === 1) pictures += 1;
    at = INSIDE.includes(id.value) ? size.next : size.next + size.value;
  }
  return pictures;
})js";

TEST_F(Inputs, APictureAndAFilmAreSaved) {
  Stage stage(plunging(), "?points", "420,300");
  Chromium& browser = stage.browser();
  browser.evaluate(kKeep);
  browser.press("p");
  ASSERT_TRUE(browser.wait_for("saved.length === 1", kTimeout));
  EXPECT_EQ(browser.evaluate("/^small-.*\\.png$/.test(saved[0].name)"), true)
      << browser.evaluate("saved[0].name");
  EXPECT_EQ(browser.evaluate("[...saved[0].bytes.slice(0, 4)]"), Json({0x89, 'P', 'N', 'G'}));
  EXPECT_TRUE(browser.evaluate(R"js((async () => {
    const image = await createImageBitmap(new Blob([saved[0].bytes]));
    return image.width === document.getElementById('water').width;
  })())js"));

  browser.press("f");
  EXPECT_TRUE(browser.wait_for("document.getElementById('film').ariaPressed === 'true'", kTimeout));
  const int begun = browser.evaluate("splash.pictures()");
  EXPECT_TRUE(browser.wait_for("splash.pictures() > " + std::to_string(begun + 10), kTimeout));
  browser.press("f");
  ASSERT_TRUE(browser.wait_for("saved.length === 2", kTimeout));
  EXPECT_EQ(browser.evaluate("/^small-.*\\.webm$/.test(saved[1].name)"), true)
      << browser.evaluate("saved[1].name");
  EXPECT_EQ(browser.evaluate("[...saved[1].bytes.slice(0, 4)]"), Json({0x1a, 0x45, 0xdf, 0xa3}));
  EXPECT_GT(browser.evaluate("(" + std::string(kPictures) + ")(saved[1].bytes)").get<int>(), 1);
  EXPECT_EQ(browser.evaluate("document.getElementById('film').ariaPressed"), "false");
  EXPECT_THAT(browser.errors(), IsEmpty());
}

}  // namespace
}  // namespace splash::tests
