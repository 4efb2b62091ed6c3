// SPDX-License-Identifier: MIT
#include "synth-server/output/rig_rows.hpp"

namespace splash::synth {
namespace {

constexpr const char* kPaper = "paper, section 6";

}  // namespace

std::vector<Field<RigEntry>> rig_fields() {
  return {
      {{.key = "name", .unit = "", .meaning = "what the rig is called", .required = true},
       &RigEntry::name},
      {{.key = "description", .unit = "", .meaning = "one line for lists"}, &RigEntry::description},
      {{.key = "device_channels",
        .unit = "",
        .meaning = "the device's channel of each of the rig's, in their order, from 1 on, e.g. "
                   "[3, 1]; left out: one after another",
        .min = 1,
        .max = kMostDeviceChannels},
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
      {{.key = "full_scale",
        .unit = "m",
        .meaning = "amplitude of a voice that drives its channel to 1.0, before gain_db",
        .min = 1e-6,
        .max = 10.0,
        .source = "a cavity of 10 cm: epsilon r = 0.1 x 0.1 m"},
       &OutputEntry::full_scale},
      {{.key = "gain_db", .unit = "dB", .meaning = "gain of all channels", .min = -60, .max = 60},
       &OutputEntry::gain_db},
      {{.key = "ceiling",
        .unit = "1",
        .meaning = "no sample ever leaves beyond this part of full scale",
        .min = 0.001,
        .max = 1.0},
       &OutputEntry::ceiling},
      {{.key = "body",
        .unit = "",
        .meaning = "number of the one body whose events are rendered; -1: all",
        .min = -1,
        .max = 16777215},
       &OutputEntry::body},
      {{.key = "trims_db",
        .unit = "dB",
        .meaning = "gain of each channel, in their order",
        .min = -60,
        .max = 60},
       &OutputEntry::trims_db},
      {{.key = "parts",
        .unit = "",
        .meaning = "worn: where its transducers sit, e.g. [heel, toe]; one channel each"},
       &OutputEntry::parts}};
}

std::vector<Field<Band>> band_fields() {
  return {{{.key = "low",
            .unit = "Hz",
            .meaning = "-3 dB point of the high-pass, 24 dB per octave",
            .min = 1,
            .max = 20000,
            .required = true},
           &Band::low},
          {{.key = "high",
            .unit = "Hz",
            .meaning = "-3 dB point of the low-pass; bubbles born above it are left out",
            .min = 2,
            .max = 192000,
            .required = true},
           &Band::high}};
}

std::vector<Field<Output>> tile_fields() {
  return {{{.key = "origin", .unit = "m", .meaning = "corner of tile 0 with the least x and y"},
           &Output::place},
          {{.key = "columns",
            .unit = "",
            .meaning = "tiles along +x",
            .min = 1,
            .max = 1024,
            .source = kPaper},
           &Output::tiles_x},
          {{.key = "rows",
            .unit = "",
            .meaning = "tiles along +y",
            .min = 1,
            .max = 1024,
            .source = kPaper},
           &Output::tiles_y},
          {{.key = "size",
            .unit = "m",
            .meaning = "edge of a tile",
            .min = 0.01,
            .max = 10,
            .source = kPaper},
           &Output::tile_size},
          {{.key = "reach",
            .unit = "m",
            .meaning = "an event moves tiles whose middle is nearer than this",
            .min = 0.01,
            .max = 100,
            .source = "1.3 tiles: an event on a corner moves its four tiles alike"},
           &Output::reach}};
}

std::vector<Field<Output>> stereo_fields() {
  return {{{.key = "middle",
            .unit = "m",
            .meaning = "point heard from both sides alike; left out: the scene's middle, as "
                       "--middle tells it"},
           &Output::place},
          {{.key = "width",
            .unit = "m",
            .meaning = "from all on the left to all on the right, along x",
            .min = 0.01,
            .max = 100},
           &Output::width}};
}

std::vector<Field<Equalisation>> equaliser_fields() {
  return {{{.key = "channels",
            .unit = "",
            .meaning = "which ones, e.g. [tile/07]; left out: all of the output"},
           &Equalisation::channels},
          {{.key = "most_boost_db",
            .unit = "dB",
            .meaning = "at no frequency does it play louder than this",
            .min = 0,
            .max = 24},
           &Equalisation::most_boost_db}};
}

std::vector<Field<SectionEntry>> section_fields() {
  return {{{.key = "kind",
            .unit = "",
            .meaning = "a peak (or notch), or all below or above a frequency",
            .required = true,
            .choices = {"peak", "low_shelf", "high_shelf"}},
           &SectionEntry::kind_name},
          {{.key = "frequency",
            .unit = "Hz",
            .meaning = "middle of a peak; where a shelf has half its gain",
            .min = 1,
            .max = 192000,
            .required = true},
           &SectionEntry::frequency},
          {{.key = "gain_db",
            .unit = "dB",
            .meaning = "its gain",
            .min = -60,
            .max = 24,
            .required = true},
           &SectionEntry::gain_db},
          {{.key = "q",
            .unit = "1",
            .meaning = "a peak's frequency over its width at half its gain",
            .min = 0.1,
            .max = 30},
           &SectionEntry::q}};
}

std::vector<Field<MeasuredResponse>> response_fields() {
  return {{{.key = "frequency",
            .unit = "Hz",
            .meaning = "2 to 64 rising frequencies, each at least 1.05 times the one before",
            .min = 1,
            .max = 192000,
            .required = true},
           &MeasuredResponse::frequency},
          {{.key = "level_db",
            .unit = "dB",
            .meaning = "measured there, over what it should be; it is undone",
            .min = -120,
            .max = 120,
            .required = true},
           &MeasuredResponse::level_db},
          {{.key = "most_cut_db",
            .unit = "dB",
            .meaning = "nothing is turned down by more than this",
            .min = 0,
            .max = 60},
           &MeasuredResponse::most_cut_db}};
}

std::vector<Field<ThresholdEntry>> threshold_fields() {
  return {{{.key = "sense",
            .unit = "",
            .meaning = "with what its signal is perceived",
            .required = true,
            .choices = {"touch", "hearing"}},
           &ThresholdEntry::sense_name},
          {{.key = "level_db",
            .unit = "dB",
            .meaning = "level, re full scale, at which a sine of 250 Hz (touch) or 1 kHz (hearing) "
                       "is just perceived; voices 20 dB below it end",
            .min = -140,
            .max = 0,
            .required = true},
           &ThresholdEntry::level_db}};
}

std::vector<Field<Heat>> heat_fields() {
  return {{{.key = "rms",
            .unit = "1",
            .meaning = "RMS value that the transducer takes continuously, in parts of full scale; "
                       "its limit sinks from the ceiling to this as it warms up",
            .min = 0.05,
            .max = 1.0,
            .required = true},
           &Heat::rms},
          {{.key = "seconds",
            .unit = "s",
            .meaning = "how fast it warms up and cools down: the coil's thermal time constant",
            .min = 0.1,
            .max = 600},
           &Heat::seconds}};
}

}  // namespace splash::synth
