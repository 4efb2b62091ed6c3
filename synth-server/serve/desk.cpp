// SPDX-License-Identifier: MIT
#include "synth-server/serve/desk.hpp"

#include <algorithm>
#include <cmath>

#include "program/text.hpp"
#include "protocol/event.hpp"
#include "synth-server/output/rig_rows.hpp"
#include "synth-server/render/live_controls.hpp"
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

/// The rows of a sound, where they stand among its numbers. What can be nil or counts in decibels
/// moves as it is, all else in its logarithm.
void add_rows(const Sound& sound, std::vector<Knob>& knobs) {
  const auto* const first = reinterpret_cast<const double*>(&sound);
  each_part(sound, [&](const std::string& name, const auto& part) {
    for (const auto& field : fields_of(part, name)) {
      const program::Row& row = field.row;
      knobs[static_cast<std::size_t>(&number_of(part, field) - first)] = {
          name + '/' + row.key, row.min, row.max, row.min > 0.0 && row.unit != "dB", row.unit,
          row.meaning};
    }
  });
}

const program::Row& row_of(const std::vector<Field<OutputEntry>>& rows, const char* key) {
  return std::find_if(rows.begin(), rows.end(),
                      [&](const auto& field) { return field.row.key == key; })
      ->row;
}

constexpr const char* kMuteKey = "mute";
constexpr const char* kSoloKey = "solo";

Knob switch_called(const std::string& of, const std::string& key) {
  const char* meaning = key == kMuteKey ? "1: silent" : "1: heard, and all its like without it not";
  return {of + '/' + key, 0.0, 1.0, false, "1", meaning};
}

std::vector<Knob> knobs_of(const Rig& rig) {
  const auto channels = static_cast<std::size_t>(channel_count(rig));
  const ControlLayout layout{rig.outputs.size(), channels};
  std::vector<Knob> knobs(layout.count());
  add_rows(Sound{}, knobs);
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    const std::string component = protocol::kKindNames[k].name();
    knobs[ControlLayout::mute(k)] = switch_called(component, kMuteKey);
    knobs[ControlLayout::solo(k)] = switch_called(component, kSoloKey);
  }
  const auto rows = output_fields();
  const program::Row& gain = row_of(rows, "gain_db");
  const program::Row& trim = row_of(rows, "trims_db");
  const program::Row& ceiling = row_of(rows, "ceiling");
  for (std::size_t o = 0; o < rig.outputs.size(); ++o) {
    const std::string name = "rig/" + rig.outputs[o].name;
    const auto at = [&](ControlLayout::OutputNumber number) -> Knob& {
      return knobs[ControlLayout::of_output(o, number)];
    };
    at(ControlLayout::gain_db) = {name + "/gain_db", gain.min,    gain.max, false,
                                  gain.unit,         gain.meaning};
    at(ControlLayout::ceiling) = {name + "/ceiling", ceiling.min,    rig.outputs[o].ceiling, true,
                                  ceiling.unit,      ceiling.meaning};
    at(ControlLayout::output_mute) = switch_called(name, kMuteKey);
    at(ControlLayout::output_solo) = switch_called(name, kSoloKey);
  }
  const std::vector<std::string> names = channel_names(rig);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::string name = "rig/" + names[c];
    const auto at = [&](ControlLayout::ChannelNumber number) -> Knob& {
      return knobs[layout.of_channel(c, number)];
    };
    at(ControlLayout::trim_db) = {name + "/trim_db",
                                  trim.min,
                                  trim.max,
                                  false,
                                  "dB",
                                  "of this channel, on top of its output's gain"};
    at(ControlLayout::channel_mute) = switch_called(name, kMuteKey);
    at(ControlLayout::channel_solo) = switch_called(name, kSoloKey);
  }
  return knobs;
}

std::vector<char> logarithmic(const std::vector<Knob>& knobs) {
  std::vector<char> all;
  for (const Knob& knob : knobs) all.push_back(knob.logarithmic ? 1 : 0);
  return all;
}

ControlTargets targets_of(const Rig& rig, const Sound& sound) {
  ControlTargets targets{control_values(rig, sound), {}};
  targets.seconds.assign(targets.values.size(), static_cast<float>(Desk::kSeconds));
  return targets;
}

std::string number(double value) {
  return program::format("%g", value);
}

}  // namespace

Desk::Desk(const Rig& rig, const Sound& sound)
    : knobs_(knobs_of(rig)),
      targets_(targets_of(rig, sound)),
      changed_(knobs_.size(), 0),
      box_(targets_, logarithmic(knobs_)) {}

const Knob* Desk::find(const std::string& name) const {
  const auto found = std::find_if(knobs_.begin(), knobs_.end(),
                                  [&](const Knob& knob) { return knob.name == name; });
  return found == knobs_.end() ? nullptr : &*found;
}

void Desk::aim(std::size_t index, double value, double seconds) {
  if (targets_.values[index] == value) return;
  targets_.values[index] = value;
  targets_.seconds[index] = static_cast<float>(seconds);
  changed_[index] = 1;
}

std::string Desk::set(const std::string& name, double value) {
  const Knob* const knob = find(name);
  if (knob == nullptr) {
    std::vector<std::string> names;
    for (const Knob& known : knobs_) names.push_back(known.name);
    const std::string nearest = program::nearest_name(name, names);
    return "no such row" + (nearest.empty() ? "" : "; did you mean " + nearest + "?");
  }
  // The wire's floats are no doubles: the bounds are met as the wire has them.
  if (!(value >= static_cast<double>(static_cast<float>(knob->min)) &&
        value <= static_cast<double>(static_cast<float>(knob->max)))) {
    return number(value) + ", allowed " + number(knob->min) + " to " + number(knob->max);
  }
  const std::lock_guard lock(mutex_);
  aim(static_cast<std::size_t>(knob - knobs_.data()), std::clamp(value, knob->min, knob->max),
      kSeconds);
  box_.send(targets_);
  return {};
}

std::optional<double> Desk::get(const std::string& name) const {
  const Knob* const knob = find(name);
  if (knob == nullptr) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return targets_.values[static_cast<std::size_t>(knob - knobs_.data())];
}

void Desk::play(const Sound& sound, double seconds) {
  const SoundNumbers numbers = numbers_of(sound);
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    aim(i, numbers[i], std::max(seconds, kSeconds));
  }
  box_.send(targets_);
}

std::vector<Desk::Change> Desk::take_changes(std::size_t most) {
  const std::lock_guard lock(mutex_);
  std::vector<Change> changes;
  for (std::size_t i = 0; i < changed_.size() && changes.size() < most; ++i) {
    if (changed_[i] == 0) continue;
    changed_[i] = 0;
    changes.push_back({knobs_[i].name, targets_.values[i]});
  }
  return changes;
}

void Desk::repeat() {
  const std::lock_guard lock(mutex_);
  box_.send(targets_);
}

}  // namespace splash::synth
