// SPDX-License-Identifier: MIT
#include "synth-server/render/voice_pool.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splash::synth {

VoicePool::VoicePool(int max_voices, int max_routes, double sample_rate)
    : sample_rate_(sample_rate),
      max_voices_(static_cast<std::size_t>(max_voices)),
      max_routes_(static_cast<std::size_t>(max_routes)),
      fade_length_(std::llround(kFade * sample_rate)) {
  // Fading voices keep their places for 5 ms: room for half as many as may sound.
  const std::size_t places = max_voices_ + max_voices_ / 2 + 16;
  voices_.resize(places);
  loudness_.resize(places);
  routes_.resize(places * max_routes_);
  order_.reserve(places);
  free_.reserve(places);
  for (std::size_t place = places; place-- > 0;) free_.push_back(static_cast<std::uint32_t>(place));
}

void VoicePool::fade_out(std::uint32_t place, std::int64_t sample) noexcept {
  Voice& voice = voices_[place];
  voice.fade = std::min(voice.fade, sample);
  voice.end = std::min(voice.end, voice.fade + fade_length_);
  loudness_[place].until = static_cast<double>(std::min(voice.fade, voice.end));
}

VoicePool::Start VoicePool::make_room(double log_amplitude, std::int64_t sample) noexcept {
  if (order_.size() < max_voices_) return Start::started;
  // Some of these may be over or fading: only the others count.
  const auto now = static_cast<double>(sample);
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t quietest = 0;
  std::size_t sounding = 0;
  for (const std::uint32_t place : order_) {
    if (loudness_[place].until <= now) continue;
    ++sounding;
    const double level = loudness_[place].at(now);
    if (level >= least) continue;
    least = level;
    quietest = place;
  }
  if (sounding < max_voices_) return Start::started;
  if (least >= log_amplitude) return Start::refused;
  fade_out(quietest, sample);
  return Start::stole;
}

VoicePool::Start VoicePool::start(const Sound& sound, const VoiceLife& life,
                                  std::span<const Route> routes, std::int64_t sample) noexcept {
  const Start result = make_room(life.log_amplitude, sample);
  if (result == Start::refused) return result;
  const std::uint32_t place = free_.back();
  free_.pop_back();
  order_.push_back(place);
  const std::int64_t end = sample + life.length;
  voices_[place] = {sound, sample, end, kNever, static_cast<int>(routes.size())};
  const double decay = life.decay / sample_rate_;
  const double decay_start = static_cast<double>(sample) + life.hold * sample_rate_;
  loudness_[place] = {life.log_amplitude, decay, life.log_amplitude + decay * decay_start,
                      static_cast<double>(end)};
  if (life.fold < life.length) {
    fade_out(place, sample + std::max<std::int64_t>(0, life.fold - fade_length_));
    voices_[place].end = std::min(voices_[place].end, sample + life.fold);
  }
  std::copy(routes.begin(), routes.end(),
            routes_.begin() + static_cast<std::ptrdiff_t>(place * max_routes_));
  return result;
}

void VoicePool::apply_fade(const Voice& voice, std::int64_t from,
                           std::span<double> samples) const noexcept {
  const auto length = static_cast<double>(voice.end - voice.fade);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::int64_t into = from + static_cast<std::int64_t>(i) - voice.fade;
    if (into <= 0) continue;
    const double left = std::max(0.0, 1.0 - static_cast<double>(into) / length);
    samples[i] *= left * left * (3.0 - 2.0 * left);
  }
}

void VoicePool::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  alignas(64) std::array<double, kCell> sound{};
  for (const std::uint32_t place : order_) {
    Voice& voice = voices_[place];
    const std::int64_t begin = std::max(from, voice.start);
    const std::int64_t end = std::min(to, voice.end);
    if (begin >= end) continue;
    const auto count = static_cast<std::size_t>(end - begin);
    std::visit([&](auto& v) { v.render(sound.data(), static_cast<int>(count)); }, voice.sound);
    if (voice.fade < end) apply_fade(voice, begin, {sound.data(), count});
    const auto offset = static_cast<std::size_t>(begin % kCell);
    for (int r = 0; r < voice.routes; ++r) {
      const Route& route = routes_[place * max_routes_ + static_cast<std::size_t>(r)];
      const auto channel = static_cast<std::size_t>(route.channel);
      double* out = mix.samples.data() + channel * kCell + offset;
      for (std::size_t i = 0; i < count; ++i) out[i] += route.gain * sound[i];
      mix.touched[channel] = 1;
    }
  }
}

void VoicePool::release(std::int64_t sample) noexcept {
  const auto over = [&](std::uint32_t place) {
    if (voices_[place].end > sample) return false;
    free_.push_back(place);
    return true;
  };
  std::erase_if(order_, over);  // keeps the order, and calls `over` once for each
}

void VoicePool::fade_all(std::int64_t sample) noexcept {
  for (const std::uint32_t place : order_) {
    if (loudness_[place].until > static_cast<double>(sample)) fade_out(place, sample);
  }
}

}  // namespace splash::synth
