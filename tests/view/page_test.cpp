// SPDX-License-Identifier: MIT
// All three programs and the page in a real browser, as a person meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include "protocol/time_tag.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/process_use.hpp"
#include "tests/support/programs.hpp"
#include "tests/system/small_scene.hpp"
#include "tests/view/chromium.hpp"

namespace splash::tests {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kTimeout = 60.0;  ///< [s]
constexpr std::uint32_t kGrabbed = 4;

/// Still, high above the water.
constexpr const char* kWaits = "{kind: script, keyframes: [{time: 0.0, position: [0, 0, 0.35]}]}";

constexpr const char* kRig = R"(name: four
description: four tiles under the small scene
outputs:
  - name: floor
    kind: tiles
    band: {low: 20, high: 750}
    tiles: {origin: [-0.2, -0.2, 0.0], columns: 2, rows: 2, size: 0.2, reach: 0.4}
    full_scale: 0.01
    ceiling: 0.9
)";

/// Where a program that was started with --show lets viewers in.
std::string shown_at(ChildProcess& process) {
  EXPECT_TRUE(process.wait_for_text("viewers: ")) << process.output();
  const std::string text = process.output();
  const auto begin = text.find("viewers: ") + 9;
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// Programs and browser; all ports stay when one of them is started again.
class Stage {
 public:
  explicit Stage(const std::string& motion, const std::string& query = "?share=0.5")
      : scene_(motion), rig_(temporary_path("four.yaml")) {
    std::ofstream(rig_) << kRig;
    start_synth("127.0.0.1:0", "127.0.0.1:0");
    start_simulator("127.0.0.1:0", "127.0.0.1:0");
    start_view("127.0.0.1:0");
    browser_ = std::make_unique<Chromium>("http://" + at(*view_) + "/" + query);
    EXPECT_TRUE(browser_->wait_for("window.splash && splash.pictures() > 2", kTimeout)) << words();
    // Only the picture is to be seen in pictures.
    browser_->evaluate(
        "for (const one of document.querySelectorAll('header, #hint, nav, #panel, footer')) "
        "one.style.visibility = 'hidden'");
  }

  void start_synth(const std::string& listen, const std::string& show) {
    synth_ = std::make_unique<Synth>(
        Arguments{"--rig", rig_, "--device", "null", "--listen", listen, "--show", show});
    synth_show_ = shown_at(synth_->process());
  }
  void start_simulator(const std::string& listen, const std::string& show) {
    simulator_ = std::make_unique<Simulator>(Arguments{"--scene", scene_.path(), "--listen", listen,
                                                       "--show", show, "--target", at(*synth_)});
    sim_show_ = shown_at(simulator_->process());
  }
  void start_view(const std::string& listen) {
    view_ = std::make_unique<Daemon>(
        "view-server",
        Arguments{"--listen", listen, "--sim", at(*simulator_), "--synth", at(*synth_),
                  "--sim-show", sim_show_, "--synth-show", synth_show_});
  }
  [[nodiscard]] static std::string at(const Daemon& daemon) {
    return protocol::to_string(daemon.endpoint());
  }
  [[nodiscard]] Chromium& browser() { return *browser_; }
  [[nodiscard]] Synth& synth() { return *synth_; }
  [[nodiscard]] Simulator& simulator() { return *simulator_; }
  [[nodiscard]] Daemon& view() { return *view_; }
  [[nodiscard]] const std::string& sim_show() const { return sim_show_; }
  [[nodiscard]] const std::string& synth_show() const { return synth_show_; }
  /// What the page says of the programs.
  [[nodiscard]] std::string words() {
    return browser_->evaluate("document.getElementById('state').textContent").get<std::string>();
  }
  /// Where places of the scene are in the picture [CSS pixels].
  Json seen(const Json& places) {
    return browser_->evaluate(R"js((async (places) => {
      const { transform } = await import('/vector.js');
      const { both } = splash.camera.matrices();
      return places.map((place) => {
        const [x, y] = transform(both, place);
        return [(0.5 + 0.5 * x) * innerWidth, (0.5 - 0.5 * y) * innerHeight];
      });
    }))js" + ("(" + places.dump() + ")"));
  }

 private:
  SmallScene scene_;
  std::string rig_;
  std::string synth_show_;
  std::string sim_show_;
  std::unique_ptr<Synth> synth_;
  std::unique_ptr<Simulator> simulator_;
  std::unique_ptr<Daemon> view_;
  std::unique_ptr<Chromium> browser_;
};

class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (!Chromium::is_there()) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  }
};

/// Water is turquoise, the ground is grey.
double turquoise(const Json& colour) {
  return colour[1].get<double>() - colour[0].get<double>();
}

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

/// Moves the mouse from one place to another within so many seconds, a hundred times a second.
void drag(Chromium& browser, const Json& from, const Json& to, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  for (double share = 0.0; share < 1.0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
    share = std::min(gone.count() / seconds, 1.0);
    const auto between = [&](int axis) {
      return from[axis].get<double>() + share * (to[axis].get<double>() - from[axis].get<double>());
    };
    browser.mouse_on("mouseMoved", between(0), between(1));
  }
}

TEST_F(Page, AHandThatIsDraggedHitsTheWaterAndIsGivenBack) {
  Stage stage(kWaits, "?points");
  Chromium& browser = stage.browser();
  // A way of 0.3 m in the plane that faces the eye.
  const Json way = browser.evaluate(R"((async () => {
    const { add, cross, scale } = await import('/vector.js');
    const { camera } = splash;
    const right = cross(camera.forward, [0, 0, 1]).map((x) => x / Math.cos(camera.elevation));
    const up = cross(right, camera.forward);
    return [[0, 0, 0.35], add([0, 0, 0.35], scale(up, -0.3))];
  })())");
  const Json seen = stage.seen(way);
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
