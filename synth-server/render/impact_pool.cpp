// SPDX-License-Identifier: MIT
#include "synth-server/render/impact_pool.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splash::synth {
namespace {

/// As many again for those that fade.
std::size_t places_for(int max_voices) {
  return 2 * static_cast<std::size_t>(max_voices) + 16;
}

}  // namespace

ImpactPool::ImpactPool(int max_voices, int max_routes, double sample_rate)
    : max_voices_(static_cast<std::size_t>(max_voices)),
      max_routes_(static_cast<std::size_t>(max_routes)),
      fade_length_(std::llround(kVoiceFade * sample_rate)),
      seats_(places_for(max_voices)),
      routes_(seats_.size() * max_routes_),
      ranking_(seats_.size(), sample_rate) {
  order_.reserve(seats_.size());
  for (std::size_t place = seats_.size(); place-- > 0;) {
    free_.push_back(static_cast<std::uint32_t>(place));
  }
}

void ImpactPool::fade_out(std::uint32_t place, std::int64_t sample) noexcept {
  seats_[place].span.fade_out(sample, fade_length_);
  ranking_.end_at(place, sample);
  --lasting_;
}

ImpactPool::Start ImpactPool::start(const ImpactVoice& voice, const VoiceLife& life,
                                    std::span<const Route> routes, std::int64_t sample) noexcept {
  if (free_.empty()) return Start::refused;
  Start result = Start::started;
  const std::uint32_t quietest =
      lasting_ < max_voices_ ? Ranking::kNone : ranking_.quietest(sample);
  if (quietest != Ranking::kNone) {
    if (ranking_.level(quietest, sample) >= life.log_amplitude) return Start::refused;
    fade_out(quietest, sample);
    result = Start::stole;
  }
  const std::uint32_t place = free_.back();
  free_.pop_back();
  order_.push_back(place);
  const std::int64_t end = sample + life.length;
  seats_[place] = {voice, {sample, end}, routes.size()};
  ranking_.enter(place, life, sample, end);
  std::copy(routes.begin(), routes.end(),
            routes_.begin() + static_cast<std::ptrdiff_t>(place * max_routes_));
  ++lasting_;
  return result;
}

void ImpactPool::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  const CellGain gain = mix.gains.of<protocol::Impact>();
  std::array<double, kCell> sound{};
  for (const std::uint32_t place : order_) {
    Seat& seat = seats_[place];
    const std::int64_t begin = std::max(from, seat.span.start);
    const std::int64_t end = std::min(to, seat.span.end);
    if (begin >= end) continue;
    const auto count = static_cast<int>(end - begin);
    seat.voice.render(sound.data(), count);
    if (seat.span.fade < end) seat.span.shape(begin, count, sound.data());
    const auto first = static_cast<int>(begin % kCell);
    for (int n = 0; n < count && !gain.is_one(); ++n) {
      sound[static_cast<std::size_t>(n)] *= gain.at(first + n);
    }
    const auto offset = static_cast<std::size_t>(first);
    for (std::size_t r = 0; r < seat.routes; ++r) {
      const Route& route = routes_[place * max_routes_ + r];
      const auto channel = static_cast<std::size_t>(route.channel);
      double* const out = mix.samples.data() + channel * kCell + offset;
      for (int n = 0; n < count; ++n) out[n] += route.gain * sound[static_cast<std::size_t>(n)];
      mix.touched[channel] = 1;
    }
  }
}

void ImpactPool::release(std::int64_t sample) noexcept {
  const auto over = [&](std::uint32_t place) {
    const VoiceSpan& span = seats_[place].span;
    if (span.end > sample) return false;
    if (span.fade == VoiceSpan::kNever) --lasting_;
    free_.push_back(place);
    return true;
  };
  std::erase_if(order_, over);  // keeps the order, and calls `over` once for each
}

void ImpactPool::fade_all(std::int64_t sample) noexcept {
  for (const std::uint32_t place : order_) {
    const VoiceSpan& span = seats_[place].span;
    if (span.fade == VoiceSpan::kNever && span.end > sample) fade_out(place, sample);
  }
}

}  // namespace splash::synth
