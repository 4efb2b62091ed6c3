// SPDX-License-Identifier: MIT
// Bubbles that live close together move each other's water and sound lower than each would alone
// (K. Xue, R. M. Aronson, J.-H. Wang, T. R. Langlois, D. L. James 2023, "Improved Water Sound
// Synthesis using Coupled Bubbles"; their modes: M y'' + K y = 0, M_ij = (d_ij^2 / (r_i r_j) +
// 4)^(-1/2), M_ii = 1, K_ii = w_i^2). A new bubble's pitch follows at its birth from those around
// it,
//   f' = f / sqrt(1 + S / (1 + S / 5)),
//   S  = sum_j r_j min(1, (f_j / f)^2) / sqrt(d_j^2 + 4 r r_j):
// S is the water that the others add to the bubble's own when they follow it, the stiff ones
// wholly, soft ones by their pitch. It counts ever less: in a large crowd the others hold each
// other back, and a part of the bubble's power stays in modes near its own pitch. The 5 is ours:
// with it the power's mean frequency stays within a third of an octave of the modes'
// (cloud_test).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/event.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

/// The bubbles that were born last.
class Cloud {
 public:
  explicit Cloud(double sample_rate) noexcept : sample_rate_(sample_rate) {}

  /// Puts a bubble of `radius` [m] and `frequency` [Hz] among the others, which are not younger;
  /// returns its pitch there over its own [1]. Those born longer ago than the sound says are
  /// forgotten.
  double enter(const CloudSound& sound, const protocol::Vec3& place, double radius,
               double frequency, std::int64_t sample) noexcept;

  void clear() noexcept {
    radius_.fill(0.0F);
    count_ = 0;
  }

  /// Of more than so many at once only the youngest count.
  static constexpr std::size_t kMost = 512;

 private:
  using Column = std::array<float, kMost>;

  [[nodiscard]] std::size_t oldest() const noexcept { return (next_ + kMost - count_) % kMost; }

  double sample_rate_;
  std::size_t next_ = 0;    ///< where the next one goes: the oldest follow
  std::size_t count_ = 0;   ///< of them
  Column x_{}, y_{}, z_{};  ///< [m]
  Column radius_{};         ///< [m]; 0: the place is free
  Column square_{};         ///< of the frequency [Hz^2]
  std::array<std::int64_t, kMost> born_{};
};

/// f' / f of the sum S.
[[nodiscard]] double lowered(double sum) noexcept;

}  // namespace splash::synth
