// SPDX-License-Identifier: MIT
// What moves a body besides a mouse: a game controller, a pen, fingers, a headset's controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/view/picture.hpp"
#include "tests/view/played_page.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Hands : public InABrowser {};

constexpr const char* kController = R"js({
  window.pad = { index: 0, connected: true, axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ pressed: false })) };
  navigator.getGamepads = () => [null, pad];
})js";

TEST_F(Hands, AGameControllerHoldsTheDisc) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220);
  Chromium& browser = page.browser();
  browser.evaluate(kController);
  browser.evaluate("pad.axes[3] = 1");  // nothing is held yet
  browser.evaluate("pad.buttons[0].pressed = true");
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  EXPECT_TRUE(page.disc_comes("z < 0.30")) << "the right stick down is down";
  browser.evaluate("pad.axes = [1, 0, 0, 0]");
  // From the camera, to the right is towards +x and +y; the tank's walls stop it.
  EXPECT_TRUE(page.disc_comes("x > 0.05 && y > 0.03"));
  browser.evaluate("pad.axes = [0, 0, 0, 0]; pad.buttons[0].pressed = false");
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));
  EXPECT_TRUE(page.disc_comes("Math.hypot(x, y, z - 0.35) < 0.01")) << "back on its own way";
  browser.evaluate("pad.buttons[7].pressed = true");  // the right trigger
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  browser.evaluate("pad.connected = false");
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout)) << "it was unplugged";
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Hands, APenHoldsTheDisc) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220);
  Chromium& browser = page.browser();
  browser.evaluate(
      "window.kinds = new Set(); document.getElementById('water')"
      ".addEventListener('pointermove', (event) => kinds.add(event.pointerType))");
  const Json way = way_down(browser);
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
  EXPECT_TRUE(page.disc_comes("Math.abs(z - 0.215) < 0.03"))
      << browser.evaluate("splash.playout.states.at(-1)?.bodies[0]").dump();
  EXPECT_EQ(browser.evaluate("[...kinds]"), Json({"pen"}));
  pen("mouseReleased", 0.5);
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

/// Another visitor, of whom only the connection is there.
constexpr const char* kVisitor = R"js((async () => {
  const { encode } = await import('/osc.js');
  window.visitor = new WebSocket(`ws://${location.host}/view`);
  await new Promise((open) => { visitor.onopen = open; });
  visitor.send(encode('/body/grab', ',ii', 0, 1));
}))js";

TEST_F(Hands, ABodyThatAnotherVisitorHoldsIsNotTakenAndIsSaidToBeHeld) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220);
  Chromium& browser = page.browser();
  const Json at = way_down(browser)[0];
  browser.evaluate(std::string(kVisitor) + "()");
  ASSERT_TRUE(browser.wait_for("splash.grabs.isHeld(0)", kTimeout));
  const auto press = [&] {
    browser.mouse("mousePressed", at[0], at[1]);
    const bool holds = browser.evaluate("splash.grabs.holds(0)");
    browser.mouse("mouseReleased", at[0], at[1]);
    return holds;
  };
  EXPECT_FALSE(press());
  EXPECT_EQ(browser.evaluate("document.getElementById('state').textContent"),
            "Another visitor holds disc; it is free when they let go");
  browser.evaluate("visitor.close()");
  ASSERT_TRUE(browser.wait_for("!splash.grabs.isHeld(0)", kTimeout));
  EXPECT_TRUE(press());
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

TEST_F(Hands, OneFingerHoldsTheDiscWhileAnotherTurnsTheCameraAndTwoZoom) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220);
  Chromium& browser = page.browser();
  const Json way = way_down(browser);
  const double azimuth = browser.evaluate("splash.camera.azimuth");
  touch(browser, "touchStart", {way[0], {20, 150}});
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  touch(browser, "touchMove", {way[1], {60, 150}});
  EXPECT_TRUE(browser.wait_for(
      "Math.abs(splash.camera.azimuth - (" + std::to_string(azimuth) + " - 40 * 0.006)) < 1e-3",
      kTimeout))
      << browser.evaluate("splash.camera.azimuth");
  EXPECT_TRUE(page.disc_comes("z < 0.30"));
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

