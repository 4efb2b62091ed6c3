// SPDX-License-Identifier: MIT
#include "synth-server/audio/device_watch.hpp"

#include <exception>
#include <utility>

#include "synth-server/audio/device_choice.hpp"
#include "synth-server/audio/null_output.hpp"

namespace splash::synth {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

/// RtAudio calls back in a loop without pause when an ALSA card is unplugged or a PulseAudio server
/// is killed: a device that asks for so many times its rate is none.
constexpr double kRacing = 4.0;
constexpr milliseconds kRacingSpan{1000};
/// A device with long blocks is given at least so many of them.
constexpr int kBlocksToWait = 8;

std::string title(const AudioFormat& format) {
  return format.api + " device '" + format.device + "'";
}

}  // namespace

DeviceWatch::DeviceWatch(BlockSource& source, std::unique_ptr<AudioOutput> output,
                         std::string missing, Open open, Report report, Adapt adapt,
                         WatchSettings settings)
    : source_(&source),
      open_(std::move(open)),
      report_(std::move(report)),
      adapt_(std::move(adapt)),
      settings_(settings),
      needed_(output->format()),
      output_(std::move(output)),
      standing_in_(!missing.empty()),
      last_refusal_(std::move(missing)) {
  output_->start(*source_);
  restart_progress();
  next_try_ = Clock::now() + settings_.retry;
  if (open_) thread_ = std::thread([this] { run(); });
}

DeviceWatch::~DeviceWatch() {
  {
    const std::lock_guard lock(sleep_mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  output_->stop();
}

void DeviceWatch::run() {
  std::unique_lock lock(sleep_mutex_);
  while (!wake_.wait_for(lock, settings_.look, [this] { return stopping_; })) {
    lock.unlock();
    look();
    lock.lock();
  }
}

void DeviceWatch::look() {
  const auto now = Clock::now();
  if (standing_in_) {
    if (now >= next_try_) try_device();
    return;
  }
  const std::string why = fault(now);
  if (!why.empty()) stand_in(why);
}

std::string DeviceWatch::fault(Clock::time_point now) {
  const AudioFormat& format = output_->format();
  const std::uint64_t frames = output_->frames();
  if (frames != progress_.frames) {
    progress_.frames = frames;
    progress_.moved = now;
  }
  const duration<double> blocks(static_cast<double>(kBlocksToWait * format.block) /
                                format.sample_rate);
  if (now - progress_.moved > settings_.limits && now - progress_.moved > blocks) {
    return "has stopped asking for sound" +
           std::string(format.api == "jack"    ? " (has the JACK server ended?)"
                       : format.api == "pulse" ? " (has its server ended?)"
                                               : " (is it still plugged in?)");
  }
  if (now - progress_.span_start < kRacingSpan) return {};
  const double asked = static_cast<double>(frames - progress_.span_frames);
  const double due = duration<double>(now - progress_.span_start).count() * format.sample_rate;
  progress_.span_frames = frames;
  progress_.span_start = now;
  return asked > kRacing * due ? "asks for sound faster than it could play it" : std::string();
}

void DeviceWatch::stand_in(const std::string& why) {
  ++losses_;
  report_(title(output_->format()) + ' ' + why +
          ": nothing is heard until it is back; going on without it");
  const int block = output_->format().block;
  exchange(std::make_unique<NullOutput>(needed_.channels, needed_.sample_rate, block));
  standing_in_ = true;
  last_refusal_.clear();
  next_try_ = Clock::now() + settings_.retry;
}

void DeviceWatch::try_device() {
  next_try_ = Clock::now() + settings_.retry;
  try {
    auto device = open_();
    if (device->format().sample_rate != needed_.sample_rate && !adapt_) {
      throw DeviceError(title(device->format()) + " now runs at " +
                        std::to_string(device->format().sample_rate) + " Hz, not at " +
                        std::to_string(needed_.sample_rate) + " Hz: restart synth-server");
    }
    exchange(std::move(device));
    standing_in_ = false;
    report_(title(output_->format()) + " plays, blocks of " +
            std::to_string(output_->format().block) + " at " +
            std::to_string(output_->format().sample_rate) + " Hz");
  } catch (const std::exception& error) {  // nothing may end this thread
    standing_in_ = true;
    if (output_ == nullptr) {
      exchange(std::make_unique<NullOutput>(needed_.channels, needed_.sample_rate, needed_.block));
    }
    if (last_refusal_ != error.what()) report_(std::string("no sound device yet: ") + error.what());
    last_refusal_ = error.what();
  }
}

void DeviceWatch::exchange(std::unique_ptr<AudioOutput> next) {
  if (output_ != nullptr) output_->stop();
  {
    const std::lock_guard lock(mutex_);
    output_.swap(next);
  }
  next.reset();  // the old one is closed before the new one starts: never two at once
  try {
    if (output_->format().sample_rate != needed_.sample_rate) {
      source_ = &adapt_(output_->format());
      needed_.sample_rate = output_->format().sample_rate;
    }
    output_->start(*source_);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    output_.reset();
    throw;
  }
  restart_progress();
}

void DeviceWatch::restart_progress() {
  const auto now = Clock::now();
  progress_ = {output_->frames(), now, output_->frames(), now};
}

AudioFormat DeviceWatch::format() const {
  const std::lock_guard lock(mutex_);
  return output_ != nullptr ? output_->format() : needed_;
}

std::string DeviceWatch::scheduling() const {
  const std::lock_guard lock(mutex_);
  return output_ != nullptr ? output_->scheduling() : std::string();
}

}  // namespace splash::synth
