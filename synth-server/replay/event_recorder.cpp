// SPDX-License-Identifier: MIT
#include "synth-server/replay/event_recorder.hpp"

#include <chrono>
#include <exception>

namespace splash::synth {
namespace {

constexpr auto kPause = std::chrono::milliseconds(20);
constexpr std::int32_t kWrap = 1 << 24;  // as all counters on the wire

}  // namespace

EventRecorder::EventRecorder(const std::filesystem::path& path, int sample_rate)
    : log_(path), sample_rate_(sample_rate), thread_([this] { run(); }) {}

EventRecorder::~EventRecorder() {
  finish();
}

void EventRecorder::started(const TimedEvent& event) noexcept {
  if (!queue_.push(event)) ++lost_;
}

void EventRecorder::pushed(const TimedPush& push) noexcept {
  if (!queue_.push(push)) ++lost_;
}

void EventRecorder::write(const TimedPush& push) {
  append(push.sample, {protocol::to_message(push.push)});
}

void EventRecorder::write(const TimedEvent& event) {
  protocol::Event told = event.event;
  std::visit([](auto& kind) { kind.offset_ms = 0.0F; }, told);
  std::vector<protocol::Message> messages;
  if (event.session != 0) {
    messages.push_back(protocol::to_message(protocol::Frame{event.session, sequence_, 0, 0.0F}));
    sequence_ = (sequence_ + 1) % kWrap;
  }
  messages.push_back(protocol::to_message(told));
  append(event.sample, messages);
}

void EventRecorder::append(std::int64_t sample, const std::vector<protocol::Message>& messages) {
  if (!error_.empty()) return;  // keep the queue empty
  try {
    log_.append(static_cast<double>(sample) / sample_rate_, messages);
  } catch (const std::exception& error) {
    error_ = error.what();
  }
}

void EventRecorder::run() {
  for (;;) {
    const bool last = finishing_;
    queue_.consume_all([this](const auto& started) {
      std::visit([this](const auto& kind) { write(kind); }, started);
    });
    if (last) return;
    std::this_thread::sleep_for(kPause);
  }
}

void EventRecorder::finish() {
  finishing_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace splash::synth
