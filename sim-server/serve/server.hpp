// SPDX-License-Identifier: MIT
// The running simulator: it computes frames in step with the wall clock, sends their events, and
// takes poses and commands.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/event.hpp"
#include "sim-server/gauge/gauges.hpp"
#include "sim-server/listen/clock_answers.hpp"
#include "sim-server/listen/control.hpp"
#include "sim-server/options.hpp"
#include "sim-server/scene/live_rows.hpp"
#include "sim-server/send/event_sender.hpp"
#include "sim-server/send/force_sender.hpp"
#include "sim-server/send/target_status.hpp"
#include "sim-server/serve/overload.hpp"
#include "sim-server/serve/pacer.hpp"
#include "sim-server/serve/pose_intake.hpp"
#include "sim-server/serve/report.hpp"
#include "sim-server/serve/stopwatch.hpp"
#include "sim-server/show/show.hpp"
#include "sim-server/show/vtk_files.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {

/// The next id of each kind of event in a session.
using EventIds = protocol::ByKind<int>;

class Server {
 public:
  /// Opens sockets and files. Throws program::Failure.
  Server(const Options& options, Simulation& simulation, const std::string& device);

  /// Computes frame after frame until `ended` returns true, /quit comes or the duration is over.
  /// Prints a line on the state every two seconds.
  void run(const std::function<bool()>& ended);
  /// Begins new files for log and gauges if the old ones were moved away (log rotation). To be
  /// called between two frames.
  void reopen();
  /// Closes the log and asks the targets for their counts of late and lost events.
  [[nodiscard]] RunReport finish();
  /// Writes the report's file, if the options name one. Throws program::Failure when it, or a file
  /// earlier in the run, could not be written.
  void leave(const RunReport& report) const;

  /// True if the control thread has made progress since the last call.
  [[nodiscard]] bool listens();
  /// Whether neither a target nor a file was named.
  [[nodiscard]] bool is_unheard() const noexcept {
    return options_.targets.empty() && options_.record.empty();
  }
  /// The endpoint that viewers connect to; empty: there is none.
  [[nodiscard]] std::optional<protocol::Endpoint> shown_at() const {
    return show_ ? std::optional(show_->local()) : std::nullopt;
  }
  /// The scene to go over to, once run() is over; empty: the program ends.
  [[nodiscard]] std::filesystem::path next_scene() const;
  /// The endpoint of the control port.
  [[nodiscard]] protocol::Endpoint local() const noexcept { return control_.local(); }

 private:
  /// The actions of the control port's commands.
  [[nodiscard]] ControlActions actions();
  /// Prints a fault to stderr, once a second at most.
  void report(const StepFault& step_fault);
  void send(const FrameResult& frame);
  void send_forces(const FrameResult& frame);
  /// Applies the rows that were set since the last frame, and tells them to subscribers.
  void take_rows();
  void show(const FrameResult& frame);
  /// One iteration of a pause: heartbeats go on, and viewers are sent frames.
  void pause_step();
  void note_status(const FrameResult& frame);
  [[nodiscard]] std::uint64_t unsent() const;
  void note_gauges();
  void note_vtk();
  /// Takes note of what a frame of `seconds` cost, and changes the level of overload.
  void note_load(double seconds, double spent);
  /// Runs `write`, which writes to a file. When the file cannot be written (program::WriteError), a
  /// run in real time calls `forget` and goes on without the file; any other run ends.
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
  std::atomic<bool> restarts_ = false;
  PoseIntake poses_;
  RecentPace pace_;       ///< for /status
  RecentPace line_pace_;  ///< for the lines on the state
  mutable std::mutex status_mutex_;
  protocol::SimStatus status_;
  std::filesystem::path next_scene_;  ///< under status_mutex_
  std::uint64_t turns_seen_ = 0;
  std::string unwritten_;    ///< the reason why a file ends early; empty: none does
  double started_ = 0.0;     ///< monotonic [s]
  Cost run_cost_;            ///< of run()
  double next_line_ = 0.0;   ///< monotonic [s]
  double next_fault_ = 0.0;  ///< monotonic [s]
  int unreported_ = 0;       ///< faults since the last line on one
  ClockAnswers clock_answers_;
  ControlServer control_;  ///< last: its thread uses all of the above
};

}  // namespace splash::sim
