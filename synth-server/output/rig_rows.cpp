// SPDX-License-Identifier: MIT
#include "synth-server/output/rig_rows.hpp"

namespace splash::synth {
namespace {

using program::number_row;
using program::required;

constexpr const char* kPaper = "paper, section 6";

}  // namespace

std::vector<Field<RigEntry>> rig_fields() {
  return {
      {{.key = "name", .unit = "", .meaning = "what the rig is called", .required = true},
       &RigEntry::name},
      {{.key = "description", .unit = "", .meaning = "one line for lists"}, &RigEntry::description},
      {number_row("device_channels", "", 1, kMostDeviceChannels,
                  "the device's channel of each of the rig's, in their order, from 1 on, e.g. "
                  "[3, 1]; left out: one after another"),
       &RigEntry::device_channel_numbers}};
}

std::vector<Field<OutputEntry>> output_fields() {
  return {
      {{.key = "name", .unit = "", .meaning = "begins the names of its channels", .required = true},
       &OutputEntry::name},
      {{.key = "kind",
        .unit = "",
        .meaning = "a floor of tiles, one transducer, several worn on one body, or a pair of "
                   "loudspeakers",
        .required = true,
        .choices = {"tiles", "single", "worn", "stereo"}},
       &OutputEntry::kind_name},
      {number_row("full_scale", "m", 1e-6, 10.0,
                  "amplitude of a voice that drives its channel to 1.0, before gain_db",
                  "a cavity of 10 cm: epsilon r = 0.1 x 0.1 m"),
       &OutputEntry::full_scale},
      {number_row("gain_db", "dB", -60, 60, "gain of all channels"), &OutputEntry::gain_db},
      {number_row("ceiling", "1", 0.001, 1.0,
                  "no sample ever leaves beyond this part of full scale"),
       &OutputEntry::ceiling},
      {number_row("body", "", -1, 16777215,
                  "number of the one body whose events are rendered; -1: all"),
       &OutputEntry::body},
      {number_row("trims_db", "dB", -60, 60, "gain of each channel, in their order"),
       &OutputEntry::trims_db},
      {{.key = "parts",
        .unit = "",
        .meaning = "worn: where its transducers sit, e.g. [heel, toe]; one channel each"},
       &OutputEntry::parts}};
}

std::vector<Field<Band>> band_fields() {
  return {{required(
               number_row("low", "Hz", 1, 20000, "-3 dB point of the high-pass, 24 dB per octave")),
           &Band::low},
          {required(number_row("high", "Hz", 2, 192000,
                               "-3 dB point of the low-pass; bubbles born above it are left out")),
           &Band::high}};
}

std::vector<Field<Output>> tile_fields() {
  return {
      {{.key = "origin", .unit = "m", .meaning = "corner of tile 0 with the least x and y"},
       &Output::place},
      {number_row("columns", "", 1, 1024, "tiles along +x", kPaper), &Output::tiles_x},
      {number_row("rows", "", 1, 1024, "tiles along +y", kPaper), &Output::tiles_y},
      {number_row("size", "m", 0.01, 10, "edge of a tile", kPaper), &Output::tile_size},
      {number_row("reach", "m", 0.01, 100, "an event moves tiles whose middle is nearer than this",
                  "1.3 tiles: an event on a corner moves its four tiles alike"),
       &Output::reach}};
}

std::vector<Field<Output>> stereo_fields() {
  return {{{.key = "middle",
            .unit = "m",
            .meaning = "point heard from both sides alike; left out: the scene's middle, as "
                       "--middle tells it"},
           &Output::place},
          {number_row("width", "m", 0.01, 100, "from all on the left to all on the right, along x"),
           &Output::width}};
}

std::vector<Field<Equalisation>> equaliser_fields() {
  return {
      {{.key = "channels",
        .unit = "",
        .meaning = "which ones, e.g. [tile/07]; left out: all of the output"},
       &Equalisation::channels},
      {number_row("most_boost_db", "dB", 0, 24, "at no frequency does it play louder than this"),
       &Equalisation::most_boost_db}};
}

std::vector<Field<SectionEntry>> section_fields() {
  return {{{.key = "kind",
            .unit = "",
            .meaning = "a peak (or notch), or all below or above a frequency",
            .required = true,
            .choices = {"peak", "low_shelf", "high_shelf"}},
           &SectionEntry::kind_name},
          {required(number_row("frequency", "Hz", 1, 192000,
                               "middle of a peak; where a shelf has half its gain")),
           &SectionEntry::frequency},
          {required(number_row("gain_db", "dB", -60, 24, "its gain")), &SectionEntry::gain_db},
          {number_row("q", "1", 0.1, 30, "a peak's frequency over its width at half its gain"),
           &SectionEntry::q}};
}

std::vector<Field<MeasuredResponse>> response_fields() {
  return {
      {required(number_row("frequency", "Hz", 1, 192000,
                           "2 to 64 rising frequencies, each at least 1.05 times the one before")),
       &MeasuredResponse::frequency},
      {required(number_row("level_db", "dB", -120, 120,
                           "measured there, over what it should be; it is undone")),
       &MeasuredResponse::level_db},
      {number_row("most_cut_db", "dB", 0, 60, "nothing is turned down by more than this"),
       &MeasuredResponse::most_cut_db}};
}

std::vector<Field<ThresholdEntry>> threshold_fields() {
  return {{{.key = "sense",
            .unit = "",
            .meaning = "with what its signal is perceived",
            .required = true,
            .choices = {"touch", "hearing"}},
           &ThresholdEntry::sense_name},
          {required(number_row(
               "level_db", "dB", -140, 0,
               "level, re full scale, at which a sine of 250 Hz (touch) or 1 kHz (hearing) "
               "is just perceived; voices 20 dB below it end")),
           &ThresholdEntry::level_db}};
}

std::vector<Field<Heat>> heat_fields() {
  return {{required(number_row(
               "rms", "1", 0.05, 1.0,
               "RMS value that the transducer takes continuously, in parts of full scale; "
               "its limit sinks from the ceiling to this as it warms up")),
           &Heat::rms},
          {number_row("seconds", "s", 0.1, 600,
                      "how fast it warms up and cools down: the coil's thermal time constant"),
           &Heat::seconds}};
}

}  // namespace splash::synth
