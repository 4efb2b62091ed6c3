// SPDX-License-Identifier: MIT
// How old pictures are when they are shown, and how far apart picture and sound of the same event
// are: all three programs on this machine, the page in Chromium without a screen and without a
// graphics card, which draws points, since software is slow at water. Prints what the page measures
// of itself.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/udp_socket.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/median.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"
#include "tests/view/chromium.hpp"

namespace {

using namespace splash;
using namespace splash::tests;

struct Settings {
  std::vector<std::string> scenes = {"basin", "pool"};
  int seconds = 20;  ///< of looking [s]
  std::string window = "480,320";
  std::string query = "?points";
  bool blind = false;  ///< nothing is drawn: the way of a state to the page alone
};

/// Graphics have nothing to do, all else goes its usual way.
constexpr const char* kBlind = "WebGL2RenderingContext.prototype.drawArrays = () => {};";

void look(bench::Table& table, const std::string& scene, const Settings& settings) {
  Synth synth({"--rig", "stereo", "--device", "null", "--show", "127.0.0.1:0"});
  Simulator simulator({"--scene", scene, "--show", "127.0.0.1:0", "--target",
                       protocol::to_string(synth.endpoint())});
  Daemon view("view-server", {"--sim", protocol::to_string(simulator.endpoint()), "--synth",
                              protocol::to_string(synth.endpoint()), "--sim-show",
                              protocol::to_string(simulator.viewers()), "--synth-show",
                              protocol::to_string(synth.viewers())});
  Chromium browser(settings.window, "swiftshader-webgl");
  if (settings.blind) {
    browser.call("Page.addScriptToEvaluateOnNewDocument", {{"source", kBlind}});
  }
  browser.call("Page.navigate",
               {{"url", "http://" + protocol::to_string(view.endpoint()) + "/" + settings.query}});
  if (!browser.wait_for("window.splash && splash.pictures() > 2", 120.0)) {
    throw std::runtime_error("the page shows nothing of " + scene);
  }
  browser.evaluate("document.getElementById('sound').click()");
  if (!browser.wait_for("splash.sound.lag !== null", 60.0)) {
    throw std::runtime_error("the page hears nothing of " + scene);
  }
  sleep(5.0);  // both have settled
  std::vector<double> half;
  std::vector<double> arrival;
  std::vector<double> age;
  std::vector<double> picture;
  std::vector<double> sound;
  std::vector<double> apart;
  const double before = browser.evaluate("splash.pictures()");
  for (int second = 0; second < settings.seconds; ++second) {
    sleep(1.0);
    const auto now = browser.evaluate("splash.latency()");
    half.push_back(median(browser.evaluate("splash.playout.arrivals")));
    arrival.push_back(now.at("arrival"));
    age.push_back(now.at("age"));
    picture.push_back(now.at("picture"));
    sound.push_back(now.at("sound"));
    apart.push_back(std::abs(picture.back() - sound.back()));
  }
  const double pictures = browser.evaluate("splash.pictures()").get<double>() - before;
  const auto ms = [](const std::vector<double>& values) {
    return bench::number(1e3 * median(values));
  };
  table.add({scene, bench::number(pictures / settings.seconds), ms(half), ms(arrival), ms(age),
             ms(picture), ms(sound), ms(apart),
             bench::number(1e3 * *std::max_element(apart.begin(), apart.end()))});
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Bench bench("view", "How old pictures are, and how far from the sound.");
  CLI::App& app = bench.options();
  app.add_option("--scene", settings.scenes, "Scenes (repeatable)")->capture_default_str();
  app.add_option("--seconds", settings.seconds, "Of looking, of each scene")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--window", settings.window, "The browser's, in pixels")->capture_default_str();
  app.add_option("--query", settings.query, "Of the page's address: ?points or ?share=0.5")
      ->capture_default_str();
  app.add_flag("--blind", settings.blind, "Draw nothing: the way of a state to the page alone");
  return bench.run(argc, argv, [&] {
    if (!Chromium::is_there())
      throw std::runtime_error("there is no chromium: apt-get install chromium");
    auto table =
        bench.table("view.csv", {"scene", "pictures/s", "half arrive [ms]", "95 % arrive [ms]",
                                 "are drawn [ms]", "event-picture [ms]", "event-sound [ms]",
                                 "apart [ms]", "most apart [ms]"});
    for (const std::string& scene : settings.scenes) look(table, scene, settings);
    return true;
  });
}
