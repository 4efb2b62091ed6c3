// SPDX-License-Identifier: MIT
#include "sim-server/device/device_choice.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <utility>

#include "program/text.hpp"
#include "sim-server/device/device_error.hpp"

namespace splash::sim {
namespace {

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_meant(const DeviceFacts& device, const std::string& wish) {
  if (wish.empty()) return true;
  if (is_number(wish)) return std::to_string(device.index) == wish;
  if (wish == "cpu") return device.kind == DeviceKind::cpu;
  if (wish == "gpu") return device.kind == DeviceKind::gpu;
  return program::lower(device.name).find(wish) != std::string::npos;
}

bool comes_first(const DeviceFacts& a, const DeviceFacts& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.compute_units > b.compute_units;
}

std::string milliseconds(double seconds) {
  return program::format("%.2f ms", 1e3 * seconds);
}

/// Devices of a kind that are left, and what their tests said.
struct Tested {
  DeviceFacts device;
  Trial trial;
};

class Chooser {
 public:
  Chooser(const std::vector<DeviceFacts>& meant, bool asked,
          const std::function<Trial(const DeviceFacts&)>& test)
      : left_(meant), asked_(asked), test_(test) {}

  Choice choose() {
    while (left_.size() > 1) {
      const bool race = left_[0].kind == DeviceKind::gpu && left_[1].kind == DeviceKind::gpu;
      if (const auto found = race ? fastest_gpu() : first()) return *found;
    }
    return taken(left_.front(), reason_for_last());
  }

 private:
  /// The next one, if it stands its test.
  std::optional<Choice> first() {
    const DeviceFacts device = left_.front();
    if (!stands(device)) return std::nullopt;
    return taken(device, asked_ ? "asked for" : why(device));
  }

  std::optional<Choice> fastest_gpu() {
    std::vector<Tested> sound;
    while (!left_.empty() && left_.front().kind == DeviceKind::gpu) {
      // The last device of all may be one of them: it has to race, too.
      const DeviceFacts device = left_.front();
      const bool last = left_.size() == 1 && sound.empty();
      if (last) return std::nullopt;
      if (const auto trial = stands(device)) sound.push_back({device, *trial});
    }
    if (sound.empty()) return std::nullopt;
    const auto best = std::min_element(
        sound.begin(), sound.end(),
        [](const Tested& a, const Tested& b) { return a.trial.step < b.trial.step; });
    std::string reason =
        "the fastest GPU, " + milliseconds(best->trial.step) + " for a test's step";
    for (const Tested& other : sound) {
      if (other.device.index == best->device.index) continue;
      reason += ", device " + std::to_string(other.device.index) + " takes " +
                milliseconds(other.trial.step);
    }
    if (sound.size() == 1) reason = why(best->device);
    return taken(best->device, reason);
  }

  /// Tests it and takes it off the list.
  std::optional<Trial> stands(const DeviceFacts& device) {
    left_.erase(left_.begin());
    const Trial trial = test_(device);
    if (trial.failure.empty()) return trial;
    passed_over_.push_back(std::to_string(device.index) + ": " + device.name +
                           " is passed over: " + trial.failure);
    return std::nullopt;
  }

  [[nodiscard]] static std::string why(const DeviceFacts& device) {
    if (device.kind == DeviceKind::gpu) return "a GPU comes before others";
    if (device.kind == DeviceKind::accelerator) return "there is no GPU that can be used";
    return "there is no GPU that can be used, and this is the CPU device with most units";
  }
  [[nodiscard]] std::string reason_for_last() const {
    if (asked_ && passed_over_.empty()) return "asked for";
    return passed_over_.empty() ? "the only device" : "no other is left";
  }
  [[nodiscard]] Choice taken(const DeviceFacts& device, std::string reason) const {
    return {device, std::move(reason), passed_over_};
  }

  std::vector<DeviceFacts> left_;
  bool asked_;
  const std::function<Trial(const DeviceFacts&)>& test_;
  std::vector<std::string> passed_over_;
};

}  // namespace

std::vector<DeviceFacts> meant_devices(const std::vector<DeviceFacts>& all,
                                       const std::string& wish) {
  std::vector<DeviceFacts> meant;
  const std::string wanted = program::lower(wish);
  std::copy_if(all.begin(), all.end(), std::back_inserter(meant),
               [&](const DeviceFacts& device) { return is_meant(device, wanted); });
  if (meant.empty()) {
    std::string text = "--device " + wish + ": there is no such OpenCL device; ";
    text += all.size() == 1 ? "there is only " : "there are ";
    for (const DeviceFacts& device : all) {
      text += (device.index == all.front().index ? "" : "; ") + describe(device);
    }
    throw DeviceError(text + " (one is chosen by its number, a part of its name, gpu or cpu)");
  }
  std::stable_sort(meant.begin(), meant.end(), comes_first);
  return meant;
}

Choice choose_device(const std::vector<DeviceFacts>& meant, bool asked,
                     const std::function<Trial(const DeviceFacts&)>& test) {
  return Chooser(meant, asked, test).choose();
}

}  // namespace splash::sim
