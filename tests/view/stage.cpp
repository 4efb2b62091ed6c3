// SPDX-License-Identifier: MIT
#include "tests/view/stage.hpp"

#include <algorithm>

#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/waiting.hpp"

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
    : scene_(motion), rig_(folder_.write("four.yaml", kRig)), recording_(recording) {
  start_synth("127.0.0.1:0", "127.0.0.1:0");
  start_simulator("127.0.0.1:0", "127.0.0.1:0");
  start_view("127.0.0.1:0");
  browser_ = std::make_unique<Chromium>(window);
  load(query);
}

void Stage::load(const std::string& query) {
  show_page(*browser_, "http://" + at(*view_) + "/" + query, [this] { return words(); });
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

ShownDisc shown_disc(const FrameViewer& viewer) {
  constexpr std::uint32_t kGrabbed = 4;  // flag of a body in a state
  constexpr std::size_t kBody = 56;      // where the first one begins
  viewer.ask();
  const protocol::ViewFrame frame = viewer.read();
  if (frame.size() < kBody + 32) return {};
  return {(protocol::frame_number<std::uint32_t>(&frame[kBody + 28]) & kGrabbed) != 0,
          protocol::frame_number<float>(&frame[kBody + 8])};
}

void drag(Chromium& browser, const Json& from, const Json& to, double seconds) {
  const double start = protocol::monotonic_now();
  for (double share = 0.0; share < 1.0;) {
    sleep(0.01);
    share = std::min((protocol::monotonic_now() - start) / seconds, 1.0);
    const auto between = [&](int axis) {
      return from[axis].get<double>() + share * (to[axis].get<double>() - from[axis].get<double>());
    };
    browser.mouse_on("mouseMoved", between(0), between(1));
  }
}

}  // namespace splash::tests
