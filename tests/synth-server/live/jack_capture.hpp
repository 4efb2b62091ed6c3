// SPDX-License-Identifier: MIT
// A JACK server without hardware, and a client that records what another client plays.
#pragma once

#include <jack/jack.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.hpp"

namespace splash::synth {

/// jackd with its dummy driver under a name of its own; JACK_DEFAULT_SERVER points to it, so that
/// programs started later find it. The server waits for its clients, as a sound card would not:
/// what they play is recorded whole on a busy machine, too.
class JackServer {
 public:
  /// Throws std::runtime_error saying what to install when jackd is missing or does not start.
  JackServer(const std::string& name, int channels, int period, int rate = 48000, int inputs = 0);
  ~JackServer();
  JackServer(const JackServer&) = delete;
  JackServer& operator=(const JackServer&) = delete;

  /// As a crash would.
  void kill();
  /// Changes the period of the running server, as `jack_bufsize` does [frames].
  static void set_period(int period);

 private:
  std::unique_ptr<tests::ChildProcess> jackd_;
};

/// Records ports "source:outport 0".. of another client from now on.
class JackCapture {
 public:
  /// Throws std::runtime_error when the ports are not there within some seconds.
  JackCapture(const std::string& source, int channels, double seconds);
  ~JackCapture();
  JackCapture(const JackCapture&) = delete;
  JackCapture& operator=(const JackCapture&) = delete;

  /// Waits until the buffers are full, or `seconds` have passed.
  bool wait(double seconds) const;
  /// Times the server was late: samples are missing then.
  [[nodiscard]] int xruns() const noexcept { return xruns_; }
  /// Whether two ports, of whomever, are connected.
  [[nodiscard]] bool connected(const std::string& from, const std::string& to) const;
  /// What was recorded so far. To be called after wait().
  [[nodiscard]] const std::vector<std::vector<float>>& channels() const noexcept {
    return samples_;
  }

 private:
  static int process(jack_nframes_t frames, void* self);
  static int note_xrun(void* self);

  jack_client_t* client_ = nullptr;
  std::vector<jack_port_t*> ports_;
  std::vector<std::vector<float>> samples_;
  std::size_t length_;
  std::atomic<std::size_t> filled_{0};
  std::atomic<int> xruns_{0};
};

}  // namespace splash::synth
