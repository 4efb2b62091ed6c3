// SPDX-License-Identifier: MIT
#include "tests/view/stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "protocol/udp_socket.hpp"

namespace splash::tests {
namespace {

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

}  // namespace

Stage::Stage(const std::string& motion, const std::string& query, const std::string& window,
             const std::string& recording)
    : scene_(motion), rig_(temporary_path("four.yaml")), recording_(recording) {
  std::ofstream(rig_) << kRig;
  start_synth("127.0.0.1:0", "127.0.0.1:0");
  start_simulator("127.0.0.1:0", "127.0.0.1:0");
  start_view("127.0.0.1:0");
  browser_ = std::make_unique<Chromium>(window);
  load(query);
}

void Stage::load(const std::string& query) {
  browser_->call("Page.navigate", {{"url", "http://" + at(*view_) + "/" + query}});
  EXPECT_TRUE(browser_->wait_for("window.splash && splash.pictures() > 2", kTimeout)) << words();
  browser_->evaluate(
      "for (const one of document.querySelectorAll('header, #hint, nav, #panel, footer')) "
      "one.style.visibility = 'hidden'");
}

void Stage::start_synth(const std::string& listen, const std::string& show) {
  Arguments arguments = {"--rig", rig_, "--device", "null", "--listen", listen, "--show", show};
  if (!recording_.empty()) arguments.insert(arguments.end(), {"--record-audio", recording_});
  synth_ = std::make_unique<Synth>(arguments);
  synth_show_ = protocol::to_string(synth_->viewers());
}

void Stage::start_simulator(const std::string& listen, const std::string& show) {
  simulator_ = std::make_unique<Simulator>(Arguments{"--scene", scene_.path(), "--listen", listen,
                                                     "--show", show, "--target", at(*synth_)});
  sim_show_ = protocol::to_string(simulator_->viewers());
}

void Stage::start_view(const std::string& listen) {
  view_ = std::make_unique<Daemon>(
      "view-server", Arguments{"--listen", listen, "--sim", at(*simulator_), "--synth", at(*synth_),
                               "--sim-show", sim_show_, "--synth-show", synth_show_});
}

std::string Stage::at(const Daemon& daemon) {
  return protocol::to_string(daemon.endpoint());
}

std::string Stage::words() {
  return browser_->evaluate("document.getElementById('state')?.textContent ?? ''")
      .get<std::string>();
}

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

}  // namespace splash::tests
