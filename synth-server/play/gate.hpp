// SPDX-License-Identifier: MIT
// Off until it is started: the gate behind the engine opens within two seconds at the start, when
// a device came back and when it was muted; it closes in 20 ms. It only ever takes away.
#pragma once

#include <algorithm>

#include "synth-server/output/fade.hpp"

namespace splash::synth {

class Gate {
 public:
  /// `ramp`: of every opening [s]; 0: open from the first sample on. `sample_rate` [Hz].
  Gate(double ramp, double sample_rate, bool open) noexcept
      : ramp_(ramp),
        sample_rate_(sample_rate),
        open_(open),
        fade_(open ? ramp : std::max(ramp, Fade::kSeconds), sample_rate) {}

  void open(bool open) noexcept {
    if (open && !open_ && fade_.closed()) restart();
    open_ = open;
  }
  /// Closed at once, to open slowly: for a device that has heard nothing yet.
  void restart() noexcept { fade_ = Fade(ramp_, sample_rate_); }

  [[nodiscard]] bool is_open() const noexcept { return open_; }

  /// Multiplies channels[c][i] with the gate's gain.
  void process(float* const* channels, int count, int frames) noexcept {
    if (open_ && fade_.opened()) return;
    for (int i = 0; i < frames; ++i) {
      const auto gain = static_cast<float>(fade_.next(open_));
      for (int c = 0; c < count; ++c) channels[c][i] *= gain;
    }
  }

 private:
  double ramp_;
  double sample_rate_;
  bool open_;
  Fade fade_;
};

}  // namespace splash::synth
