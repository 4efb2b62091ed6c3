// SPDX-License-Identifier: MIT
#include "tests/supercollider/score.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "tests/pd-patches/rendering.hpp"
#include "tests/supercollider/synthdef.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording.hpp"

namespace splash::supercollider {
namespace {

constexpr double kTimeout = 120.0;  ///< for one rendering on a busy machine [s]
constexpr double kNever = 1e6;      ///< [s]
constexpr double kFaintest = 1e-8;  ///< a voice ends at this [full scale]
/// Of a sample: scsynth rounds to the nearest, but what lies on a block's edge it puts into the
/// last sample of the block before.
constexpr double kWithin = 0.25;

/// The few kinds of OSC that a score needs.
class Packet {
 public:
  void text(const std::string& value) {
    bytes_ += value;
    bytes_.append(4 - value.size() % 4, '\0');
  }
  void whole(std::int64_t value, int bytes = 4) {
    for (int k = bytes - 1; k >= 0; --k) {
      bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * k) & 0xFFU));
    }
  }
  void real(double value) { whole(std::bit_cast<std::int32_t>(static_cast<float>(value))); }
  void blob(const std::vector<std::byte>& value) {
    whole(static_cast<std::int64_t>(value.size()));
    for (const std::byte byte : value) bytes_.push_back(static_cast<char>(byte));
    bytes_.append((4 - value.size() % 4) % 4, '\0');
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

struct Tone {
  double radius = 0.0;   ///< [m]
  double epsilon = 0.0;  ///< [1]
  double life = 0.0;     ///< until it breaks, 0: never [s]
};

std::optional<Tone> tone_of(const protocol::Event& event) {
  if (const auto* b = std::get_if<protocol::Bubble>(&event)) {
    return Tone{static_cast<double>(b->radius), static_cast<double>(b->epsilon)};
  }
  if (const auto* c = std::get_if<protocol::Cavity>(&event)) {
    return Tone{static_cast<double>(c->radius), static_cast<double>(c->epsilon),
                static_cast<double>(c->life)};
  }
  return std::nullopt;
}

float offset_of(const protocol::Event& event) {
  return std::visit([](const auto& e) { return e.offset_ms; }, event);
}

/// By their samples, in the log's order.
std::multimap<std::int64_t, Tone> tones(const std::vector<protocol::LogEntry>& log,
                                        const ScoreSettings& settings) {
  std::multimap<std::int64_t, Tone> found;
  for (const auto& entry : log) {
    for (const auto& message : entry.messages) {
      const auto event = protocol::to_event(message);
      const auto tone = event ? tone_of(*event) : std::nullopt;
      if (!tone || 3.0 / tone->radius > settings.highest) continue;
      const double seconds = entry.seconds + 1e-3 * static_cast<double>(offset_of(*event));
      found.emplace(std::llround(seconds * settings.sample_rate), *tone);
    }
  }
  return found;
}

/// f0 r = 3 m/s and d = 0.13 / r + 0.0072 r^-1.5: paper, section 5.2.
std::string new_bubble(const Tone& tone, double gain, double sample_rate) {
  const double damping = 0.13 / tone.radius + 0.0072 * std::pow(tone.radius, -1.5);
  const double amplitude = tone.epsilon * tone.radius * gain;
  Packet message;
  message.text("/s_new");
  message.text(",siiisfsfsfsfsf");
  message.text("bubble");
  message.whole(-1);  // a number of scsynth's own
  message.whole(1);   // at the end
  message.whole(0);   // of the root group
  const auto set = [&](const char* name, double value) {
    message.text(name);
    message.real(value);
  };
  set("amp", amplitude);
  set("f0", 3.0 / tone.radius);
  set("d", damping);
  set("length", std::max(1e-3, std::log(amplitude / kFaintest) / damping));
  set("breaks", tone.life > 0.0 ? std::round(tone.life * sample_rate) / sample_rate : kNever);
  return message.bytes();
}

void write_bundle(std::ofstream& file, double seconds, const std::string& message) {
  Packet bundle;
  bundle.text("#bundle");
  bundle.whole(static_cast<std::int64_t>(std::llround(seconds * 4294967296.0)), 8);
  bundle.whole(static_cast<std::int64_t>(message.size()));
  Packet size;
  size.whole(static_cast<std::int64_t>(bundle.bytes().size() + message.size()));
  file << size.bytes() << bundle.bytes() << message;
}

}  // namespace

int write_score(const std::vector<protocol::LogEntry>& log, const ScoreSettings& settings,
                const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  Packet definition;
  definition.text("/d_recv");
  definition.text(",b");
  definition.blob(bubble_synthdef());
  write_bundle(file, 0.0, definition.bytes());
  int count = 0;
  for (const auto& [sample, tone] : tones(log, settings)) {
    write_bundle(file, (static_cast<double>(sample) + kWithin) / settings.sample_rate,
                 new_bubble(tone, settings.gain, settings.sample_rate));
    ++count;
  }
  Packet nothing;  // the rendering ends with the last bundle
  nothing.text("/c_set");
  nothing.text(",ii");
  nothing.whole(0);
  nothing.whole(0);
  write_bundle(file, static_cast<double>(settings.frames) / settings.sample_rate, nothing.bytes());
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  return count;
}

std::vector<float> render_with_scsynth(const std::vector<protocol::LogEntry>& log,
                                       const ScoreSettings& settings) {
  const pd::ScratchFolder folder;
  const auto score = folder.path() / "score.osc";
  const auto wav = folder.path() / "out.wav";
  write_score(log, settings, score);
  tests::ChildProcess scsynth({"scsynth", "-V", "-1", "-N", score.string(), "_", wav.string(),
                               std::to_string(std::llround(settings.sample_rate)), "WAV", "float",
                               "-o", "1", "-i", "0", "-n", "65536", "-m", "262144"});
  const auto status = scsynth.wait(kTimeout);
  if (status != 0) {
    throw std::runtime_error("scsynth ended with " + std::to_string(status.value_or(-1)) +
                             (status == 127 ? " (apt-get install supercollider-server)" : "") +
                             ": " + scsynth.output());
  }
  auto channel = tests::read_recording(wav.string()).channels.at(0);
  channel.resize(static_cast<std::size_t>(settings.frames));
  return channel;
}

}  // namespace splash::supercollider
