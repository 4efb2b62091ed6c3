// SPDX-License-Identifier: MIT
// A typed array on the device.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/device/device_error.hpp"

namespace splash::sim {

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  /// `size` elements, all bytes zero. Throws DeviceError that names both sizes when the
  /// device cannot hold it.
  Buffer(Device& device, std::size_t size) : size_(size) {
    const std::size_t bytes = std::max<std::size_t>(size, 1) * sizeof(T);
    if (bytes > device.facts().allocation) {
      throw DeviceError("a buffer of " + std::to_string(bytes >> 20) +
                        " MiB is wanted, the device allows " +
                        std::to_string(device.facts().allocation >> 20) +
                        " MiB; lower the scene's particles or raise their spacing, or choose "
                        "another device (--list-devices)");
    }
    memory_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, bytes);
    device.queue().enqueueFillBuffer(memory_, cl_uchar{0}, 0, bytes);
  }
  Buffer(Device& device, std::span<const T> values) : Buffer(device, values.size()) {
    write(device, values);
  }

  /// These three wait until the copy is made. `first`: index of the first element written.
  void write(Device& device, std::span<const T> values, std::size_t first = 0) {
    if (values.empty()) return;
    device.queue().enqueueWriteBuffer(memory_, CL_TRUE, first * sizeof(T),
                                      values.size() * sizeof(T), values.data());
  }
  void read(Device& device, std::span<T> values, std::size_t first = 0) const {
    if (values.empty()) return;
    device.queue().enqueueReadBuffer(memory_, CL_TRUE, first * sizeof(T), values.size() * sizeof(T),
                                     values.data());
  }
  [[nodiscard]] std::vector<T> read(Device& device, std::size_t count) const {
    std::vector<T> values(count);
    read(device, std::span<T>(values));
    return values;
  }

  /// Without waiting: `values` must stay where they are until the queue is finished.
  void enqueue_write(Device& device, std::span<const T> values, std::size_t first = 0) {
    if (values.empty()) return;
    device.queue().enqueueWriteBuffer(memory_, CL_FALSE, first * sizeof(T),
                                      values.size() * sizeof(T), values.data());
  }
  void enqueue_read(Device& device, std::span<T> values, std::size_t first = 0) const {
    if (values.empty()) return;
    device.queue().enqueueReadBuffer(memory_, CL_FALSE, first * sizeof(T),
                                     values.size() * sizeof(T), values.data());
  }
  /// Sets all bytes of the first `count` elements to zero, without waiting.
  void enqueue_clear(Device& device, std::size_t count) {
    device.queue().enqueueFillBuffer(memory_, cl_uchar{0}, 0, count * sizeof(T));
  }
  void enqueue_clear(Device& device) { enqueue_clear(device, size_); }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// For kernel arguments.
  [[nodiscard]] const cl::Buffer& memory() const noexcept { return memory_; }

 private:
  std::size_t size_ = 0;
  cl::Buffer memory_;
};

}  // namespace splash::sim
