// SPDX-License-Identifier: MIT
#include "synth-server/render/live_controls.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {
namespace {

using Layout = ControlLayout;

ControlLayout layout_of(const Rig& rig) {
  return {rig.outputs.size(), static_cast<std::size_t>(channel_count(rig))};
}

}  // namespace

std::vector<double> control_values(const Rig& rig, const Sound& sound) {
  const Layout layout = layout_of(rig);
  std::vector<double> values(layout.count(), 0.0);
  const SoundNumbers numbers = numbers_of(sound);
  std::copy(numbers.begin(), numbers.end(), values.begin());
  std::size_t channel = 0;
  for (std::size_t o = 0; o < rig.outputs.size(); ++o) {
    const Output& output = rig.outputs[o];
    values[Layout::of_output(o, Layout::gain_db)] = output.gain_db;
    values[Layout::of_output(o, Layout::ceiling)] = output.ceiling;
    const auto count = static_cast<std::size_t>(channel_count(output));
    for (std::size_t c = 0; c < count; ++c, ++channel) {
      const double trim = output.trims_db.empty() ? 0.0 : output.trims_db[c];
      values[layout.of_channel(channel, Layout::trim_db)] = trim;
    }
  }
  return values;
}

LiveControls::LiveControls(const Rig& rig, const Sound& sound, double sample_rate, ControlBox* box)
    : cells_per_second_(sample_rate / kCell),
      box_(box),
      layout_(layout_of(rig)),
      ways_(layout_.count()),
      logarithmic_(box == nullptr ? std::vector<char>(layout_.count(), 0) : box->logarithmic()),
      rigs_(control_values(rig, sound)),
      channels_(layout_.channels),
      ceilings_(layout_.outputs) {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const double scaled = logarithmic_[i] != 0 ? std::log(rigs_[i]) : rigs_[i];
    ways_[i] = {scaled, 0.0, scaled, rigs_[i], 0};
  }
  for (std::size_t o = 0; o < rig.outputs.size(); ++o) {
    const auto count = static_cast<std::size_t>(channel_count(rig.outputs[o]));
    output_of_.insert(output_of_.end(), count, o);
  }
  show();
  show();  // steady from the first cell on
}

double LiveControls::value(std::size_t i) const noexcept {
  const Way& way = ways_[i];
  if (way.left == 0) return way.target;
  return logarithmic_[i] != 0 ? std::exp(way.now) : way.now;
}

bool LiveControls::has_rigs_ceiling(std::size_t channel) const noexcept {
  const std::size_t output = output_of_[channel];
  const double rigs = rigs_[Layout::of_output(output, Layout::ceiling)];
  return ceilings_[output].begin == rigs && ceilings_[output].end == rigs;
}

double LiveControls::output_gain(std::size_t output) const noexcept {
  const std::size_t i = Layout::of_output(output, Layout::gain_db);
  return gain_of(value(i) - rigs_[i]);
}

void LiveControls::begin_cell() noexcept {
  if (box_ == nullptr) return;
  if (const ControlTargets* targets = box_->take()) aim(*targets);
  if (moving_ || settling_) {
    settling_ = moving_;
    move();
    show();
  }
}

void LiveControls::aim(const ControlTargets& targets) noexcept {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    Way& way = ways_[i];
    if (targets.values[i] == way.target) continue;
    way.target = targets.values[i];
    way.aim = logarithmic_[i] != 0 ? std::log(way.target) : way.target;
    const double cells = std::ceil(static_cast<double>(targets.seconds[i]) * cells_per_second_);
    way.left = std::max<std::int64_t>(1, static_cast<std::int64_t>(cells));
    way.step = (way.aim - way.now) / static_cast<double>(way.left);
    moving_ = true;
  }
}

void LiveControls::move() noexcept {
  moving_ = false;
  for (Way& way : ways_) {
    if (way.left == 0) continue;
    way.now = --way.left == 0 ? way.aim : way.now + way.step;
    moving_ = moving_ || way.left != 0;
  }
  settling_ = settling_ || moving_;
}

double LiveControls::heard(std::size_t mute, std::size_t solo, double loudest_solo) const noexcept {
  return (1.0 - value(mute)) * (1.0 - loudest_solo * (1.0 - value(solo)));
}

/// From what was at the end of the last cell to what is at the end of this one.
void LiveControls::show() noexcept {
  SoundNumbers numbers{};
  for (std::size_t i = 0; i < kSoundNumbers; ++i) numbers[i] = value(i);
  sound_ = sound_of(numbers);
  const auto go_to = [](CellGain& gain, double end) { gain = {gain.end, end}; };
  const auto loudest = [&](std::size_t count, auto&& solo_of) {
    double most = 0.0;
    for (std::size_t i = 0; i < count; ++i) most = std::max(most, value(solo_of(i)));
    return most;
  };

  const double component_solo = loudest(Layout::kComponents, Layout::solo);
  const protocol::ByKind<double> gains = component_gains(sound_);
  for (std::size_t c = 0; c < Layout::kComponents; ++c) {
    go_to(components_[c],
          gain_of(gains.values[c]) * heard(Layout::mute(c), Layout::solo(c), component_solo));
  }
  const double output_solo = loudest(
      layout_.outputs, [](std::size_t o) { return Layout::of_output(o, Layout::output_solo); });
  const double channel_solo = loudest(layout_.channels, [this](std::size_t c) {
    return layout_.of_channel(c, Layout::channel_solo);
  });
  for (std::size_t o = 0; o < layout_.outputs; ++o) {
    go_to(ceilings_[o], value(Layout::of_output(o, Layout::ceiling)));
  }
  for (std::size_t c = 0; c < layout_.channels; ++c) {
    const std::size_t o = output_of_[c];
    const std::size_t trim = layout_.of_channel(c, Layout::trim_db);
    const double of_output =
        output_gain(o) * heard(Layout::of_output(o, Layout::output_mute),
                               Layout::of_output(o, Layout::output_solo), output_solo);
    go_to(channels_[c], of_output * gain_of(value(trim) - rigs_[trim]) *
                            heard(layout_.of_channel(c, Layout::channel_mute),
                                  layout_.of_channel(c, Layout::channel_solo), channel_solo));
  }
}

}  // namespace splash::synth
