// SPDX-License-Identifier: MIT
// What a kernel finds in a frame, counted by atomics, which give no order: read back with one wait,
// and put in the order of the particles that it was found at.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"

namespace splash::sim {

/// `Found` has the `id` of a particle.
template <class Found>
class CountedList {
 public:
  CountedList(Device& device, std::size_t room)
      : count_(device, 1), list_(device, room), read_(room) {}

  [[nodiscard]] std::size_t room() const noexcept { return read_.size(); }
  /// For the kernel that fills it.
  [[nodiscard]] std::array<KernelArg, 3> args() const {
    return {{{"room", static_cast<int>(room())}, {"counts", count_}, {"out", list_}}};
  }
  /// Before that kernel.
  void enqueue_clear(Device& device) { count_.enqueue_clear(device); }
  /// After a frame's last kernel.
  void enqueue_read(Device& device) {
    count_.enqueue_read(device, found_);
    list_.enqueue_read(device, std::span(read_).first(std::min(kAtOnce, room())));
  }
  /// Instead of all that: nothing was looked for.
  void skip() noexcept { found_.front() = 0; }
  /// What was found, once the queue is finished.
  [[nodiscard]] std::vector<Found> read(Device& device) {
    const auto found = static_cast<std::size_t>(found_.front());
    if (found > kAtOnce) {
      list_.read(device, std::span(read_).subspan(kAtOnce, found - kAtOnce), kAtOnce);
    }
    std::vector<Found> all(read_.begin(), read_.begin() + static_cast<std::ptrdiff_t>(found));
    std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.id < b.id; });
    return all;
  }

 private:
  /// Read without asking how many there are: more in one frame are rare.
  static constexpr std::size_t kAtOnce = 128;

  Buffer<int> count_;
  Buffer<Found> list_;
  std::vector<int> found_ = {0};
  std::vector<Found> read_;
};

}  // namespace splash::sim
