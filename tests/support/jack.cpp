// SPDX-License-Identifier: MIT
#include "tests/support/jack.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "protocol/time_tag.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

void ignore(const char* /*text*/) {}

bool reachable() {
  jack_client_t* client = jack_client_open("splash-test-probe", JackNoStartServer, nullptr);
  if (client == nullptr) return false;
  jack_client_close(client);
  return true;
}

std::vector<std::string> command_of(const std::string& name, const JackServer::Settings& settings) {
  std::vector<std::string> command = {"jackd", settings.realtime ? "--realtime" : "--no-realtime"};
  if (settings.waits) command.emplace_back("-S");
  command.insert(command.end(),
                 {"-n", name, "-d", "dummy", "-C", std::to_string(settings.inputs), "-P",
                  std::to_string(settings.channels), "-r", std::to_string(settings.rate), "-p",
                  std::to_string(settings.period)});
  return command;
}

}  // namespace

JackServer::JackServer(const std::string& name, const Settings& settings) {
  const std::string unique = "splash-" + name + "-" + std::to_string(getpid());
  setenv("JACK_DEFAULT_SERVER", unique.c_str(), 1);
  setenv("JACK_NO_AUDIO_RESERVATION", "1", 1);
  setenv("JACK_NO_START_SERVER", "1", 1);
  jack_set_error_function(ignore);
  jack_set_info_function(ignore);
  constexpr int kCrashed = 128;  // it ended by a signal
  constexpr int kTries = 3;      // jackd 1.9.21 crashes now and then while it starts
  int status = kCrashed;
  for (int tries = 0; tries < kTries && status >= kCrashed; ++tries) {
    jackd_ = std::make_unique<ChildProcess>(command_of(unique, settings));
    if (eventually([this] { return !jackd_->running() || reachable(); }, 20.0, 0.02) &&
        jackd_->running()) {
      return;
    }
    status = jackd_->wait_for_end(1.0);
  }
  throw std::runtime_error("jackd did not start (status " + std::to_string(status) +
                           (status == 127 ? ": it is not installed, 'apt install jackd2'" : "") +
                           ")\n" + jackd_->output());
}

JackServer::~JackServer() {
  jackd_->signal(SIGTERM);
  (void)jackd_->wait_for_end(5.0);
}

void JackServer::kill() {
  jackd_->signal(SIGKILL);
  (void)jackd_->wait_for_end(5.0);
}

void JackServer::set_period(int period) {
  jack_client_t* client = jack_client_open("splash-test-period", JackNoStartServer, nullptr);
  if (client == nullptr) throw std::runtime_error("no JACK server to change");
  const int refused = jack_set_buffer_size(client, static_cast<jack_nframes_t>(period));
  jack_client_close(client);
  if (refused != 0) throw std::runtime_error("JACK keeps its period");
}

JackCapture::JackCapture(int channels, double seconds)
    : client_(jack_client_open("splash-capture", JackNoStartServer, nullptr)) {
  if (client_ == nullptr) throw std::runtime_error("no JACK server to record from");
  rate_ = jack_get_sample_rate(client_);
  length_ = static_cast<std::size_t>(seconds * rate_);
  samples_.assign(static_cast<std::size_t>(channels), std::vector<float>(length_));
  periods_.resize(length_ / jack_get_buffer_size(client_) + 1);
  for (int c = 0; c < channels; ++c) {
    ports_.push_back(jack_port_register(client_, ("in" + std::to_string(c)).c_str(),
                                        JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
  }
  jack_set_process_callback(client_, &JackCapture::process, this);
  jack_set_xrun_callback(client_, &JackCapture::note_xrun, this);
  jack_activate(client_);
}

JackCapture::JackCapture(const std::string& source, int channels, double seconds)
    : JackCapture(channels, seconds) {
  const std::string prefix = source + ":outport ";
  if (!eventually([&] { return connect(prefix, 0); }, 10.0, 0.02)) {
    throw std::runtime_error("JACK has not all of the ports '" + prefix + "0'...");
  }
}

JackCapture::~JackCapture() {
  jack_client_close(client_);
}

bool JackCapture::connect(const std::string& prefix, int first) {
  for (std::size_t c = 0; c < ports_.size(); ++c) {
    const std::string source = prefix + std::to_string(first + static_cast<int>(c));
    if (jack_port_by_name(client_, source.c_str()) == nullptr) return false;
    if (jack_port_connected_to(ports_[c], source.c_str()) != 0) continue;
    if (jack_connect(client_, source.c_str(), jack_port_name(ports_[c])) != 0) return false;
  }
  connected_ = true;
  return true;
}

int JackCapture::process(jack_nframes_t frames, void* self) {
  auto& capture = *static_cast<JackCapture*>(self);
  if (!capture.connected_) return 0;
  const std::size_t start = capture.filled_;
  const std::size_t count = std::min<std::size_t>(frames, capture.length_ - start);
  if (count > 0 && capture.period_count_ < capture.periods_.size()) {
    capture.periods_[capture.period_count_++] = {static_cast<std::int64_t>(start),
                                                 protocol::monotonic_now()};
  }
  for (std::size_t c = 0; c < capture.ports_.size(); ++c) {
    const auto* in = static_cast<const float*>(jack_port_get_buffer(capture.ports_[c], frames));
    std::copy_n(in, count, capture.samples_[c].begin() + static_cast<std::ptrdiff_t>(start));
  }
  capture.filled_ = start + count;
  return 0;
}

int JackCapture::note_xrun(void* self) {
  ++static_cast<JackCapture*>(self)->xruns_;
  return 0;
}

bool JackCapture::connected(const std::string& from, const std::string& to) const {
  const char** peers =
      jack_port_get_all_connections(client_, jack_port_by_name(client_, from.c_str()));
  bool found = false;
  for (const char** peer = peers; peer != nullptr && *peer != nullptr; ++peer) found |= to == *peer;
  jack_free(static_cast<void*>(peers));
  return found;
}

bool JackCapture::wait(double seconds) const {
  return eventually([this] { return filled_ == length_; }, seconds, 0.02);
}

const std::vector<std::vector<float>>& JackCapture::stop() {
  jack_deactivate(client_);
  for (auto& channel : samples_) channel.resize(filled_);
  return samples_;
}

double JackCapture::time_of(std::int64_t frame) const {
  double start = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < period_count_; ++k) {
    const Period& period = periods_[k];
    if (std::abs(static_cast<double>(period.first - frame)) > 0.5 * rate_) continue;
    start = std::min(start, period.time - static_cast<double>(period.first) / rate_);
  }
  return start + static_cast<double>(frame) / rate_;
}

double JackCapture::lateness(std::int64_t from, std::int64_t to) const {
  double latest = 0.0;
  for (std::size_t k = 0; k < period_count_; ++k) {
    const Period& period = periods_[k];
    if (period.first < from || period.first > to) continue;
    latest = std::max(latest, period.time - time_of(period.first));
  }
  return latest;
}

}  // namespace splash::tests
