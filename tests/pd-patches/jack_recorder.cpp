// SPDX-License-Identifier: MIT
#include "tests/pd-patches/jack_recorder.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "protocol/time_tag.hpp"

namespace splash::pd {

JackRecorder::JackRecorder(const std::string& server, int channels, double seconds) {
  const auto options = static_cast<jack_options_t>(JackNoStartServer | JackServerName);
  client_ = jack_client_open("recorder", options, nullptr, server.c_str());
  if (client_ == nullptr) throw std::runtime_error("no JACK server '" + server + "'");
  rate_ = jack_get_sample_rate(client_);
  const auto capacity = static_cast<std::size_t>(seconds * rate_);
  samples_.assign(static_cast<std::size_t>(channels), std::vector<float>(capacity));
  periods_.resize(capacity / jack_get_buffer_size(client_) + 1);
  for (int c = 0; c < channels; ++c) {
    const std::string name = "in_" + std::to_string(c + 1);
    ports_.push_back(
        jack_port_register(client_, name.c_str(), JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
  }
  jack_set_process_callback(client_, &JackRecorder::process, this);
  jack_on_shutdown(
      client_, [](void* self) { static_cast<JackRecorder*>(self)->gone_ = true; }, this);
  if (jack_activate(client_) != 0) throw std::runtime_error("JACK refuses to activate a client");
}

JackRecorder::~JackRecorder() {
  jack_client_close(client_);
}

bool JackRecorder::connect(const std::string& prefix) {
  for (std::size_t c = 0; c < ports_.size(); ++c) {
    const std::string source = prefix + std::to_string(c + 1);
    if (jack_port_by_name(client_, source.c_str()) == nullptr) return false;
    if (jack_port_connected_to(ports_[c], source.c_str()) != 0) continue;
    if (jack_connect(client_, source.c_str(), jack_port_name(ports_[c])) != 0) return false;
  }
  return true;
}

int JackRecorder::process(jack_nframes_t frames, void* self) {
  static_cast<JackRecorder*>(self)->keep(frames);
  return 0;
}

void JackRecorder::keep(jack_nframes_t frames) {
  const std::int64_t first = recorded_.load(std::memory_order_relaxed);
  const auto begin = static_cast<std::size_t>(first);
  if (begin + frames > samples_.front().size() || period_count_ == periods_.size()) return;
  periods_[period_count_++] = {first, protocol::monotonic_now()};
  for (std::size_t c = 0; c < ports_.size(); ++c) {
    const auto* in = static_cast<const float*>(jack_port_get_buffer(ports_[c], frames));
    std::copy_n(in, frames, samples_[c].begin() + static_cast<std::ptrdiff_t>(begin));
  }
  recorded_.store(first + frames, std::memory_order_release);
}

Channels JackRecorder::stop() {
  jack_deactivate(client_);
  const auto frames = static_cast<std::size_t>(recorded_.load(std::memory_order_acquire));
  for (auto& channel : samples_) channel.resize(frames);
  return samples_;
}

double JackRecorder::time_of(std::int64_t frame) const {
  double start = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < period_count_; ++k) {
    const Period& period = periods_[k];
    if (std::abs(static_cast<double>(period.first - frame)) > 0.5 * rate_) continue;
    start = std::min(start, period.time - static_cast<double>(period.first) / rate_);
  }
  return start + static_cast<double>(frame) / rate_;
}

double JackRecorder::lateness(std::int64_t from, std::int64_t to) const {
  double latest = 0.0;
  for (std::size_t k = 0; k < period_count_; ++k) {
    const Period& period = periods_[k];
    if (period.first < from || period.first > to) continue;
    latest = std::max(latest, period.time - time_of(period.first));
  }
  return latest;
}

}  // namespace splash::pd
