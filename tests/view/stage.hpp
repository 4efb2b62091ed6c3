// SPDX-License-Identifier: MIT
// All three programs on a small scene, with the page in a real browser.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "tests/support/frame_viewer.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/view/chromium.hpp"
#include "tests/view/picture.hpp"

namespace splash::tests {

/// Still, high above the water.
inline constexpr const char* kWaits =
    "{kind: script, keyframes: [{time: 0.0, position: [0, 0, 0.35]}]}";

/// All ports stay when a program is started again.
class Stage {
 public:
  /// `motion`: of the small scene's disc; `query`: of the page's address; `window`: its size;
  /// `recording`: what the synth plays, as WAV. Waits for pictures.
  explicit Stage(const std::string& motion, const std::string& query = "?share=0.5",
                 const std::string& window = "720,480", const std::string& recording = "");

  void start_synth(const std::string& listen, const std::string& show);
  void start_simulator(const std::string& listen, const std::string& show);
  void start_view(const std::string& listen);
  /// Loads the page anew and waits for pictures, with nothing else in them.
  void load(const std::string& query);

  [[nodiscard]] static std::string at(const Daemon& daemon);
  [[nodiscard]] Chromium& browser() { return *browser_; }
  [[nodiscard]] Synth& synth() { return *synth_; }
  [[nodiscard]] Simulator& simulator() { return *simulator_; }
  [[nodiscard]] Daemon& view() { return *view_; }
  [[nodiscard]] const std::string& sim_show() const { return sim_show_; }
  [[nodiscard]] const std::string& synth_show() const { return synth_show_; }
  /// What the page says of the programs.
  [[nodiscard]] std::string words();
  Json seen(const Json& places) { return tests::seen(*browser_, places); }
  Json drawn(const Json& places) { return tests::drawn(*browser_, places); }
  Json way_down() { return tests::way_down(*browser_); }

 private:
  SmallScene scene_;
  TemporaryFolder folder_;
  std::string rig_;
  std::string recording_;
  std::string synth_show_;
  std::string sim_show_;
  std::unique_ptr<Synth> synth_;
  std::unique_ptr<Simulator> simulator_;
  std::unique_ptr<Daemon> view_;
  std::unique_ptr<Chromium> browser_;
};

/// The disc, as the simulator tells viewers.
struct ShownDisc {
  bool grabbed = false;
  float height = NAN;  ///< [m]
};
[[nodiscard]] ShownDisc shown_disc(const FrameViewer& viewer);

/// Moves the mouse from one place to another within so many seconds, a hundred times a second.
void drag(Chromium& browser, const Json& from, const Json& to, double seconds);

}  // namespace splash::tests