TEST_F(Hands, ABodyUnderTheWaterIsSeenThroughPoints) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220, 0.44);
  Chromium& browser = page.browser();
  const Json colours =
      drawn(browser, seen(browser, {{0.0, 0.0, PlayedPage::kRest}, {0.0, 0.0, 0.1}}));
  EXPECT_GT(colours[0][0].get<int>(), colours[1][0].get<int>() + 25) << colours;
  EXPECT_GT(colours[0][2].get<int>(), 50) << "through the water " << colours;
  EXPECT_THAT(browser.errors(), IsEmpty());
}

/// A headset that the page is made to believe in: one eye that sees what the camera sees, and one
/// controller, whose place is `hand.place`, in WebXR's axes.
constexpr const char* kHeadset = R"js((async () => {
  const still = { x: 0, y: 0, z: 0, w: 1 };
  window.hand = { source: { gripSpace: {}, targetRaySpace: {} }, place: { x: 0, y: 0, z: 0 } };
  const eye = { projectionMatrix: splash.camera.matrices().projection,
    transform: { inverse: { matrix: new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
      0, -1, 0, 1]) } } };
  class Session extends EventTarget {
    renderState = {};
    updateRenderState(state) { Object.assign(this.renderState, state); }
    async requestReferenceSpace() { return {}; }
    requestAnimationFrame(act) { setTimeout(() => act(performance.now(), this.frame), 30); }
    async end() { this.dispatchEvent(new Event('end')); }
    frame = { getViewerPose: () => ({ views: [eye] }),
      getPose: () => ({ transform: { position: window.hand.place, orientation: still } }) };
  }
  window.session = new Session();
  window.XRWebGLLayer = class {
    framebuffer = null;
    getViewport() { return { x: 0, y: 0, width: 200, height: 160 }; }
  };
  WebGL2RenderingContext.prototype.makeXRCompatible = async () => {};
  Object.defineProperty(navigator, 'xr', { configurable: true,
    value: { isSessionSupported: async () => true, requestSession: async () => window.session } });
  window.pull = (kind) => window.session.dispatchEvent(Object.assign(new Event(kind),
    { inputSource: window.hand.source, frame: window.session.frame }));
  document.getElementById('headset').click();
}))js";

TEST_F(Hands, AControllerOfAHeadsetHoldsABody) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?share=0.4", 240, 180);
  Chromium& browser = page.browser();
  browser.evaluate(std::string(kHeadset) + "()");
  ASSERT_TRUE(browser.wait_for("splash.headset.session", kTimeout));
  // The disc as WebXR sees it: 0.35 m over the tank's lower side, which stands on a table.
  browser.evaluate("Object.assign(hand.place, { x: 0, y: 0.75 + 0.35, z: -0.35 - 0.2 })");
  browser.evaluate("pull('selectstart')");
  EXPECT_TRUE(browser.evaluate("splash.grabs.holds(0)"));
  browser.evaluate("hand.place.x += 0.08; hand.place.y -= 0.05; hand.place.z += 0.03");
  // To the right is to the right, up is up, and towards the viewer is the scene's -y.
  EXPECT_TRUE(browser.wait_for(R"js((() => {
    const [x, y, z] = splash.playout.states.at(-1).bodies[0].place;
    return Math.hypot(x - 0.08, y + 0.03, z - 0.30) < 0.01;
  })())js",
                               kTimeout))
      << browser.evaluate("splash.playout.states.at(-1).bodies[0].place").dump();
  EXPECT_EQ(browser.evaluate("splash.playout.states.at(-1).bodies[0].flags & 4"), 4);
  browser.evaluate("pull('selectend')");
  EXPECT_FALSE(browser.evaluate("splash.grabs.holds(0)"));
  browser.evaluate("document.getElementById('headset').click()");
  EXPECT_TRUE(browser.wait_for("splash.headset.session === null", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

}  // namespace
}  // namespace splash::tests
