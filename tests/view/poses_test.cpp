// SPDX-License-Identifier: MIT
// What the page sends while a body is held, and what comes while it draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/view/played_page.hpp"

namespace splash::tests {
namespace {

class Poses : public InABrowser {};

// A hand at 0.5 m/s of which the browser tells in heaps of three, 8 ms between them, each heap when
// its last has come. The page's clock and timers are the test's: two seconds of them, however long
// the machine takes for it.
TEST_F(Poses, AreEvenHoweverTheBrowserTellsOfTheHand) {
  PlayedPage& page = PlayedPage::shared();
  page.load_modules();
  page.browser().evaluate(R"((async () => {
    const rest = () => new Promise((done) => setTimeout(done, 1));
    const { Link } = await import('/link.js');
    const { Grabs } = await import('/grab.js');
    const nothing = () => {};
    const link = new Link({ open: nothing, closed: nothing, told: nothing, osc: nothing,
      SPC1: nothing, SPR1: nothing });
    while (!link.isOpen) await rest();
    let now = performance.now(); // [ms]
    performance.now = () => now;
    const timers = [];
    const setInterval = window.setInterval;
    window.setInterval = (act, period) => timers.push({ act, period, next: now + period });
    const grabs = new Grabs(link);
    window.setInterval = setInterval;
    grabs.bound({ lower: [-5, -5, -5], upper: [5, 5, 5] });
    grabs.take('test', 3, [0, 0, 0], [0, 0, 0, 1]);
    const start = now / 1000;
    for (let told = 1; told <= 250; ++told) {
      const moment = start + told * 0.008;
      for (const end = 1000 * moment; now < end; now = Math.min(now + 1, end)) {
        for (const timer of timers) {
          for (; timer.next <= now; timer.next += timer.period) timer.act();
        }
      }
      if (told % 3 !== 0) continue;
      for (const then of [moment - 0.016, moment - 0.008, moment]) {
        grabs.move('test', [0.5 * (then - start), 0, 0], undefined, then);
      }
      await rest();
    }
  })())");
  const std::vector<SentPose> poses = page.poses(3, 190);
  ASSERT_EQ(poses.size(), 190U);
  double worst = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].made - poses[i - 1].made, 0.01, 1e-6) << i;
    if (i < poses.size() / 2) continue;  // the filter has settled
    const double way = static_cast<double>(poses[i].pose.position.x - poses[i - 1].pose.position.x);
    const double speed = way / (poses[i].made - poses[i - 1].made);
    worst = std::max(worst, std::abs(speed - 0.5));
  }
  EXPECT_LT(worst, 0.05);
  RecordProperty("worst_speed", std::to_string(worst));
}

// While the page's main thread is busy for a second, in which the simulator shows some fifty
// states, several of them arrive, and not only the one that was on its way before.
TEST(States, ComeWhileThePageDraws) {
  PlayedPage& page = PlayedPage::shared();
  page.load("?points", 300, 220);
  const Json states = page.browser().evaluate(R"((async () => {
    const moments = [];
    const { link, playout } = splash;
    const push = playout.push;
    playout.push = function (state, now) {
      moments.push(state.moment);
      return push.call(this, state, now);
    };
    await new Promise((done) => setTimeout(done, 100));
    const begin = performance.now();
    const from = link.now();
    while (performance.now() < begin + 1000);
    const to = link.now();
    await new Promise((done) => setTimeout(done, 1000));
    return moments.filter((moment) => moment > from && moment < to).length;
  })())");
  EXPECT_GE(states.get<int>(), 3);
}

}  // namespace
}  // namespace splash::tests
