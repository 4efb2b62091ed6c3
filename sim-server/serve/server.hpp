// SPDX-License-Identifier: MIT
// The running simulator: frames against the wall clock, events out, poses and control in.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sim-server/gauge/gauge_file.hpp"
#include "sim-server/listen/clock_answers.hpp"
#include "sim-server/listen/control.hpp"
#include "sim-server/options.hpp"
#include "sim-server/scene/live_rows.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/send/force_sender.hpp"
#include "sim-server/send/target_status.hpp"
#include "sim-server/serve/numbered_events.hpp"
#include "sim-server/serve/overload.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/serve/pose_intake.hpp"
#include "sim-server/serve/recent_pace.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/show/show.hpp"
#include "sim-server/show/vtk_files.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

class Server {
 public:
  /// Opens sockets and log. Throws program::Failure with the exit code.
  Server(const Options& options, Simulation& simulation, const std::string& device);

  /// Frame after frame, until `ended` says so, /quit comes or the duration is over. Prints a line
  /// on the state now and then.
  void run(const std::function<bool()>& ended);
  /// Begins log and gauges anew, if somebody has moved the files away. Between two frames only.
  void reopen();
  /// Closes the log and asks the targets how they fared.
  [[nodiscard]] RunReport finish();
  /// Writes the report where the options want it. Throws program::Failure when that or a file
  /// before could not be written.
  void leave(const RunReport& report) const;

  /// Whether the thread that listens has turned since this was last asked.
  [[nodiscard]] bool listens();
  /// Neither a target nor a file was named.
  [[nodiscard]] bool is_unheard() const noexcept {
    return options_.targets.empty() && options_.record.empty();
  }
  /// Where viewers are let in; empty: nowhere.
  [[nodiscard]] std::optional<protocol::Endpoint> shown_at() const {
    return show_ ? std::optional(show_->local()) : std::nullopt;
  }
  /// The scene to go over to, once run() is over; empty: the program ends.
  [[nodiscard]] std::filesystem::path next_scene() const;
  /// Where poses and control are listened for.
  [[nodiscard]] protocol::Endpoint local() const noexcept { return control_.local(); }

 private:
  /// What the control port may do.
  [[nodiscard]] ControlActions actions();
  /// On stderr, not more often than once a second.
  void say(const StepFault& step_fault);
  void send(const FrameResult& frame);
  void tell_forces(const FrameResult& frame);
  /// What was set since the last frame holds from now on, and clients of /notify hear of it.
  void take_rows();
  void show(const FrameResult& frame);
  /// One turn of a pause: peers hear that we are there, viewers may look around.
  void stand_still();
  void note_status(const FrameResult& frame);
  [[nodiscard]] std::uint64_t unsent() const;
  void note_gauges();
  void note_vtk();
  /// What a frame cost; more gives way, or less.
  void note_load(double seconds, double spent);
  /// `write` puts something into a file. If it cannot: whoever plays in real time goes on without
  /// the file, `forget` it; else the run ends.
  void keep_going(const std::function<void()>& write, const std::function<void()>& forget);
  void print_progress();
  [[nodiscard]] bool is_over() const;
  /// Why another scene cannot be gone over to; empty: it is.
  [[nodiscard]] std::string go_over_to(const std::string& scene);

  Options options_;
  Simulation& simulation_;
  std::string device_;
  Targets targets_;
  protocol::UdpSocket socket_;
  std::optional<protocol::LogWriter> log_;
  std::optional<GaugeFile> gauges_;
  std::optional<VtkFiles> vtk_;
  std::optional<Show> show_;
  EventSender sender_;
  ForceSender forces_;
  Pacer pacer_;
  Overload overload_;
  double next_gauges_ = 0.0;  ///< simulated time before which they are not read [s]
  TargetStatus target_status_;
  EventIds ids_;
  LiveRows rows_;
  std::atomic<bool> quit_ = false;
  std::atomic<bool> paused_ = false;
  std::atomic<bool> begins_anew_ = false;
  PoseIntake poses_;
  RecentPace pace_;       ///< for /status
  RecentPace line_pace_;  ///< for the lines on the state
  mutable std::mutex status_mutex_;
  protocol::SimStatus status_;
  std::filesystem::path next_scene_;  ///< under status_mutex_
  std::uint64_t turns_seen_ = 0;
  std::string unwritten_;      ///< why a file ends early; empty: none does
  double started_ = 0.0;       ///< monotonic [s]
  double wall_seconds_ = 0.0;  ///< of run()
  double next_line_ = 0.0;     ///< monotonic [s]
  double next_fault_ = 0.0;    ///< monotonic [s]
  int unsaid_ = 0;             ///< faults since the last line on one
  ClockAnswers clock_answers_;
  ControlServer control_;  ///< last: its thread uses all of the above
};

}  // namespace splash::sim
