// SPDX-License-Identifier: MIT
#include "synth-server/render/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <variant>

#include "synth-server/voices/place_pitch.hpp"

namespace splash::synth {
namespace {

/// A simulator that told a force tells the next one sooner, else it is gone [s].
constexpr double kTold = 0.3;

PoolSettings pool_settings(const Rig& rig, const EngineSettings& s, const Routing& routing) {
  return {s.instructions,   s.max_voices,       routing.max_routes(),
          routing.groups(), channel_count(rig), s.sample_rate};
}

}  // namespace

Ensemble::Ensemble(const Rig& rig, const EngineSettings& settings)
    : settings_(settings),
      routing_(rig, {settings.skip_out_of_band, settings.skip_unfelt}),
      routes_(static_cast<std::size_t>(routing_.max_routes())),
      bubbles_(pool_settings(rig, settings, routing_)),
      impact_level_(rig),
      impacts_(settings.max_impacts, routing_.max_routes(), settings.sample_rate),
      cloud_(settings.sample_rate),
      births_(settings.sample_rate),
      crowd_(rig, settings.sample_rate, settings.seed),
      fine_(rig, settings.sample_rate, settings.seed),
      underfoot_(rig, settings.sample_rate, settings.seed) {}

void Ensemble::follow(const LiveControls& controls) noexcept {
  settings_.sound = controls.sound();
  routing_.follow(controls);
}

void Ensemble::start(const TimedEvent& timed) noexcept {
  const Outcome outcome =
      std::visit([&](const auto& kind) { return start_kind(kind, timed); }, timed.event);
  if (outcome == Outcome::started) {
    counts_.started.of(timed.event).add();
    ++starts_;
  } else if (outcome == Outcome::crowded) {
    counts_.started.of(timed.event).add();
    counts_.crowded.add();
  } else if (outcome == Outcome::no_place) {
    counts_.pool.add();
    counts_.without_place.of(timed.event).add();
  }
}

void Ensemble::press(const Push& push, std::int64_t sample) noexcept {
  const auto body = static_cast<std::size_t>(push.body);
  if (body >= told_.size()) return;
  told_[body] = sample + std::llround(kTold * settings_.sample_rate);
  const Routing::Reach reach = routing_.route({push.position, push.body, 0.0}, routes_);
  underfoot_.press(settings_.sound.foot, static_cast<double>(push.rate), reached(reach));
}

template <class Event>
void Ensemble::tread(const Event& event, std::int64_t sample) noexcept {
  const FootSound& sound = settings_.sound.foot;
  if (sound.texture <= 0.0 && sound.wash <= 0.0) return;
  const auto body = static_cast<std::size_t>(event.body);  // -1 becomes none of them
  if (body < told_.size() && sample < told_[body]) return;
  const Routing::Reach reach = routing_.route({event.position, event.body, 0.0}, routes_);
  underfoot_.add(sound, force_rate(event), reached(reach));
}

Ensemble::Outcome Ensemble::start_kind(const protocol::Impact& impact,
                                       const TimedEvent& timed) noexcept {
  tread(impact, timed.sample);
  const ImpactSound& sound = settings_.sound.impact;
  const double speed =
      impact_speed(sound, static_cast<double>(impact.speed), static_cast<double>(impact.approach));
  const auto [amplitude, parts] = impact_level_.at(sound, speed);
  const Routing::Reach reach = routing_.route({impact.position, impact.body, 0.0, parts}, routes_);
  const double floor = reach.floor / gain_of(sound.gain_db);
  const VoiceLife life = impact_life(sound, amplitude, settings_.sample_rate, floor);
  if (reach.result != Routing::Result::heard || life.length <= 0) {
    counts_.unheard.add();
    return Outcome::left_out;
  }
  if (starts_ >= kMostStarts) return Outcome::no_place;
  const auto session = static_cast<std::uint64_t>(timed.session);
  const Noise noise(settings_.seed, session << 24U | static_cast<std::uint64_t>(impact.id));
  const ImpactVoice voice(sound, amplitude, noise, settings_.sample_rate);
  const ImpactPool::Start result = impacts_.start(voice, life, reached(reach), timed.sample);
  if (result == ImpactPool::Start::refused) return Outcome::no_place;
  if (result == ImpactPool::Start::stole) counts_.stolen.add();
  return Outcome::started;
}

Ensemble::Outcome Ensemble::start_tone(const BubbleTone& tone, const Routing::Reach& reach,
                                       const protocol::Cavity* cavity,
                                       std::int64_t sample) noexcept {
  const bool kept = cavity != nullptr;
  const ToneSound& sound = kept ? settings_.sound.cavity : settings_.sound.bubble;
  VoiceLife life = life_of(tone, settings_.sample_rate, reach.floor / gain_of(sound.gain_db));
  life.kept = kept;
  if (kept && cavity->life > 0.0F) {
    life.breaks = std::llround(static_cast<double>(cavity->life) * settings_.sample_rate);
  }
  if (reach.result == Routing::Result::out_of_band || life.fold <= 0) {
    counts_.band.add();
    return Outcome::left_out;
  }
  if (reach.result == Routing::Result::unheard || life.length <= 0) {
    counts_.unheard.add();
    return Outcome::left_out;
  }
  if (!kept && !births_.is_single(settings_.sound.cloud.singles, sample) &&
      crowd_.join(sound, tone, static_cast<double>(life.length) / settings_.sample_rate,
                  reached(reach))) {
    return Outcome::crowded;
  }
  if (starts_ >= (kept ? kMostStarts : kMostStarts - kKeptStarts)) return Outcome::no_place;
  const BubblePool::Start result = bubbles_.start(tone, life, reached(reach), reach.group, sample);
  if (result == BubblePool::Start::refused) return Outcome::no_place;
  if (result == BubblePool::Start::stole) counts_.stolen.add();
  return Outcome::started;
}

template <class BubbleOrCavity>
Ensemble::Outcome Ensemble::start_air(const BubbleOrCavity& event,
                                      const TimedEvent& timed) noexcept {
  tread(event, timed.sample);
  constexpr bool kIsCavity = std::is_same_v<BubbleOrCavity, protocol::Cavity>;
  const ToneSound& sound = kIsCavity ? settings_.sound.cavity : settings_.sound.bubble;
  const auto radius = static_cast<double>(event.radius);
  const auto epsilon = static_cast<double>(event.epsilon);
  const auto z = static_cast<double>(event.position.z);
  const double depth = settings_.water_level - z;
  const bool surface = settings_.water_level > kNoWaterLevel;
  BubbleTone tone = in_place(
      sound, bubble_tone(sound, radius, epsilon, std::max(0.0, depth)), radius,
      {surface ? depth : std::numeric_limits<double>::infinity(), z - settings_.floor_level});
  if constexpr (!kIsCavity) {
    tone.frequency *=
        cloud_.enter(settings_.sound.cloud, event.position, radius, tone.frequency, timed.sample);
  }
  const Routing::Reach reach =
      routing_.route({event.position, event.body, tone.frequency}, routes_);
  const protocol::Cavity* cavity = nullptr;
  if constexpr (kIsCavity) {
    cavity = &event;
  } else {
    fine_.add(settings_.sound, epsilon, reached(reach));
  }
  return start_tone(tone, reach, cavity, timed.sample);
}

Ensemble::Outcome Ensemble::start_kind(const protocol::Bubble& bubble,
                                       const TimedEvent& timed) noexcept {
  return start_air(bubble, timed);
}

Ensemble::Outcome Ensemble::start_kind(const protocol::Cavity& cavity,
                                       const TimedEvent& timed) noexcept {
  return start_air(cavity, timed);
}

void Ensemble::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  impacts_.mix(from, to, mix);
  bubbles_.mix(from, to, mix);
  crowd_.mix(from, to, mix);
  fine_.mix(from, to, mix);
  underfoot_.mix(from, to, mix);
}

void Ensemble::end_cell(std::int64_t sample) noexcept {
  impacts_.release(sample);
  bubbles_.release(sample);
  crowd_.end_cell();
  fine_.end_cell();
  underfoot_.end_cell();
  starts_ = 0;
}

void Ensemble::fade_all(std::int64_t sample) noexcept {
  impacts_.fade_all(sample);
  bubbles_.fade_all(sample);
  crowd_.clear();
  fine_.clear();
  underfoot_.clear();
}

}  // namespace splash::synth
