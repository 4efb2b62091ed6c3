// SPDX-License-Identifier: MIT
// A JACK server without hardware, and a client that records what another client plays.
#pragma once

#include <jack/jack.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"

namespace splash::tests {

/// jackd with its dummy driver; JACK_DEFAULT_SERVER points to it, so that programs started later
/// find it.
class JackServer {
 public:
  struct Settings {
    int channels = 2;
    int period = 1024;  ///< [frames]
    int rate = 48000;   ///< [Hz]
    int inputs = 0;
    /// It waits for its clients, as a sound card would not: what they play is recorded whole on a
    /// busy machine, too.
    bool waits = true;
    bool realtime = false;  ///< at real-time priority, which not everybody may ask for
  };
  /// The server's name is made of `name` and this process's number. Throws std::runtime_error
  /// saying what to install when jackd is missing or does not start.
  JackServer(const std::string& name, const Settings& settings);
  ~JackServer();
  JackServer(const JackServer&) = delete;
  JackServer& operator=(const JackServer&) = delete;

  /// As a crash would.
  void kill();
  /// Changes the period of the running server, as `jack_bufsize` does [frames].
  static void set_period(int period);
  /// What it has printed.
  [[nodiscard]] std::string output() const { return jackd_->output(); }

 private:
  std::unique_ptr<ChildProcess> jackd_;
};

/// Keeps all that other clients play into its inputs, and when each period was computed.
class JackCapture {
 public:
  /// Joins the server with `channels` inputs; records up to `seconds` once it is connected.
  JackCapture(int channels, double seconds);
  /// The same, of "source:outport 0".. from now on. Throws std::runtime_error when those ports are
  /// not there within some seconds.
  JackCapture(const std::string& source, int channels, double seconds);
  ~JackCapture();
  JackCapture(const JackCapture&) = delete;
  JackCapture& operator=(const JackCapture&) = delete;

  /// Connects the ports `prefix` + `first`, ... to the inputs; false while one of them is missing.
  [[nodiscard]] bool connect(const std::string& prefix, int first);
  /// Waits until the buffers are full, or `seconds` have passed.
  bool wait(double seconds) const;
  /// Ends the recording and leaves out what was not recorded.
  const std::vector<std::vector<float>>& stop();
  /// What was recorded. To be called after wait().
  [[nodiscard]] const std::vector<std::vector<float>>& channels() const noexcept {
    return samples_;
  }
  /// Times the server was late: samples are missing then.
  [[nodiscard]] int xruns() const noexcept { return xruns_; }
  /// Whether two ports, of whomever, are connected.
  [[nodiscard]] bool connected(const std::string& from, const std::string& to) const;
  /// Monotonic time of a recorded sample [s]: callbacks are late, never early, so the earliest of
  /// the half second around it counts.
  [[nodiscard]] double time_of(std::int64_t frame) const;
  /// The latest that a callback between two samples was [s].
  [[nodiscard]] double lateness(std::int64_t from, std::int64_t to) const;

 private:
  struct Period {
    std::int64_t first = 0;  ///< sample
    double time = 0.0;       ///< when its callback ran [s, monotonic]
  };
  static int process(jack_nframes_t frames, void* self);
  static int note_xrun(void* self);

  jack_client_t* client_ = nullptr;
  double rate_ = 0.0;  ///< [Hz]
  std::vector<jack_port_t*> ports_;
  std::vector<std::vector<float>> samples_;
  std::size_t length_ = 0;
  std::vector<Period> periods_;
  std::size_t period_count_ = 0;
  std::atomic<bool> connected_{false};
  std::atomic<std::size_t> filled_{0};
  std::atomic<int> xruns_{0};
};

}  // namespace splash::tests
