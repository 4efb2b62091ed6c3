// SPDX-License-Identifier: MIT
// What the engine lets in: settings at construction, events while it runs.
#pragma once

#include "protocol/event.hpp"
#include "synth-server/render/engine.hpp"

namespace splash::synth {

/// Returns `settings`. Throws std::invalid_argument naming the setting, its value and its limits.
const EngineSettings& checked(const EngineSettings& settings);

/// Whether all of the event's numbers are finite and within the address table's ranges.
[[nodiscard]] bool renderable(const protocol::Event& event) noexcept;

}  // namespace splash::synth
