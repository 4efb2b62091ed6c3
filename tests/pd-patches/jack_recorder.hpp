// SPDX-License-Identifier: MIT
// A JACK client that keeps all that arrives at its inputs, and when each period was computed.
#pragma once

#include <jack/jack.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/pd-patches/rendering.hpp"

namespace splash::pd {

class JackRecorder {
 public:
  /// Joins `server`; records up to `seconds` on `channels` inputs. Throws std::runtime_error.
  JackRecorder(const std::string& server, int channels, double seconds);
  ~JackRecorder();
  JackRecorder(const JackRecorder&) = delete;
  JackRecorder& operator=(const JackRecorder&) = delete;

  /// Connects `prefix`1, `prefix`2, ... to the inputs; false while one of them is missing.
  [[nodiscard]] bool connect(const std::string& prefix);
  /// Samples so far; once it has been called recording is over.
  [[nodiscard]] Channels stop();
  /// Monotonic time of a recorded sample [s]: callbacks are late, never early, so the earliest of
  /// the half second around it counts.
  [[nodiscard]] double time_of(std::int64_t frame) const;
  /// The latest that a callback between two samples was [s].
  [[nodiscard]] double lateness(std::int64_t from, std::int64_t to) const;
  [[nodiscard]] double rate() const noexcept { return rate_; }  ///< [Hz]
  [[nodiscard]] bool server_is_gone() const noexcept { return gone_; }

 private:
  struct Period {
    std::int64_t first = 0;  ///< sample
    double time = 0.0;       ///< when its callback ran [s, monotonic]
  };
  static int process(jack_nframes_t frames, void* self);
  void keep(jack_nframes_t frames);

  jack_client_t* client_ = nullptr;
  double rate_ = 0.0;
  std::vector<jack_port_t*> ports_;
  Channels samples_;
  std::vector<Period> periods_;
  std::size_t period_count_ = 0;
  std::atomic<std::int64_t> recorded_{0};
  std::atomic<bool> gone_{false};
};

}  // namespace splash::pd
