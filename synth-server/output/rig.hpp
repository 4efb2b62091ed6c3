// SPDX-License-Identifier: MIT
// What the synth drives, as plain validated structs: a list of outputs, each a group of channels
// with its place in the scene's world, its band and its level. Read by output/rig_reader.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace splash::synth {

enum class OutputKind {
  tiles,   ///< a floor of square tiles, one channel each
  single,  ///< one transducer, in a hand or a shoe: one channel
  worn,    ///< several on one body, such as heel and toe of a shoe: one channel each
  stereo,  ///< two loudspeakers or headphones: left, right
};

/// What an output renders; outside it, channels fall by 24 dB per octave.
struct Band {
  double low = 20.0;    ///< -3 dB point of the high-pass [Hz]
  double high = 750.0;  ///< -3 dB point of the low-pass [Hz]; bubbles born above it are left out
};

enum class SectionKind { peak, low_shelf, high_shelf };

struct EqualiserSection {
  SectionKind kind = SectionKind::peak;
  double frequency = 100.0;  ///< middle of a peak, or where a shelf has half its gain [Hz]
  double gain_db = 0.0;      ///< [dB]
  double q = 0.7071;         ///< a peak's frequency over its width at half its gain [1]
};

/// What was measured of a transducer, to be undone; no points: nothing was.
struct MeasuredResponse {
  std::vector<double> frequency;  ///< rising [Hz]
  std::vector<double> level_db;   ///< at these, over what it should be [dB]
  double most_cut_db = 40.0;      ///< louder places are turned down by at most this [dB]
};

/// Evens out some channels of an output.
struct Equalisation {
  std::vector<std::string> channels;  ///< names within the output, e.g. "tile/07"; empty: all
  double most_boost_db = 6.0;         ///< nowhere louder than this: power that harms [dB]
  std::vector<EqualiserSection> sections;
  MeasuredResponse response;
};

enum class Sense { none, touch, hearing };

/// The threshold of touch or hearing at an output: voices end where they fall below it.
struct Threshold {
  Sense sense = Sense::none;
  double level_db = -80.0;  ///< a sine of 250 Hz (touch) or 1 kHz (hearing) is just felt or heard
                            ///< at this level [dB re full scale]
};

/// What a transducer bears for ever, see output/output_guard.hpp.
struct Heat {
  double rms = 0.0;      ///< RMS value [full scale]; 0: not known, no budget
  double seconds = 5.0;  ///< thermal time constant [s]
};

inline constexpr int kMaxTiles = 1024;  ///< of one output

struct Output {
  std::string name;
  OutputKind kind = OutputKind::single;
  Band band;
  double full_scale = 0.01;  ///< amplitude of a voice that drives the channel to 1.0 [m], as
                             ///< paper section 5.2 measures amplitudes: A0 = epsilon r
  double gain_db = 0.0;      ///< on top of that [dB]
  double ceiling = 0.9;      ///< the device never gets a sample beyond this [full scale]
  int body = -1;             ///< renders events of this body of the scene only; -1: of all
  /// tiles: lower corner of tile 0; stereo: middle between the loudspeakers [m].
  std::array<double, 3> place = {0.0, 0.0, 0.0};
  bool has_place = true;     ///< stereo: false where the file names no middle: the scene's it is
  int tiles_x = 6;           ///< tiles: columns, along +x
  int tiles_y = 6;           ///< tiles: rows, along +y
  double tile_size = 0.305;  ///< tiles: edge of a tile [m]; paper section 6: 30.5 cm
  double reach = 0.40;       ///< tiles: an event is felt up to this far from a tile's middle [m]
  double width = 2.0;        ///< stereo: an event this wide from left to right pans fully [m]
  std::vector<double> trims_db;    ///< gain of each channel [dB]; empty: none
  std::vector<std::string> parts;  ///< worn: where on the body, one channel each
  std::vector<Equalisation> equalisers;
  Threshold threshold;
  Heat heat;
};

struct Rig {
  std::string name;
  std::string description;
  std::vector<Output> outputs;  ///< their channels follow each other in this order
  /// The device's channel of each of the rig's, from 1 on; empty: one after another.
  std::vector<int> device_channels;
};

inline constexpr int kMostDeviceChannels = 4096;

[[nodiscard]] int channel_count(const Output& output) noexcept;
[[nodiscard]] int channel_count(const Rig& rig) noexcept;

/// One name per channel within its output: "tile/07", "heel", "left", "" for a single one.
[[nodiscard]] std::vector<std::string> part_names(const Output& output);
/// One name per channel, for lists and port maps: "floor/tile/07", "hand", "left shoe/heel".
/// Tiles are numbered from the lower corner along +x, then row by row along +y.
[[nodiscard]] std::vector<std::string> channel_names(const Rig& rig);

/// Puts loudspeakers that name no middle of their own around the scene's, `middle` [m].
void centre(Rig& rig, const std::array<double, 3>& middle) noexcept;

/// Throws std::invalid_argument with output, key, value and limit when a rig cannot be rendered.
void check(const Rig& rig);

}  // namespace splash::synth
