// SPDX-License-Identifier: MIT
#include "synth-server/sound/sound_rows.hpp"

#include <utility>

namespace splash::synth {
namespace {

/// Gains reach far enough down to be silence, and no further up than the guard's input.
constexpr double kLeastGain = -60.0;
constexpr double kMostGain = 24.0;
constexpr const char* kSection5 = "paper, section 5.2.1";
constexpr const char* kSection6 = "paper, section 6";

/// Of a kind of event.
std::string plural_of(const std::string& name) {
  for (const protocol::KindNames& kind : protocol::kKindNames) {
    if (kind.name() == name) return kind.plural;
  }
  return name;
}

std::vector<Field<ToneSound>> fields(const ToneSound& /*part*/, const std::string& name) {
  return {{{.key = "gain_db",
            .unit = "dB",
            .meaning = "gain of all " + plural_of(name),
            .min = kLeastGain,
            .max = kMostGain},
           &ToneSound::gain_db},
          {{.key = "minnaert",
            .unit = "m/s",
            .meaning = "f0 r: the pitch f0 at birth of one of radius r is this over r",
            .min = 1.0,
            .max = 10.0,
            .source = std::string(kSection5) + ", after Minnaert 1933"},
           &ToneSound::minnaert},
          {{.key = "pitch",
            .unit = "1",
            .meaning = "times f0, whatever gave it: transposes",
            .min = 0.05,
            .max = 20.0},
           &ToneSound::pitch},
          {{.key = "radiation",
            .unit = "m/s",
            .meaning = "first term of the damping: d = radiation / r + thermal / r^1.5",
            .min = 0.01,
            .max = 2.0,
            .source = kSection5},
           &ToneSound::radiation},
          {{.key = "thermal",
            .unit = "m^1.5/s",
            .meaning = "second term of the damping",
            .min = 0.0005,
            .max = 0.1,
            .source = kSection5},
           &ToneSound::thermal},
          {{.key = "damping",
            .unit = "1",
            .meaning = "times d, whatever gave it: 2 rings half as long",
            .min = 0.1,
            .max = 20.0},
           &ToneSound::damping},
          {{.key = "rise",
            .unit = "1",
            .meaning = "the phase is 2 pi f0 t (1 + rise d t): half of it where f0 (1 + rise d t) "
                       "is to be the pitch that is heard",
            .min = 0.0,
            .max = 1.0,
            .source = std::string(kSection5) + ": xi"},
           &ToneSound::rise},
          {{.key = "excitation",
            .unit = "1",
            .meaning = "the amplitude is epsilon^excitation r: under 1 weak ones come nearer to "
                       "strong ones",
            .min = 0.1,
            .max = 3.0,
            .source = "paper, section 5.2"},
           &ToneSound::excitation},
          {{.key = "physical",
            .unit = "1",
            .meaning = "0: f0 and d are the paper's; 1: those of linear theory (Minnaert, heat, "
                       "surface tension, depth); between: mixed",
            .min = 0.0,
            .max = 1.0},
           &ToneSound::physical},
          {{.key = "place",
            .unit = "1",
            .meaning = "0: the same everywhere; 1: f0 is higher near the surface and lower near a "
                       "floor, and the pitch rises only as the bubble does, instead of by `rise`; "
                       "between: mixed. It takes --water-level and --floor-level",
            .min = 0.0,
            .max = 1.0,
            .source = "Strasberg 1953, Mendelson 1967"},
           &ToneSound::place}};
}

/// The burst, and its amplitude by a power of the speed.
std::vector<Field<ImpactSound>> burst_fields() {
  return {
      {{.key = "gain_db",
        .unit = "dB",
        .meaning = "gain of all impacts",
        .min = kLeastGain,
        .max = kMostGain},
       &ImpactSound::gain_db},
      {{.key = "amplitude",
        .unit = "m",
        .meaning = "amplitude at 1 m/s: the signal's standard deviation at the top of its envelope",
        .min = 1e-6,
        .max = 0.1,
        .source = "ours: -26 dB of the rigs' full scale"},
       &ImpactSound::amplitude},
      {{.key = "exponent",
        .unit = "1",
        .meaning = "the amplitude grows as the speed to this power",
        .min = 0.0,
        .max = 6.0,
        .source = "paper, section 5.1.2"},
       &ImpactSound::exponent},
      {{.key = "sliding",
        .unit = "1",
        .meaning = "part of the speed along the surface that counts as speed into it: at 0 a hand "
                   "that slides is silent",
        .min = 0.0,
        .max = 1.0},
       &ImpactSound::sliding},
      {{.key = "attack",
        .unit = "s",
        .meaning = "the envelope rises to within 60 dB of its top",
        .min = 0.0001,
        .max = 0.1,
        .source = kSection6},
       &ImpactSound::attack},
      {{.key = "release",
        .unit = "s",
        .meaning = "and falls by 60 dB",
        .min = 0.01,
        .max = 5.0,
        .source = kSection6},
       &ImpactSound::release},
      {{.key = "frequency",
        .unit = "Hz",
        .meaning = "middle of the resonance that colours the noise",
        .min = 20.0,
        .max = 2000.0,
        .source = kSection6},
       &ImpactSound::frequency},
      {{.key = "q",
        .unit = "1",
        .meaning = "its frequency over its width at -3 dB; the larger, the longer it rings",
        .min = 0.6,
        .max = 50.0,
        .source = "ours: the paper gives none"},
       &ImpactSound::q}};
}

/// Its amplitude by what is felt.
std::vector<Field<ImpactSound>> felt_fields() {
  return {
      {{.key = "sensation",
        .unit = "1",
        .meaning = "0: the amplitude is that of the two rows above; 1: what is felt grows evenly "
                   "with the logarithm of the speed, as the four rows below say; between: mixed "
                   "in decibels",
        .min = 0.0,
        .max = 1.0},
       &ImpactSound::sensation},
      {{.key = "slow",
        .unit = "m/s",
        .meaning = "at this speed it is felt as slow_db says",
        .min = 0.001,
        .max = 1.0,
        .source = "scenes' detect.impact_speed: no scene sends slower ones"},
       &ImpactSound::slow},
      {{.key = "slow_db",
        .unit = "dB",
        .meaning = "loudest third-octave band of its first 125 ms, over the threshold of touch "
                   "that the rig states",
        .min = -20.0,
        .max = 60.0,
        .source = "just felt: a vibration twice as strong as the weakest that is"},
       &ImpactSound::slow_db},
      {{.key = "fast",
        .unit = "m/s",
        .meaning = "at this speed it is felt as fast_db says",
        .min = 1.1,
        .max = 100.0,
        .source = "a hand that strikes"},
       &ImpactSound::fast},
      {{.key = "fast_db",
        .unit = "dB",
        .meaning = "the same as slow_db",
        .min = -20.0,
        .max = 60.0,
        .source = "strong, and short of the ceiling of the shipped rigs"},
       &ImpactSound::fast_db}};
}

std::vector<Field<ImpactSound>> fields(const ImpactSound& /*part*/, const std::string& /*name*/) {
  std::vector<Field<ImpactSound>> all = burst_fields();
  for (auto&& field : felt_fields()) all.push_back(std::move(field));
  return all;
}

std::vector<Field<CloudSound>> fields(const CloudSound& /*part*/, const std::string& /*name*/) {
  return {{{.key = "coupling",
            .unit = "1",
            .meaning = "0: each bubble sounds as if it were alone; 1: those around it lower its "
                       "pitch at birth, so that dense clouds sound darker; between: their part",
            .min = 0.0,
            .max = 1.0,
            .source = "Xue, Aronson, Wang, Langlois, James 2023"},
           &CloudSound::coupling},
          {{.key = "company",
            .unit = "s",
            .meaning = "a bubble counts for others so long after its birth",
            .min = 0.001,
            .max = 1.0,
            .source = "ours: until most have rung"},
           &CloudSound::company},
          {{.key = "singles",
            .unit = "1/s",
            .meaning = "bubbles a second that sound one by one; where a tenth more than this are "
                       "born, counted over 0.1 s, all others sound together, as noise of the "
                       "same level and colour",
            .min = 100.0,
            .max = 1e6,
            .source = "ours: more than 2,000 cannot be distinguished from noise"},
           &CloudSound::singles}};
}

std::vector<Field<FineSound>> fields(const FineSound& /*part*/, const std::string& /*name*/) {
  return {
      {{.key = "amount",
        .unit = "1",
        .meaning = "0: none; 1: the bubbles that are too small for the simulator as a noise from "
                   "1 to 16 kHz, on outputs that reach there, as loud as measured sizes have it",
        .min = 0.0,
        .max = 10.0,
        .source = "Deane, Stokes 2002"},
       &FineSound::amount},
      {{.key = "attack",
        .unit = "s",
        .meaning = "time constant within which they follow a bubble of the simulator's",
        .min = 0.0005,
        .max = 0.2,
        .source = "ours: within the splash that makes both"},
       &FineSound::attack},
      {{.key = "release",
        .unit = "s",
        .meaning = "time constant with which their power falls",
        .min = 0.002,
        .max = 2.0,
        .source = "ours, same"},
       &FineSound::release}};
}

std::vector<Field<FootSound>> fields(const FootSound& /*part*/, const std::string& /*name*/) {
  return {
      {{.key = "texture",
        .unit = "m",
        .meaning = "amplitude of the noise under a body where the force on it changes by 1 kN/s "
                   "(a sole that meets the water at 1 m/s: 13 kN/s), on outputs that are felt; "
                   "0: none",
        .min = 0.0,
        .max = 0.01,
        .source = "Visell, Giordano, Millet, Cooperstock 2011"},
       &FootSound::texture},
      {{.key = "power",
        .unit = "1",
        .meaning = "it grows as the change of force to this power: at a third as the speed of "
                   "what meets the water",
        .min = 0.05,
        .max = 2.0},
       &FootSound::power},
      {{.key = "frequency",
        .unit = "Hz",
        .meaning = "middle of the noise",
        .min = 20.0,
        .max = 1000.0,
        .source = "50 to 300 Hz, where soles feel best"},
       &FootSound::frequency},
      {{.key = "q",
        .unit = "1",
        .meaning = "its frequency over its width at -3 dB",
        .min = 0.3,
        .max = 20.0},
       &FootSound::q},
      {{.key = "attack",
        .unit = "s",
        .meaning = "time constant within which it follows the force",
        .min = 0.0005,
        .max = 0.2},
       &FootSound::attack},
      {{.key = "release",
        .unit = "s",
        .meaning = "time constant with which it falls",
        .min = 0.005,
        .max = 2.0},
       &FootSound::release},
      {{.key = "wash",
        .unit = "m",
        .meaning = "amplitude of slow swells under a body, by the same law, for beaches and "
                   "shoes; 0: none",
        .min = 0.0,
        .max = 0.01},
       &FootSound::wash},
      {{.key = "wash_frequency",
        .unit = "Hz",
        .meaning = "the swells are noise under this",
        .min = 5.0,
        .max = 60.0},
       &FootSound::wash_frequency},
      {{.key = "wash_release",
        .unit = "s",
        .meaning = "time constant with which they fall",
        .min = 0.05,
        .max = 5.0},
       &FootSound::wash_release},
      {{.key = "least",
        .unit = "N/s",
        .meaning = "where the simulator tells the force on a body (--forces), so much of its "
                   "change is the solver's own noise and not felt",
        .min = 0.0,
        .max = 1e5,
        .source =
            "ours: on a disc of 15 cm at rest it changed by 3 N/s at most, in a swing of 2 cm "
            "by 650"},
       &FootSound::least}};
}

}  // namespace

std::vector<Field<NamedSound>> sound_fields() {
  return {{{.key = "name", .unit = "", .meaning = "what the sound is called", .required = true},
           &NamedSound::name},
          {{.key = "description", .unit = "", .meaning = "one line for lists"},
           &NamedSound::description}};
}

template <class Part>
std::vector<Field<Part>> fields_of(const Part& part, const std::string& name) {
  return fields(part, name);
}
template std::vector<Field<ImpactSound>> fields_of(const ImpactSound&, const std::string&);
template std::vector<Field<ToneSound>> fields_of(const ToneSound&, const std::string&);
template std::vector<Field<CloudSound>> fields_of(const CloudSound&, const std::string&);
template std::vector<Field<FineSound>> fields_of(const FineSound&, const std::string&);
template std::vector<Field<FootSound>> fields_of(const FootSound&, const std::string&);

namespace {

/// Whoever confuses the kinds of files is told so, not that a key is unknown.
void refuse_others(const program::ConfigMap& map) {
  for (const char* key : {"tank", "fluid", "outputs"}) {
    if (!map.has(key)) continue;
    throw map.error(key, std::string(std::string(key) == "outputs"
                                         ? "this is a rig, which says what is driven (--rig)"
                                         : "this is a scene, which is sim-server's (--scene)") +
                             "; a sound is wanted here, which says how water sounds, e.g. "
                             "configs/sounds/cirio2013.yaml");
  }
}

NamedSound read_map(const program::ConfigMap& map) {
  refuse_others(map);
  NamedSound sound;
  std::vector<std::string> parts;
  each_part(sound.sound, [&](const char* name, auto&) { parts.emplace_back(name); });
  map.read(sound_fields(), parts, sound);
  each_part(sound.sound, [&](const char* name, auto& part) {
    if (const auto child = map.optional_child(name)) child->read(fields_of(part, name), {}, part);
  });
  return sound;
}

}  // namespace

NamedSound read_sound(const std::filesystem::path& path) {
  return read_map(program::ConfigMap::load(path));
}

NamedSound parse_sound(const std::string& text, const std::string& file_name) {
  return read_map(program::ConfigMap::parse(text, file_name));
}

}  // namespace splash::synth
