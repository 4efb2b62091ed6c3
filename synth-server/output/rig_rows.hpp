// SPDX-License-Identifier: MIT
// Every key that may stand in a rig file, a row each: the reader, the error texts and the manual
// come from them.
#pragma once

#include <string>
#include <vector>

#include "program/config.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

using program::Field;

/// What the YAML says of a rig beside Rig's own members.
struct RigEntry : Rig {
  std::vector<double> device_channel_numbers;
};
/// The same of an output and its parts.
struct OutputEntry : Output {
  std::string kind_name;
};
struct SectionEntry : EqualiserSection {
  std::string kind_name;
};
struct ThresholdEntry : Threshold {
  std::string sense_name;
};

[[nodiscard]] std::vector<Field<RigEntry>> rig_fields();
[[nodiscard]] std::vector<Field<OutputEntry>> output_fields();
[[nodiscard]] std::vector<Field<Band>> band_fields();
[[nodiscard]] std::vector<Field<Output>> tile_fields();
[[nodiscard]] std::vector<Field<Output>> stereo_fields();
[[nodiscard]] std::vector<Field<Equalisation>> equaliser_fields();
[[nodiscard]] std::vector<Field<SectionEntry>> section_fields();
[[nodiscard]] std::vector<Field<MeasuredResponse>> response_fields();
[[nodiscard]] std::vector<Field<ThresholdEntry>> threshold_fields();
[[nodiscard]] std::vector<Field<Heat>> heat_fields();

}  // namespace splash::synth
