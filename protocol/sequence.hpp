// SPDX-License-Identifier: MIT
// Classifies the bundles of one sender by their sequence numbers: missing, duplicate, reordered or
// of a new session.
#pragma once

#include <cstdint>

#include "protocol/event.hpp"

namespace splash::protocol {

enum class Arrival {
  first,  ///< the sender's first bundle
  in_order,
  new_session,  ///< the sender was restarted: counting starts anew
  reordered,    ///< older than the newest, but not seen before: play it
  duplicate,    ///< seen already, or too old to know: drop it
};

/// Remembers the last 64 sequence numbers of a session.
class SequenceWatch {
 public:
  Arrival observe(const Frame& frame) noexcept;
  [[nodiscard]] std::uint64_t received() const noexcept { return received_; }
  /// The number of bundles that were skipped and have not come since.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] std::uint64_t duplicates() const noexcept { return duplicates_; }
  [[nodiscard]] std::uint64_t reordered() const noexcept { return reordered_; }
  [[nodiscard]] std::uint64_t sessions() const noexcept { return sessions_; }

 private:
  void restart(const Frame& frame) noexcept;
  Arrival advance(std::int32_t ahead, const Frame& frame) noexcept;
  Arrival look_back(std::int32_t behind, const Frame& frame) noexcept;

  std::int32_t session_ = 0;
  std::int32_t newest_ = 0;
  std::uint64_t seen_ = 0;     ///< bit k: newest_ - k was seen
  std::uint64_t missing_ = 0;  ///< bit k: newest_ - k was skipped and has not come since
  std::int32_t stale_ = 0;     ///< frames too old to remember since the last newer one
  std::uint64_t received_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t duplicates_ = 0;
  std::uint64_t reordered_ = 0;
  std::uint64_t sessions_ = 0;
};

}  // namespace splash::protocol
