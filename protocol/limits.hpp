// SPDX-License-Identifier: MIT
// Every number that bounds the wire and the protocol's clocks, once.
#pragma once

#include <cstddef>
#include <cstdint>

namespace splash::protocol {

/// One Ethernet frame: 1500 bytes less the IPv4 and UDP headers.
inline constexpr std::size_t kMaxDatagram = 1472;
/// Counters that a patch may see wrap here: Pd's floats hold integers up to 2^24 exactly.
inline constexpr std::int32_t kCounterWrap = 1 << 24;
inline constexpr std::size_t kMaxMessages = 64;   ///< in one bundle
inline constexpr std::size_t kMaxArguments = 24;  ///< of one message
inline constexpr std::size_t kMaxString = 64;     ///< characters, address included

inline constexpr double kHeartbeatPeriod = 0.1;  ///< an idle simulator still says /frame [s]
inline constexpr double kPeerLease = 0.3;        ///< three missed heartbeats: the peer is gone [s]

/// To one host in the long run, and at once after a rest: replies, /pong (clocks are measured in
/// bursts), and lines in the log on what it did wrong.
inline constexpr double kReplyRate = 20.0;  ///< [1/s]
inline constexpr double kReplyBurst = 40.0;
inline constexpr double kPongRate = 100.0;  ///< [1/s]
inline constexpr double kPongBurst = 100.0;
inline constexpr double kReportRate = 1.0;  ///< [1/s]
inline constexpr double kReportBurst = 10.0;

inline constexpr double kSubscriptionLease = 60.0;  ///< of /notify; any datagram renews it [s]
inline constexpr std::size_t kMaxSubscribers = 16;  ///< of one program
inline constexpr unsigned kEventStream = 1;         ///< streams are the bits of /notify
inline constexpr unsigned kForceStream = 2;

inline constexpr std::uint16_t kSimPort = 57300;    ///< the simulator's control and poses (UDP)
inline constexpr std::uint16_t kSynthPort = 57310;  ///< the synth's events and control (UDP)

inline constexpr std::uint16_t kSimShowPort =
    57301;  ///< where viewers find the simulator's frames (TCP)
inline constexpr std::uint16_t kSynthShowPort = 57311;  ///< and the synth's (TCP)

}  // namespace splash::protocol
