// SPDX-License-Identifier: MIT
// Every number of a sound, a row each: the reader, the error texts and the manual come from them.
#pragma once

#include <string>
#include <vector>

#include "program/config.hpp"
#include "synth-server/voices/sound.hpp"

namespace splash::synth {

using program::Field;

/// What a sound is called, beside its numbers.
struct NamedSound {
  std::string name = "cirio2013";
  std::string description;
  Sound sound;  ///< the paper's
};

[[nodiscard]] std::vector<Field<NamedSound>> sound_fields();
[[nodiscard]] std::vector<Field<ImpactSound>> impact_fields();
[[nodiscard]] std::vector<Field<ToneSound>> bubble_fields();
[[nodiscard]] std::vector<Field<ToneSound>> cavity_fields();
[[nodiscard]] std::vector<Field<CloudSound>> cloud_fields();
[[nodiscard]] std::vector<Field<FineSound>> fine_fields();
[[nodiscard]] std::vector<Field<FootSound>> foot_fields();

}  // namespace splash::synth
