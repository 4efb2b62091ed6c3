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

/// `Found` has the `id` of a particle; on the device the first entry's is the number of the others.
template <class Found>
class CountedList {
 public:
  CountedList(Device& device, std::size_t room)
      : room_(room), list_(device, 1 + room), read_(1 + room) {}

  [[nodiscard]] std::size_t room() const noexcept { return room_; }
  /// For the kernel that fills it.
  [[nodiscard]] std::array<KernelArg, 2> args() const {
    return {{{"room", static_cast<int>(room_)}, {"out", list_}}};
  }
  /// Before that kernel.
  void enqueue_clear(Device& device) { list_.enqueue_clear(device, 1); }
  /// After a frame's last kernel.
  void enqueue_read(Device& device) {
    list_.enqueue_read(device, std::span(read_).first(std::min(kAtOnce, read_.size())));
  }
  /// Instead of all that: nothing was looked for.
  void skip() noexcept { read_.front().id = 0; }
  /// What was found, once the queue is finished.
  [[nodiscard]] std::vector<Found> read(Device& device) {
    const std::size_t end = 1 + std::min(static_cast<std::size_t>(read_.front().id), room_);
    if (end > kAtOnce)
      list_.read(device, std::span(read_).subspan(kAtOnce, end - kAtOnce), kAtOnce);
    std::vector<Found> all(read_.begin() + 1, read_.begin() + static_cast<std::ptrdiff_t>(end));
    std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.id < b.id; });
    return all;
  }

 private:
  /// Read without asking how many there are: more in one frame are rare.
  static constexpr std::size_t kAtOnce = 128;

  std::size_t room_;
  Buffer<Found> list_;
  std::vector<Found> read_;
};

}  // namespace splash::sim
