// SPDX-License-Identifier: MIT
// A story of datagrams, from friends and strangers, through the synth's receiving side with a clock
// of the story's own: no datagram of another host draws more than it has, and who is not allowed is
// not answered at all.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "synth-server/receive/intake.hpp"
#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

using protocol::Endpoint;
using namespace synth;

constexpr double kStart = 5000.0;  // [s, monotonic]
constexpr double kUnix = 1.8e9;    // at the same moment [s]
constexpr std::uint32_t kAllowedHost = 0x0A000005;

/// This host, an allowed one, and two that are not.
constexpr std::array<Endpoint, 4> kPeers = {Endpoint{INADDR_LOOPBACK, 57300},
                                            Endpoint{kAllowedHost, 57300},
                                            Endpoint{0x0A000006, 57300}, Endpoint{0x0A000007, 9}};

constexpr std::size_t kFirstStranger = 2;
constexpr std::size_t kHeaders = 28;  // IPv4 and UDP [bytes]

struct Step {
  std::size_t peer = 0;
  double gap = 0.0;  ///< since the step before [s]
  Bytes datagram;
};

std::size_t byte_at(Bytes bytes, std::size_t index) {
  return std::to_integer<std::size_t>(bytes[index]);
}

/// Who (a byte), how long after the last one (a byte, in 4 ms), size (two bytes), datagram.
std::optional<Step> take_step(Bytes& rest) {
  if (rest.size() < 4) return std::nullopt;
  Step step{byte_at(rest, 0) % kPeers.size(), 0.004 * static_cast<double>(byte_at(rest, 1)), {}};
  const std::size_t size = byte_at(rest, 2) << 8U | byte_at(rest, 3);
  rest = rest.subspan(4);
  step.datagram = rest.first(std::min(size, rest.size()));
  rest = rest.subspan(step.datagram.size());
  return step;
}

class Story {
 public:
  Story()
      : intake_(queue_, {.clear_scheduled = [] {}, .quit = [] {}, .mute = [](bool) {}},
                {kAllowedHost},
                LocalTime([this] { return kUnix + (now_ - kStart); }, [this] { return now_; })) {}

  void take(const Step& step) {
    now_ += step.gap;
    std::vector<Reply> replies;
    intake_.tick(now_);
    const std::vector<std::byte> tight(step.datagram.begin(), step.datagram.end());
    const bool was_client = is_client(step.peer);
    intake_.datagram(tight, kPeers[step.peer], now_, replies);
    ++datagrams_;
    if (!was_client && is_client(step.peer)) replies.push_back(goodbye_to(step.peer));
    note(step, replies);
    check();
  }
  [[nodiscard]] std::uint64_t events() const { return intake_.counters().events; }

 private:
  void note(const Step& step, const std::vector<Reply>& replies) {
    std::size_t drawn = 0;
    for (const Reply& reply : replies) {
      const std::size_t size = protocol::encode(reply.message).size();
      promise(size <= protocol::kMaxDatagram, "a reply too long to send");
      promise(reply.to == kPeers[step.peer], "a reply to somebody who did not ask");
      promise(step.peer < kFirstStranger || reply.message.address == "/ping",
              "a stranger was answered");
      drawn += size + kHeaders;
    }
    if (step.peer == 0) return;  // this host
    promise(drawn <= step.datagram.size() + kHeaders,
            "a datagram of " + std::to_string(step.datagram.size()) + " bytes drew " +
                std::to_string(drawn) + " with headers");
  }
  static Reply goodbye_to(std::size_t peer) { return {kPeers[peer], protocol::done("/quit")}; }
  /// Whether it will get a goodbye one day: what asks for that has to be as long, too.
  [[nodiscard]] bool is_client(std::size_t peer) {
    std::vector<Reply> goodbyes;
    intake_.say_goodbye(goodbyes);
    return std::any_of(goodbyes.begin(), goodbyes.end(),
                       [&](const Reply& goodbye) { return goodbye.to == kPeers[peer]; });
  }
  void check() {
    queue_.consume_all([](const Command& command) {
      promise(std::isfinite(command.moment) && std::isfinite(command.by_arrival),
              "an event without a moment");
      promise(command.offset >= 0.0 && command.offset <= 10.0, "an offset out of its range");
    });
    const IntakeCounters counters = intake_.counters();
    promise(counters.datagrams == datagrams_, "a datagram was not counted");
    promise(counters.queue_full == 0, "a queue that is emptied is full");
  }

  double now_ = kStart;
  CommandQueue queue_;
  Intake intake_;
  std::uint64_t datagrams_ = 0;
};

}  // namespace

bool try_intake(Bytes input) {
  Story story;
  while (const auto step = take_step(input)) story.take(*step);
  return story.events() > 0;
}

}  // namespace splash::fuzz
