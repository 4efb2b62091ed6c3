// SPDX-License-Identifier: MIT
#include "tests/synth-server/live/pulse_server.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace splash::synth {
namespace {

constexpr int kTimeout = 200;  ///< tenths of a second

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

PulseServer::PulseServer(int channels) : channels_(channels) {
  std::string name = (std::filesystem::temp_directory_path() / "splash-pulse-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
  folder_ = name;
  const std::string address = "unix:" + folder_ + "/native";
  setenv("HOME", folder_.c_str(), 1);
  setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
  setenv("PULSE_SERVER", address.c_str(), 1);
  std::ofstream(folder_ + "/.asoundrc")
      << "pcm.!default { type pulse server \"" << address
      << "\" }\nctl.!default { type pulse server \"" << address << "\" }\n";
  start();
}

PulseServer::~PulseServer() {
  server_.reset();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void PulseServer::start() {
  std::filesystem::remove(folder_ + "/native");
  server_ = std::make_unique<tests::ChildProcess>(std::vector<std::string>{
      "pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes",
      "--use-pid-file=no", "--realtime=no", "--high-priority=no", "-L",
      "module-native-protocol-unix auth-anonymous=1 socket=" + folder_ + "/native", "-L",
      "module-null-sink sink_name=tiles rate=48000 channels=" + std::to_string(channels_)});
  for (int tenths = 0; tenths < kTimeout && server_->running(); ++tenths) {
    tests::ChildProcess asked({"pactl", "info"});
    if (asked.wait_for_end(5.0) == 0) return;
    pause();
  }
  throw std::runtime_error(
      "pulseaudio did not start; is it installed ('apt install pulseaudio "
      "pulseaudio-utils')?\n" +
      server_->output());
}

void PulseServer::kill() {
  server_->signal(SIGKILL);
  (void)server_->wait_for_end(5.0);
}

PulseRecording::PulseRecording(const PulseServer& pulse)
    : width_(static_cast<std::size_t>(pulse.channels())),
      listener_({"parec", "--device=tiles.monitor", "--format=float32le", "--rate=48000",
                 "--latency-msec=20", "--channels=" + std::to_string(pulse.channels())}) {
  wait_for(1);
}

std::size_t PulseRecording::frames() const {
  return listener_.output().size() / (width_ * sizeof(float));
}

void PulseRecording::wait_for(std::size_t wanted) {
  for (int tenths = 0; tenths < kTimeout; ++tenths) {
    if (frames() >= wanted) return;
    pause();
  }
  throw std::runtime_error("parec heard " + std::to_string(frames()) + " frames of " +
                           std::to_string(wanted));
}

std::vector<std::vector<float>> PulseRecording::channels(std::size_t more) {
  wait_for(frames() + more);
  const std::string bytes = listener_.output();
  const std::size_t count = bytes.size() / (width_ * sizeof(float));
  std::vector<std::vector<float>> channels(width_, std::vector<float>(count));
  for (std::size_t i = 0; i < count * width_; ++i) {
    std::memcpy(&channels[i % width_][i / width_], bytes.data() + i * sizeof(float), sizeof(float));
  }
  return channels;
}

}  // namespace splash::synth
