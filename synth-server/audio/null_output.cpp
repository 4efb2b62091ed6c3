// SPDX-License-Identifier: MIT
#include "synth-server/audio/null_output.hpp"

// NOLINTNEXTLINE(modernize-deprecated-headers): clock_nanosleep is POSIX, not in <ctime>
#include <time.h>

#include <cmath>
#include <stdexcept>

#include "protocol/time_tag.hpp"

namespace splash::synth {
namespace {

/// A backlog longer than this is given up [s].
constexpr double kLongestBacklog = 1.0;

void sleep_until(double moment) noexcept {
  timespec time{};
  const double seconds = std::floor(moment);
  time.tv_sec = static_cast<time_t>(seconds);
  time.tv_nsec = static_cast<long>((moment - seconds) * 1e9);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

int positive(const char* name, int value) {
  if (value > 0) return value;
  throw std::invalid_argument(std::string("null output: ") + name + " " + std::to_string(value) +
                              " is not positive");
}

}  // namespace

NullOutput::NullOutput(int channels, int sample_rate, int block)
    : format_{"null", "null", positive("channels", channels), positive("sample rate", sample_rate),
              positive("block", block)},
      samples_(static_cast<std::size_t>(channels) * static_cast<std::size_t>(block)) {
  for (int c = 0; c < channels; ++c) {
    channels_.push_back(samples_.data() + static_cast<std::ptrdiff_t>(c) * block);
  }
}

NullOutput::~NullOutput() {
  stop();
}

void NullOutput::start(BlockSource& source) {
  stop();
  stopping_ = false;
  thread_ = std::thread([this, &source] { run(source); });
}

void NullOutput::stop() noexcept {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void NullOutput::run(BlockSource& source) {
  double origin = protocol::monotonic_now();
  std::uint64_t done = 0;  // frames since the origin
  bool xrun = false;
  bool restart = true;
  while (!stopping_) {
    const double due = origin + static_cast<double>(done) / format_.sample_rate;
    sleep_until(due);
    if (protocol::monotonic_now() - due > kLongestBacklog) {
      origin = protocol::monotonic_now();
      done = 0;
      xrun = true;
      continue;
    }
    source.render({channels_.data(), format_.block, due, xrun, restart});
    xrun = false;
    restart = false;
    done += static_cast<std::uint64_t>(format_.block);
    frames_ += static_cast<std::uint64_t>(format_.block);
  }
}

}  // namespace splash::synth
