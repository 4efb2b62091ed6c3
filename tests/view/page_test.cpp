// SPDX-License-Identifier: MIT
// All three programs and the page in a real browser, as a person meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "protocol/control.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/recording.hpp"
#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

constexpr std::uint32_t kGrabbed = 4;

class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }
};

TEST_F(Page, TheWaterIsWhereItIsAndMoves) {
  Stage stage(plunging());
  Chromium& browser = stage.browser();
  EXPECT_EQ(browser.evaluate("document.title"), "small - splash");
  EXPECT_EQ(browser.evaluate("document.getElementById('scene').textContent"), "small");
  browser.press("m");  // lit tiles would be seen through it
  EXPECT_TRUE(browser.wait_for("splash.peaks() && Math.max(...splash.peaks()) < 1e-4", 20.0));
  // In the midst of three walls and of the surface, as seen from the front; and beside the tank.
  const Json water = stage.seen({{0.0, -0.2, 0.1}, {-0.1, -0.2, 0.1}, {0.2, 0.0, 0.1}});
  const Json beside = stage.seen({{-0.45, -0.2, 0.0}, {0.45, 0.2, 0.0}, {0.0, 0.0, 0.62}});
  for (const Json& colour : browser.colours(water)) EXPECT_GT(turquoise(colour), 30.0) << colour;
  for (const Json& colour : browser.colours(beside)) EXPECT_LT(turquoise(colour), 22.0) << colour;
  Json grid = Json::array();
  for (int i = 0; i < 400; ++i) grid.push_back({20 + 34 * (i % 20), 10 + 18 * (i / 20)});
  const Json first = browser.colours(grid);
  EXPECT_TRUE(browser.wait_for(
      "splash.pictures() > " + browser.evaluate("splash.pictures() + 4").dump(), kTimeout));
  const Json second = browser.colours(grid);
  int different = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    different += std::abs(first[i][2].get<int>() - second[i][2].get<int>()) > 12 ? 1 : 0;
  }
  EXPECT_GT(different, 10);
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, ATapSoundsATileWhichIsLit) {
  Stage stage(kWaits);
  Chromium& browser = stage.browser();
  EXPECT_TRUE(browser.wait_for("splash.peaks() && splash.peaks().length === 4", kTimeout));
  sleep(2.5);  // the synth opens within two seconds
  const Json tiles = stage.seen({{0.1, -0.1, 0.0}, {-0.1, 0.1, 0.0}});
  const Json before = browser.colours(tiles);
  browser.press("o");
  // A tone lasts a second, and software may draw less than a picture in it.
  Json lit;
  bool brighter = false;
  for (int i = 0; i < 10 && !brighter; ++i) {
    browser.evaluate(
        "[...document.querySelectorAll('#channels button')].find((one) => one.textContent === '2')"
        ".click()");
    EXPECT_TRUE(browser.wait_for("splash.peaks()[1] > 0.02", 10.0));
    EXPECT_LT(browser.evaluate("splash.peaks()[2]"), 0.01);
    sleep(0.4);
    lit = browser.colours(tiles);
    brighter = lit[0][0].get<int>() > before[0][0].get<int>() + 20;
  }
  EXPECT_TRUE(brighter) << lit.dump() << before.dump();
  EXPECT_LT(lit[1][0].get<int>(), before[1][0].get<int>() + 12) << lit.dump() << before.dump();
  browser.evaluate("document.querySelector('#channel button').click()");  // mutes it
  EXPECT_TRUE(browser.wait_for(
      "document.querySelector('#channels button.muted')?.textContent === '2'", 10.0));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, AHandThatIsDraggedHitsTheWaterAndIsGivenBack) {
  const std::string wav = temporary_path("dragged.wav");
  Stage stage(kWaits, "?points", "720,480", wav);
  Chromium& browser = stage.browser();
  const Json seen = stage.way_down();
  browser.mouse("mouseMoved", seen[0][0], seen[0][1]);
  browser.mouse("mousePressed", seen[0][0], seen[0][1]);
  EXPECT_TRUE(browser.evaluate("splash.grabs.holds(0)"));
  const FrameViewer viewer(protocol::parse_endpoint(stage.sim_show(), 0));
  static_cast<void>(viewer.read());
  const auto body = [&] {
    viewer.ask();
    const protocol::ViewFrame frame = viewer.read();
    return std::pair{protocol::frame_number<std::uint32_t>(&frame[56 + 28]),
                     protocol::frame_number<float>(&frame[56 + 8])};
  };
  const auto becomes = [&](bool grabbed) {
    for (int i = 0; i < 300; ++i) {
      if (((body().first & kGrabbed) != 0) == grabbed) return true;
      sleep(0.02);
    }
    return false;
  };
  EXPECT_TRUE(becomes(true));
  drag(browser, seen[0], seen[1], 0.3);
  EXPECT_TRUE(browser.wait_for("splash.events.some((event) => event.kind === '/impact')", 10.0));
  const double speed =
      browser.evaluate("splash.events.find((event) => event.kind === '/impact').values[2]");
  EXPECT_GT(speed, 0.6);
  EXPECT_LT(speed, 1.5);
  RecordProperty("speed", std::to_string(speed));
  EXPECT_LT(body().second, 0.25F) << "held in the water";
  EXPECT_THAT(browser.errors(), IsEmpty());
  browser.kill();
  EXPECT_TRUE(becomes(false)) << "still grabbed, though the page is gone";
  for (int i = 0; i < 300 && body().second < 0.34F; ++i) sleep(0.02);
  EXPECT_NEAR(body().second, 0.35F, 0.01F) << "back on its own way";
  stage.synth().process().signal(SIGTERM);
  EXPECT_EQ(stage.synth().process().wait_for_end(), 0) << stage.synth().process().output();
  float peak = 0.0F;
  for (const auto& channel : read_recording(wav).channels) {
    for (const float sample : channel) peak = std::max(peak, std::abs(sample));
  }
  EXPECT_GT(peak, 1e-4F) << "nothing else sounded";
  std::filesystem::remove(wav);
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

TEST_F(Page, AControllerOfAHeadsetHoldsABody) {
  Stage stage(kWaits, "?share=0.5");
  Chromium& browser = stage.browser();
  browser.evaluate(std::string(kHeadset) + "()");
  ASSERT_TRUE(browser.wait_for("splash.headset.session", 10.0)) << stage.words();
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
                               20.0))
      << browser.evaluate("splash.playout.states.at(-1).bodies[0].place").dump();
  EXPECT_EQ(browser.evaluate("splash.playout.states.at(-1).bodies[0].flags & 4"), 4);
  browser.evaluate("pull('selectend')");
  EXPECT_FALSE(browser.evaluate("splash.grabs.holds(0)"));
  browser.evaluate("document.getElementById('headset').click()");
  EXPECT_TRUE(browser.wait_for("splash.headset.session === null", 10.0));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, IsHeard) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  browser.evaluate("document.getElementById('sound').click()");
  EXPECT_TRUE(browser.wait_for("splash.sound.isOn && splash.sound.lag !== null", kTimeout));
  EXPECT_TRUE(browser.wait_for("Math.max(...splash.sound.last(4000, 0)) > 1e-4", kTimeout));
  RecordProperty("lag_ms", browser.evaluate("Math.round(1000 * splash.sound.lag)").dump());
  EXPECT_LT(browser.evaluate("splash.sound.lag"), 0.5);
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, PausesAndBeginsAnew) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  browser.press(" ");
  EXPECT_TRUE(browser.wait_for("document.getElementById('state').textContent === 'Paused'", 20.0));
  const double then = browser.evaluate("splash.playout.states.at(-1).simulated");
  sleep(1.0);
  EXPECT_EQ(browser.evaluate("splash.playout.states.at(-1).simulated"), then);
  browser.evaluate("document.getElementById('reset').click()");
  browser.evaluate("document.getElementById('pause').click()");
  EXPECT_TRUE(browser.wait_for(
      "splash.playout.states.at(-1).simulated > " + std::to_string(then + 0.2), 20.0));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, ItsPanelShapesTheDetection) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  const std::string slider = R"([...document.querySelectorAll('#detection label')]
    .find((one) => one.textContent.startsWith('impact speed')))";
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('#detection label').length"), 20);
  browser.evaluate("{ const input = " + slider +
                   ".querySelector('input'); input.value = 1000;"
                   " input.dispatchEvent(new Event('input')); }");
  for (int i = 0; i < 100; ++i) {
    if (stage.simulator().ask({"/param", {"detect/impact_speed"}}, "/value") ==
        protocol::value_of("detect/impact_speed", 10.0)) {
      break;
    }
    sleep(0.1);
  }
  EXPECT_EQ(stage.simulator().ask({"/param", {"detect/impact_speed"}}, "/value"),
            protocol::value_of("detect/impact_speed", 10.0));
  // What somebody else sets is shown.
  static_cast<void>(stage.simulator().ask({"/param", {"detect/impact_speed", 0.0F}}, "/value"));
  EXPECT_TRUE(browser.wait_for(slider + ".querySelector('input').value === '0'", 10.0));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, GoesOverToAnotherSceneAndRig) {
  Stage stage(kWaits, "?points");
  Chromium& browser = stage.browser();
  const auto choose = [&](const std::string& list, const std::string& name) {
    browser.evaluate("{ const list = document.getElementById('" + list + "'); list.value = '" +
                     name + "'; list.dispatchEvent(new Event('change')); }");
  };
  choose("rigs", "stereo");
  EXPECT_TRUE(browser.wait_for("splash.alive().synth && splash.peaks()?.length === 2", kTimeout))
      << stage.words();
  browser.evaluate(R"js({
    window.said = [];
    const state = document.getElementById('state');
    new MutationObserver(() => said.push(state.textContent)).observe(state, { childList: true });
  })js");
  choose("scenes", "plunge");
  EXPECT_TRUE(browser.wait_for("said.some((text) => text.includes('made ready'))", 10.0))
      << browser.evaluate("said");
  EXPECT_TRUE(browser.wait_for("splash.world().name === 'plunge' && splash.pictures() > 2", 180.0))
      << stage.words();
  EXPECT_EQ(browser.evaluate("document.getElementById('scenes').value"), "plunge");
  EXPECT_TRUE(browser.wait_for(
      "splash.playout.states.length > 1 && splash.alive().synth && splash.alive().sim", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, SaysInWordsWhatHasEndedAndComesBack) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  const auto says = [&](const std::string& text) {
    return browser.wait_for("document.getElementById('state').textContent.includes('" + text + "')",
                            20.0);
  };
  const auto is_well = [&] {
    return browser.wait_for(
        "splash.link.isOpen && splash.alive().sim && "
        "splash.alive().synth && splash.playout.states.length > 1",
        kTimeout);
  };
  ASSERT_TRUE(is_well()) << stage.words();
  const std::string sim = Stage::at(stage.simulator());
  stage.simulator().process().signal(SIGKILL);
  EXPECT_TRUE(says("No simulator")) << stage.words();
  const std::string sim_show = stage.sim_show();
  stage.start_simulator(sim, sim_show);
  EXPECT_TRUE(is_well()) << stage.words();

  const std::string synth = Stage::at(stage.synth());
  const std::string synth_show = stage.synth_show();
  stage.synth().process().signal(SIGKILL);
  EXPECT_TRUE(says("No synth")) << stage.words();
  stage.start_synth(synth, synth_show);
  EXPECT_TRUE(is_well()) << stage.words();

  const std::string view = Stage::at(stage.view());
  stage.view().process().signal(SIGKILL);
  EXPECT_TRUE(says("view-server does not answer")) << stage.words();
  stage.start_view(view);
  EXPECT_TRUE(is_well()) << stage.words();
}

}  // namespace
}  // namespace splash::tests
