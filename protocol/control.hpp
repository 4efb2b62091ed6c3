// SPDX-License-Identifier: MIT
// Builds the replies to commands, which are those of SuperCollider's server. Each conforms to the
// address table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/message.hpp"

namespace splash::protocol {

inline constexpr const char* kSimProgram = "sim-server";
inline constexpr const char* kSynthProgram = "synth-server";

/// /done command [value]
[[nodiscard]] Message done(const std::string& command, std::optional<std::int32_t> value = {});
/// /fail command reason. Texts are reduced to printable ASCII and cut at 64 characters.
[[nodiscard]] Message fail(const std::string& command, const std::string& reason);
/// The reason of the /fail to /notify when kMaxSubscribers have subscribed.
[[nodiscard]] std::string too_many_subscribers();
/// /value name value
[[nodiscard]] Message value_of(const std::string& name, double value);
/// /synced id
[[nodiscard]] Message synced(std::int32_t id);
/// /ping t0 and /pong t0 t1 t2
[[nodiscard]] Message ping(TimeTag sent);
[[nodiscard]] Message pong(TimeTag sent, TimeTag received, TimeTag replied);
/// /version.reply program major minor patch branch hash
[[nodiscard]] Message version_reply(const std::string& program);

/// The project's version, "0.1.0".
[[nodiscard]] std::string version();

}  // namespace splash::protocol
