// SPDX-License-Identifier: MIT
// All three programs and the page in a real browser, as a person meets them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "protocol/control.hpp"
#include "sim-server/scene/live_rows.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"
#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

class Page : public InABrowser {};

TEST_F(Page, TheWaterIsWhereItIsAndMoves) {
  Stage stage(plunging());
  Chromium& browser = stage.browser();
  EXPECT_EQ(browser.evaluate("document.title"), "small - splash");
  EXPECT_EQ(browser.evaluate("document.getElementById('scene').textContent"), "small");
  browser.press("m");  // lit tiles would be seen through it
  EXPECT_TRUE(browser.wait_for("splash.peaks() && Math.max(...splash.peaks()) < 1e-4", kTimeout));
  // In the midst of three walls and of the surface, as seen from the front; and beside the tank.
  const Json water = stage.seen({{0.0, -0.2, 0.1}, {-0.1, -0.2, 0.1}, {0.2, 0.0, 0.1}});
  const Json beside = stage.seen({{-0.45, -0.2, 0.0}, {0.45, 0.2, 0.0}, {0.0, 0.0, 0.62}});
  for (const Json& colour : browser.colours(water)) EXPECT_GT(turquoise(colour), 30.0) << colour;
  for (const Json& colour : browser.colours(beside)) EXPECT_LT(turquoise(colour), 22.0) << colour;
  Json grid = Json::array();
  for (int i = 0; i < 400; ++i) grid.push_back({180 + 18 * (i % 20), 52 + 10 * (i / 20)});
  const Json first = browser.colours(grid);
  const std::string newest = "splash.playout.states.at(-1).simulated";
  const std::string later = browser.evaluate(newest + " + 1").dump();
  EXPECT_TRUE(browser.wait_for(newest + " > " + later, kTimeout));
  const Json second = browser.colours(grid);
  int different = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    different += std::abs(first[i][2].get<int>() - second[i][2].get<int>()) > 12 ? 1 : 0;
  }
  EXPECT_GT(different, 10);
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, ATapSoundsATileWhichIsLit) {
  Stage stage(kWaits, "?share=0.4", "420,300");
  Chromium& browser = stage.browser();
  EXPECT_TRUE(browser.wait_for("splash.peaks() && splash.peaks().length === 4", kTimeout));
  const Json tiles = stage.seen({{0.1, -0.1, 0.0}, {-0.1, 0.1, 0.0}});
  const Json before = stage.drawn(tiles);
  browser.press("o");
  // A tone lasts a second, and software may draw less than a picture in it: it is tapped again and
  // again, and the loudest that was told counts.
  browser.evaluate(R"js({
    window.loudest = [0, 0, 0, 0];
    setInterval(() => splash.peaks().forEach((peak, i) => {
      loudest[i] = Math.max(loudest[i], peak); }), 20);
    window.taps = setInterval(() => [...document.querySelectorAll('#channels button')]
      .find((one) => one.textContent === '2').click(), 300);
  })js");
  Json lit;
  EXPECT_TRUE(eventually(
      [&] {
        lit = stage.drawn(tiles);
        return lit[0][0].get<int>() > before[0][0].get<int>() + 20;
      },
      kTimeout))
      << lit << before;
  EXPECT_LT(lit[1][0].get<int>(), before[1][0].get<int>() + 12) << lit << before;
  EXPECT_TRUE(browser.wait_for("loudest[1] > 0.02", kTimeout)) << browser.evaluate("loudest");
  EXPECT_LT(browser.evaluate("loudest[2]"), 0.01);
  browser.evaluate("clearInterval(taps)");
  browser.evaluate("document.querySelector('#channel button').click()");  // mutes it
  EXPECT_TRUE(browser.wait_for(
      "document.querySelector('#channels button.muted')?.textContent === '2'", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

/// What the page was told of a drag through the surface.
struct Drag {
  double speed = 0.0;  ///< of the first impact [m/s]
  double lag = 1e9;    ///< from when the disc's pose met the water to the moment of that impact [s]
};

/// Of some drags at 1 m/s the one with the least lag, both moments by the programs' own clock: a
/// busy machine may leave out poses of some, but what is late in the programs is late in all of
/// them.
Drag best_drag(Chromium& browser, const Json& way) {
  browser.evaluate(R"js({
    const { link } = splash;
    const { sendAt } = link;
    window.poses = [];
    link.sendAt = function (time, address, types, ...values) {
      poses.push([time + link.offset, values[3]]);
      return sendAt.call(link, time, address, types, ...values);
    };
  })js");
  const std::string surface = std::to_string(SmallScene::kLevel + SmallScene::kUnderside);
  Drag best;
  for (int i = 0; i < 10 && best.lag > 0.1; ++i) {
    browser.evaluate("poses.length = 0; splash.events.length = 0");
    drag(browser, way[0], way[1], 0.3);
    const bool hit =
        browser.wait_for("splash.events.some((event) => event.kind === '/impact')", 5.0);
    if (hit) {
      const Json told = browser.evaluate(R"js((() => {
        const { values, time } = splash.events.find((event) => event.kind === '/impact');
        return [values[2], time - (poses.find(([, z]) => z < )js" +
                                         surface + R"js()?.[0] ?? -1e9)];
      })())js");
      if (told[1] < best.lag) best = {told[0], told[1]};
    }
    drag(browser, way[1], way[0], 0.3);
    sleep(1.0);
  }
  drag(browser, way[0], way[1], 0.3);
  return best;
}

TEST_F(Page, AHandThatIsDraggedHitsTheWaterAndIsGivenBack) {
  const TemporaryFolder folder;
  const std::string wav = folder / "dragged.wav";
  Stage stage(kWaits, "?points", "720,480", wav);
  Chromium& browser = stage.browser();
  const Json seen = stage.way_down();
  browser.mouse("mouseMoved", seen[0][0], seen[0][1]);
  browser.mouse("mousePressed", seen[0][0], seen[0][1]);
  EXPECT_TRUE(browser.evaluate("splash.grabs.holds(0)"));
  const FrameViewer viewer(protocol::parse_endpoint(stage.sim_show(), 0));
  static_cast<void>(viewer.read());
  const auto is_grabbed = [&] { return shown_disc(viewer).grabbed; };
  const auto height = [&] { return shown_disc(viewer).height; };
  EXPECT_TRUE(eventually(is_grabbed, kTimeout));
  const Drag drag = best_drag(browser, seen);
  EXPECT_GT(drag.speed, 0.6);
  EXPECT_LT(drag.speed, 1.5);
  EXPECT_LT(drag.lag, 0.1);
  EXPECT_GT(drag.lag, -0.05) << "before the disc was there";
  RecordProperty("speed", std::to_string(drag.speed));
  RecordProperty("lag_ms", std::to_string(std::lround(1e3 * drag.lag)));
  EXPECT_TRUE(eventually([&] { return height() < 0.25F; }, kTimeout)) << "held in the water";
  EXPECT_THAT(browser.errors(), IsEmpty());
  browser.kill();
  EXPECT_TRUE(eventually([&] { return !is_grabbed(); }, kTimeout))
      << "still grabbed, though the page is gone";
  EXPECT_TRUE(eventually([&] { return std::abs(height() - 0.35F) < 0.01F; }, kTimeout))
      << "back on its own way";
  EXPECT_EQ(stage.synth().end(), 0) << stage.synth().process().output();
  float loudest = 0.0F;
  for (const auto& channel : read_recording(wav).channels) {
    loudest = std::max(loudest, peak(channel));
  }
  EXPECT_GT(loudest, 1e-4F) << "nothing else sounded";
}

TEST_F(Page, IsHeard) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  browser.evaluate("document.getElementById('sound').click()");
  EXPECT_TRUE(browser.wait_for("splash.sound.isOn && splash.sound.lag !== null", kTimeout));
  EXPECT_TRUE(browser.wait_for("Math.max(...splash.sound.last(4000, 0)) > 1e-4", kTimeout));
  RecordProperty("lag_ms", browser.evaluate("Math.round(1000 * splash.sound.lag)").dump());
  EXPECT_TRUE(browser.wait_for("splash.sound.lag < 0.5", kTimeout))
      << browser.evaluate("splash.sound.lag");
  // Sound goes on while the page's main thread is busy for a second. One of ten tries has to show
  // it, since a loaded machine may not let the audio thread run.
  browser.evaluate(R"js({
    const { sound } = splash;
    const { measure } = sound;
    window.heard = [];
    sound.measure = (report) => {
      heard.push(report.context);
      return measure.call(sound, report);
    };
  })js");
  bool goes_on = false;
  for (int i = 0; i < 10 && !goes_on; ++i) {
    const Json gap = browser.evaluate(R"js((async () => {
      const rest = (time) => new Promise((done) => setTimeout(done, time));
      await rest(1000);
      heard.length = 0;
      await rest(500);
      const begin = performance.now();
      while (performance.now() < begin + 1000);
      await rest(1000);
      return Math.max(...heard.map((context, i) => context - (heard[i - 1] ?? context)));
    })())js");
    goes_on = gap.is_number() && gap.get<double>() > 0.0 && gap.get<double>() < 0.4;
  }
  EXPECT_TRUE(goes_on) << browser.evaluate("heard");
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, PausesAndBeginsAnew) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  const auto figures = [&](const std::string& condition) {
    return browser.wait_for(
        "((text) => " + condition + ")(document.getElementById('figures').textContent)", kTimeout);
  };
  EXPECT_TRUE(figures("text.includes('are drawn within')"));
  browser.press(" ");
  EXPECT_TRUE(
      browser.wait_for("document.getElementById('state').textContent === 'Paused'", kTimeout));
  EXPECT_TRUE(figures("text.includes('paused') && !text.includes('within')"));
  const double then = browser.evaluate("splash.playout.states.at(-1).simulated");
  sleep(1.0);
  EXPECT_EQ(browser.evaluate("splash.playout.states.at(-1).simulated"), then);
  browser.evaluate("document.getElementById('reset').click()");
  browser.evaluate("document.getElementById('pause').click()");
  EXPECT_TRUE(browser.wait_for(
      "splash.playout.states.at(-1).simulated > " + std::to_string(then + 0.2), kTimeout));
  EXPECT_TRUE(figures("text.includes('are drawn within')"));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

TEST_F(Page, ItsPanelShapesTheDetection) {
  Stage stage(plunging(), "?points");
  Chromium& browser = stage.browser();
  const std::string slider = R"([...document.querySelectorAll('#detection label')]
    .find((one) => one.textContent.startsWith('impact speed')))";
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('#detection label').length"),
            sim::LiveRows({}).rows().size());
  browser.evaluate("{ const input = " + slider +
                   ".querySelector('input'); input.value = 1000;"
                   " input.dispatchEvent(new Event('input')); }");
  EXPECT_TRUE(eventually(
      [&] {
        return stage.simulator().ask({"/param", {"detect/impact_speed"}}, "/value") ==
               protocol::value_of("detect/impact_speed", 10.0);
      },
      kTimeout, 0.1));
  // What somebody else sets is shown.
  static_cast<void>(stage.simulator().ask({"/param", {"detect/impact_speed", 0.0F}}, "/value"));
  EXPECT_TRUE(browser.wait_for(slider + ".querySelector('input').value === '0'", kTimeout));
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
  EXPECT_TRUE(browser.wait_for("said.some((text) => text.includes('made ready'))", kTimeout))
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
                            kTimeout);
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
