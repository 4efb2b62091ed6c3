// SPDX-License-Identifier: MIT
// Distances between sequence numbers are taken modulo their wrap, so a wrap is like any step.
#include "protocol/sequence.hpp"

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {
constexpr std::int32_t kRemembered = 64;
// A sender silent for half the numbers' range looks older than the newest for ever after: this
// many old frames without a newer one mean that counting has to start anew.
constexpr std::int32_t kStaleLimit = 64;
}  // namespace

void SequenceWatch::restart(const Frame& frame) noexcept {
  session_ = frame.session;
  newest_ = frame.sequence;
  seen_ = 1;
  missing_ = 0;
  stale_ = 0;
  ++sessions_;
  ++received_;
}

Arrival SequenceWatch::observe(const Frame& frame) noexcept {
  if (sessions_ == 0 || frame.session != session_) {
    const bool first = sessions_ == 0;
    restart(frame);
    return first ? Arrival::first : Arrival::new_session;
  }
  const std::int32_t ahead = (frame.sequence - newest_) & (kCounterWrap - 1);
  if (ahead != 0 && ahead < kCounterWrap / 2) return advance(ahead, frame);
  const std::int32_t behind = (kCounterWrap - ahead) & (kCounterWrap - 1);
  return look_back(behind, frame);
}

Arrival SequenceWatch::advance(std::int32_t ahead, const Frame& frame) noexcept {
  const std::int32_t skipped = ahead - 1;
  lost_ += static_cast<std::uint64_t>(skipped);
  if (ahead < kRemembered) {
    const auto shift = static_cast<unsigned>(ahead);
    seen_ = seen_ << shift | 1U;
    missing_ = missing_ << shift | ((1ULL << shift) - 2U);
  } else {
    seen_ = 1;
    missing_ = ~1ULL;
  }
  newest_ = frame.sequence;
  stale_ = 0;
  ++received_;
  return Arrival::in_order;
}

Arrival SequenceWatch::look_back(std::int32_t behind, const Frame& frame) noexcept {
  if (behind >= kRemembered && ++stale_ >= kStaleLimit) {
    restart(frame);
    return Arrival::new_session;
  }
  const std::uint64_t bit = behind < kRemembered ? 1ULL << static_cast<unsigned>(behind) : 0U;
  if (bit == 0 || (seen_ & bit) != 0) {  // too old to know: better dropped than played twice
    ++duplicates_;
    return Arrival::duplicate;
  }
  seen_ |= bit;
  if ((missing_ & bit) != 0) {  // else it was sent before the first that was heard
    missing_ &= ~bit;
    --lost_;
  }
  ++reordered_;
  ++received_;
  return Arrival::reordered;
}

}  // namespace splash::protocol
