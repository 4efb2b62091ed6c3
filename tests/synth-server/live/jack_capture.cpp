// SPDX-License-Identifier: MIT
#include "tests/synth-server/live/jack_capture.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <thread>

namespace splash::synth {
namespace {

void ignore(const char* /*text*/) {}

bool wait_until(const std::function<bool()>& condition, double seconds) {
  const double limit = protocol::monotonic_now() + seconds;
  while (!condition()) {
    if (protocol::monotonic_now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

bool reachable() {
  jack_client_t* client = jack_client_open("splash-test-probe", JackNoStartServer, nullptr);
  if (client == nullptr) return false;
  jack_client_close(client);
  return true;
}

}  // namespace

JackServer::JackServer(const std::string& name, int channels, int period, int rate, int inputs) {
  setenv("JACK_DEFAULT_SERVER", name.c_str(), 1);
  setenv("JACK_NO_AUDIO_RESERVATION", "1", 1);
  setenv("JACK_NO_START_SERVER", "1", 1);
  jack_set_error_function(ignore);
  jack_set_info_function(ignore);
  constexpr int kCrashed = 128;  // it ended by a signal
  constexpr int kTries = 3;      // jackd 1.9.21 crashes now and then while it starts
  int status = kCrashed;
  for (int tries = 0; tries < kTries && status >= kCrashed; ++tries) {
    const std::vector<std::string> command = {"jackd",
                                              "--no-realtime",
                                              "-S",
                                              "-n",
                                              name,
                                              "-d",
                                              "dummy",
                                              "-C",
                                              std::to_string(inputs),
                                              "-P",
                                              std::to_string(channels),
                                              "-r",
                                              std::to_string(rate),
                                              "-p",
                                              std::to_string(period)};
    jackd_ = std::make_unique<tests::ChildProcess>(command);
    if (wait_until([this] { return !jackd_->running() || reachable(); }, 20.0) &&
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

JackCapture::JackCapture(const std::string& source, int channels, double seconds)
    : length_(static_cast<std::size_t>(seconds * 48000.0)) {
  client_ = jack_client_open("splash-capture", JackNoStartServer, nullptr);
  if (client_ == nullptr) throw std::runtime_error("no JACK server to record from");
  samples_.assign(static_cast<std::size_t>(channels), std::vector<float>(length_));
  for (int c = 0; c < channels; ++c) {
    ports_.push_back(jack_port_register(client_, ("in" + std::to_string(c)).c_str(),
                                        JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0));
  }
  jack_set_process_callback(client_, &JackCapture::process, this);
  jack_set_xrun_callback(client_, &JackCapture::note_xrun, this);
  const std::string first = source + ":outport " + std::to_string(channels - 1);
  const bool there =
      wait_until([&] { return jack_port_by_name(client_, first.c_str()) != nullptr; }, 10.0);
  jack_activate(client_);
  for (int c = 0; there && c < channels; ++c) {
    const std::string port = source + ":outport " + std::to_string(c);
    jack_connect(client_, port.c_str(), jack_port_name(ports_[static_cast<std::size_t>(c)]));
  }
  if (!there) {
    jack_client_close(client_);
    throw std::runtime_error("JACK has no port '" + first + "'");
  }
}

JackCapture::~JackCapture() {
  jack_client_close(client_);
}

int JackCapture::process(jack_nframes_t frames, void* self) {
  auto& capture = *static_cast<JackCapture*>(self);
  const std::size_t start = capture.filled_;
  const std::size_t count = std::min<std::size_t>(frames, capture.length_ - start);
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
  return wait_until([this] { return filled_ == length_; }, seconds);
}

}  // namespace splash::synth
