// SPDX-License-Identifier: MIT
#include "tests/network/synth_side.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "synth-server/output/rig_reader.hpp"

namespace splash::network {
namespace {

/// Whatever is heard is started, so that what is not can be counted.
synth::EngineSettings nothing_skipped() {
  synth::EngineSettings settings;
  settings.sample_rate = kRate;
  settings.max_block = kBlock;
  settings.start_ramp = 0.0;
  settings.skip_out_of_band = false;
  settings.skip_unfelt = false;
  return settings;
}

}  // namespace

SynthSide::SynthSide(std::function<double()> unix_clock)
    : engine_(synth::read_rig(std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/stereo.yaml"),
              nothing_skipped()),
      player_(engine_, passed_, nullptr, {kRate, kBlock, 0.0, false, {}}),
      intake_(heard_, {}, {}, synth::LocalTime(std::move(unix_clock), [this] { return now(); })) {}

void SynthSide::receive(const Datagram& datagram, const protocol::Endpoint& from) {
  intake_.datagram(datagram, from, now(), replies_);
}

void SynthSide::play() {
  intake_.tick(now());
  heard_.consume_all([this](const synth::Command& command) {
    if (command.kind == synth::Command::Kind::play) {
      const auto id = std::visit([](const auto& event) { return event.id; }, command.event);
      played_.push_back({id, command.moment, tick_});
    }
    (void)passed_.push(command);
  });
  std::array<std::array<float, kBlock>, 2> samples{};
  std::array<float*, 2> channels{samples[0].data(), samples[1].data()};
  player_.render({channels.data(), kBlock, now(), false, false});
  const auto sounds = [](const auto& channel) {
    return std::any_of(channel.begin(), channel.end(), [](float x) { return x != 0.0F; });
  };
  if (sounds(samples[0]) || sounds(samples[1])) last_sound_ = tick_;
  ++tick_;
}

}  // namespace splash::network
