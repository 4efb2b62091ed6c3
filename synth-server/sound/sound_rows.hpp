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

/// The number of a row, each of which is a double.
template <class Part>
[[nodiscard]] const double& number_of(const Part& part, const Field<Part>& field) {
  return part.*std::get<double Part::*>(field.member);
}

/// Calls `visit` with each part of a sound: its name in files, its rows and its numbers. `AnySound`
/// is const when they are read only.
template <class AnySound, class Visit>
void each_part(AnySound& sound, Visit&& visit) {
  visit("impact", impact_fields(), sound.impact);
  visit("bubble", bubble_fields(), sound.bubble);
  visit("cavity", cavity_fields(), sound.cavity);
  visit("cloud", cloud_fields(), sound.cloud);
  visit("fine", fine_fields(), sound.fine);
  visit("foot", foot_fields(), sound.foot);
}

}  // namespace splash::synth
