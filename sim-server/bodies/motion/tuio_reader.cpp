// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/tuio_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace splash::sim {
namespace {

constexpr std::size_t kMostSources = 16;
constexpr std::size_t kMostChanged = 256;  ///< of a frame, however many bundles bring it
/// A number so far below the last, or after so long, is that of a sender that was started anew.
constexpr std::int32_t kRestart = 100;  // frames
constexpr double kSilence = 1.0;        // [s]

/// Where x, y and the angle stand behind "set" and the session number; 0: no angle.
struct Layout {
  std::string_view address;
  std::size_t x;
  std::size_t angle;
};
constexpr Layout kLayouts[] = {{"/tuio/2Dcur", 2, 0}, {"/tuio/2Dobj", 3, 5}, {"/tuio/2Dblb", 2, 4}};

const Layout* layout_of(const std::string& address) {
  const auto* const found =
      std::find_if(std::begin(kLayouts), std::end(kLayouts),
                   [&](const Layout& layout) { return layout.address == address; });
  return found == std::end(kLayouts) ? nullptr : found;
}

std::optional<std::string> text_at(const protocol::Message& message, std::size_t index) {
  if (index >= message.arguments.size()) return std::nullopt;
  const auto* text = std::get_if<std::string>(&message.arguments[index]);
  return text == nullptr ? std::nullopt : std::optional(*text);
}

std::optional<std::int32_t> whole_at(const protocol::Message& message, std::size_t index) {
  if (index >= message.arguments.size()) return std::nullopt;
  const auto* whole = std::get_if<std::int32_t>(&message.arguments[index]);
  return whole == nullptr ? std::nullopt : std::optional(*whole);
}

/// Some senders write 0 and 1 as whole numbers.
std::optional<double> number_at(const protocol::Message& message, std::size_t index) {
  if (const auto whole = whole_at(message, index)) return *whole;
  if (index >= message.arguments.size()) return std::nullopt;
  const auto* real = std::get_if<float>(&message.arguments[index]);
  return real == nullptr ? std::nullopt : std::optional(static_cast<double>(*real));
}

}  // namespace

bool is_tuio(const std::string& address) noexcept {
  return layout_of(address) != nullptr;
}

TuioReader::Source* TuioReader::open(const std::string& address, double arrival) {
  const std::pair<std::string, std::string> key = {address, speaking_[address]};
  auto found = sources_.find(key);
  if (found == sources_.end() && sources_.size() >= kMostSources) {
    // The one that has been silent for longest gives way, if that is long.
    const auto oldest = std::min_element(
        sources_.begin(), sources_.end(),
        [](const auto& a, const auto& b) { return a.second.arrival < b.second.arrival; });
    if (arrival - oldest->second.arrival < kSilence) return nullptr;
    sources_.erase(oldest);
  }
  if (found == sources_.end()) {
    found = sources_.emplace(key, Source{}).first;
    found->second.frame.address = address;
    found->second.frame.source = key.second;
    found->second.arrival = arrival;
  }
  return &found->second;
}

void TuioReader::change(Source& source, const protocol::Message& message) {
  const Layout& layout = *layout_of(message.address);
  const auto id = whole_at(message, 1);
  const auto x = number_at(message, layout.x);
  const auto y = number_at(message, layout.x + 1);
  if (!id || !x || !y || source.changed.size() >= kMostChanged) return;
  TuioCursor cursor = {.x = *x, .y = *y};
  if (layout.angle > 0) cursor.angle = number_at(message, layout.angle);
  source.changed[*id] = cursor;
}

std::optional<TuioFrame> TuioReader::take(const protocol::Message& message, double arrival,
                                          const LetSource& lets) {
  const auto what = text_at(message, 0);
  if (!what || layout_of(message.address) == nullptr) return std::nullopt;
  if (*what == "source") {
    speaking_[message.address] = text_at(message, 1).value_or("");
    return std::nullopt;
  }
  Source* const source = open(message.address, arrival);
  if (source == nullptr) return std::nullopt;
  if (lets && !lets(message.address, source->frame.source)) {
    if (*what == "fseq") speaking_[message.address].clear();
    return std::nullopt;
  }
  if (*what == "set") change(*source, message);
  if (*what == "alive") {
    source->alive.clear();
    for (std::size_t i = 1; i < message.arguments.size(); ++i) {
      if (const auto id = whole_at(message, i)) source->alive.push_back(*id);
    }
  }
  if (*what != "fseq") return std::nullopt;
  speaking_[message.address].clear();
  const std::int32_t number = whole_at(message, 1).value_or(-1);
  const bool again = number < 0;  // a frame said once more has no number
  const std::int64_t back = std::int64_t{source->last} - number;
  const bool anew = back > kRestart || arrival - source->arrival > kSilence;
  const std::map<std::int32_t, TuioCursor> changed = std::exchange(source->changed, {});
  if (!again && !anew && number <= source->last) return std::nullopt;
  if (!again) source->last = number;
  source->arrival = arrival;
  std::map<std::int32_t, TuioCursor> lives;
  for (const std::int32_t id : source->alive) {
    if (const auto now = changed.find(id); now != changed.end()) {
      lives.insert(*now);
    } else if (const auto known = source->frame.cursors.find(id);
               known != source->frame.cursors.end()) {
      lives.insert(*known);
    }
  }
  source->frame.cursors = std::move(lives);
  return source->frame;
}

}  // namespace splash::sim
