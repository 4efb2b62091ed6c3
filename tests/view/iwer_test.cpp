// SPDX-License-Identifier: MIT
// A headset as another project emulates it, which knows the standard and not us: iwer (npm),
// fetched for this test alone. $SPLASH_IWER may name a copy of iwer.min.js.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/text_of.hpp"
#include "tests/view/stage.hpp"

namespace splash::tests {
namespace {

using testing::IsEmpty;

constexpr const char* kPackage = "iwer@2.5.0";

/// Its script, for browsers; empty: it cannot be had.
std::string iwer() {
  if (const char* own = std::getenv("SPLASH_IWER")) return text_of(own);
  const TemporaryFolder folder;
  ChildProcess npm({"sh", "-c",
                    "cd '" + folder.path().string() + "' && npm pack --fetch-retries=0 " +
                        kPackage + " && tar xzf iwer-*.tgz package/build/iwer.min.js"});
  return npm.wait(60.0) == 0 ? text_of(folder / "package/build/iwer.min.js") : "";
}

/// Before the page's own scripts: a headset with two controllers.
constexpr const char* kWear = R"js(
(() => {
  window.device = new IWER.XRDevice(IWER.metaQuest3);
  device.installRuntime({ forceInstall: true });
  device.position.set(0, 1.35, 0);
  window.hand = device.controllers.right;
})();
)js";

class Iwer : public InABrowser {};

TEST_F(Iwer, AControllerHoldsABodyAndMovesIt) {
  const std::string script = iwer();
  if (script.empty()) GTEST_SKIP() << "there is no npm, or it cannot fetch " << kPackage;
  Stage stage(kWaits, "?points", "240,180");
  Chromium& browser = stage.browser();
  browser.call("Page.addScriptToEvaluateOnNewDocument", {{"source", script + ';' + kWear}});
  stage.load("?share=0.4");
  ASSERT_TRUE(browser.wait_for("!document.getElementById('headset').hidden", kTimeout));
  browser.evaluate("document.getElementById('headset').click()");
  ASSERT_TRUE(browser.wait_for("splash.headset.session", kTimeout)) << stage.words();
  // The disc as WebXR sees it: 0.35 m over the tank's lower side, which stands on a table.
  browser.evaluate("hand.position.set(0, 0.75 + 0.35, -0.35 - 0.2)");
  browser.evaluate(
      "new Promise((done) => device.activeSession?.requestAnimationFrame(done) ?? "
      "splash.headset.session.requestAnimationFrame(() => done()))");
  browser.evaluate("hand.updateButtonValue('trigger', 1)");
  ASSERT_TRUE(browser.wait_for("splash.grabs.holds(0)", kTimeout));
  browser.evaluate("hand.position.set(0.08, 0.75 + 0.30, -0.35 - 0.2 + 0.03)");
  // To the right is to the right, up is up, and towards the viewer is the scene's -y.
  EXPECT_TRUE(browser.wait_for(R"js((() => {
    const [x, y, z] = splash.playout.states.at(-1).bodies[0].place;
    return Math.hypot(x - 0.08, y + 0.03, z - 0.30) < 0.01;
  })())js",
                               kTimeout))
      << browser.evaluate("splash.playout.states.at(-1).bodies[0].place").dump();
  EXPECT_EQ(browser.evaluate("splash.playout.states.at(-1).bodies[0].flags & 4"), 4);
  browser.evaluate("hand.updateButtonValue('trigger', 0)");
  EXPECT_TRUE(browser.wait_for("!splash.grabs.holds(0)", kTimeout));
  EXPECT_THAT(browser.errors(), IsEmpty());
}

}  // namespace
}  // namespace splash::tests
