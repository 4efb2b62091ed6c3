// SPDX-License-Identifier: MIT
// A bubble as SuperCollider's server would play it, compiled by hand: the binary SynthDef format,
// version 2 (SuperCollider's "Synth Definition File Format").
#pragma once

#include <cstddef>
#include <vector>

namespace splash::supercollider {

/// "bubble" with the parameters amp, f0 [Hz], d [1/s], length [s], breaks [s]: on bus 0, from the
/// sample its bundle names,
///   amp exp(-d t) sin(2 pi f0 t (1 + 0.1 d t)),   paper section 5.2,
/// with t from Sweep and the phase's whole cycles taken away before the sine; from `breaks` on it
/// fades within 50 ms as synth-server's voices do.
[[nodiscard]] std::vector<std::byte> bubble_synthdef();

}  // namespace splash::supercollider
