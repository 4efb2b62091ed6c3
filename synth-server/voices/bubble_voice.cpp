// SPDX-License-Identifier: MIT
#include "synth-server/voices/bubble_voice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splash::synth {

BubbleVoice::BubbleVoice(double radius, double epsilon, double sample_rate, Chirp chirp) noexcept {
  constexpr double kStride = static_cast<double>(kLanes);
  const double step = 1.0 / sample_rate;
  const double omega = 2.0 * std::numbers::pi * bubble_frequency(radius);
  const double c = bubble_chirp(radius, chirp);
  const double d = bubble_damping(radius);
  const double stride_decay = std::exp(-d * kStride * step);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double n = static_cast<double>(k);
    const double t = n * step;
    const double amplitude = epsilon * radius * std::exp(-d * t);
    const double phase = omega * (t + c * t * t);
    re_[k] = amplitude * std::cos(phase);
    im_[k] = amplitude * std::sin(phase);
    // phase(n + s) - phase(n) = omega (s T + c T^2 (2 s n + s^2)) for the stride s
    const double turn = omega * (kStride * step + c * step * step * kStride * (2.0 * n + kStride));
    turn_re_[k] = stride_decay * std::cos(turn);
    turn_im_[k] = stride_decay * std::sin(turn);
  }
  const double rise = omega * c * step * step * 2.0 * kStride * kStride;
  rise_re_ = std::cos(rise);
  rise_im_ = std::sin(rise);
}

inline void BubbleVoice::advance() noexcept {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double re = re_[k] * turn_re_[k] - im_[k] * turn_im_[k];
    im_[k] = re_[k] * turn_im_[k] + im_[k] * turn_re_[k];
    re_[k] = re;
    const double turn_re = turn_re_[k] * rise_re_ - turn_im_[k] * rise_im_;
    turn_im_[k] = turn_re_[k] * rise_im_ + turn_im_[k] * rise_re_;
    turn_re_[k] = turn_re;
  }
}

void BubbleVoice::render(double* out, int count) noexcept {
  double* const end = out + std::max(count, 0);
  while (out < end && next_ != 0) write_one(out++);
  BubbleVoice local = *this;  // what `out` may alias cannot stay in registers
  for (; end - out >= static_cast<std::ptrdiff_t>(kLanes); out += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) out[k] = local.im_[k];
    local.advance();
  }
  *this = local;
  while (out < end) write_one(out++);
}

void BubbleVoice::write_one(double* out) noexcept {
  *out = im_[next_++];
  if (next_ == kLanes) {
    advance();
    next_ = 0;
  }
}

VoiceLife bubble_life(double radius, double epsilon, double sample_rate, Chirp chirp,
                      double floor) noexcept {
  constexpr auto kNever = std::numeric_limits<std::int64_t>::max();
  VoiceLife life;
  life.log_amplitude = std::log(epsilon * radius);
  life.decay = bubble_damping(radius);
  const double seconds = (life.log_amplitude - std::log(floor)) / life.decay;
  life.length = seconds > 0.0 ? static_cast<std::int64_t>(std::ceil(seconds * sample_rate)) : 0;
  // f0 (1 + 2 c t) = sample_rate / 2
  const double octaves = 0.5 * sample_rate / bubble_frequency(radius) - 1.0;
  const double fold = octaves / (2.0 * bubble_chirp(radius, chirp)) * sample_rate;
  life.fold = fold < 1e15 ? static_cast<std::int64_t>(std::max(fold, 0.0)) : kNever;
  return life;
}

}  // namespace splash::synth
