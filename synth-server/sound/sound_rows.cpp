// SPDX-License-Identifier: MIT
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

using program::number_row;

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
  return {{number_row("gain_db", "dB", kLeastGain, kMostGain, "gain of all " + plural_of(name)),
           &ToneSound::gain_db},
          {number_row("minnaert", "m/s", 1.0, 10.0,
                      "f0 r: the pitch f0 at birth of one of radius r is this over r",
                      std::string(kSection5) + ", after Minnaert 1933"),
           &ToneSound::minnaert},
          {number_row("pitch", "1", 0.05, 20.0, "times f0, whatever gave it: transposes"),
           &ToneSound::pitch},
          {number_row("radiation", "m/s", 0.01, 2.0,
                      "first term of the damping: d = radiation / r + thermal / r^1.5", kSection5),
           &ToneSound::radiation},
          {number_row("thermal", "m^1.5/s", 0.0005, 0.1, "second term of the damping", kSection5),
           &ToneSound::thermal},
          {number_row("damping", "1", 0.1, 20.0, "times d, whatever gave it: 2 rings half as long"),
           &ToneSound::damping},
          {number_row("rise", "1", 0.0, 1.0,
                      "the phase is 2 pi f0 t (1 + rise d t): half of it where f0 (1 + rise d t) "
                      "is to be the pitch that is heard",
                      std::string(kSection5) + ": xi"),
           &ToneSound::rise},
          {number_row("excitation", "1", 0.1, 3.0,
                      "the amplitude is epsilon^excitation r: under 1 weak ones come nearer to "
                      "strong ones",
                      "paper, section 5.2"),
           &ToneSound::excitation},
          {number_row("physical", "1", 0.0, 1.0,
                      "0: f0 and d are the paper's; 1: those of linear theory (Minnaert, heat, "
                      "surface tension, depth); between: mixed"),
           &ToneSound::physical},
          {number_row("place", "1", 0.0, 1.0,
                      "0: the same everywhere; 1: f0 is higher near the surface and lower near a "
                      "floor, and the pitch rises only as the bubble does, instead of by `rise`; "
                      "between: mixed. It takes --water-level and --floor-level",
                      "Strasberg 1953, Mendelson 1967"),
           &ToneSound::place}};
}

/// The burst, its amplitude by a power of the speed and then by what is felt.
std::vector<Field<ImpactSound>> fields(const ImpactSound& /*part*/, const std::string& /*name*/) {
  return {
      {number_row("gain_db", "dB", kLeastGain, kMostGain, "gain of all impacts"),
       &ImpactSound::gain_db},
      {number_row("amplitude", "m", 1e-6, 0.1,
                  "amplitude at 1 m/s: the signal's standard deviation at the top of its envelope",
                  "ours: -26 dB of the rigs' full scale"),
       &ImpactSound::amplitude},
      {number_row("exponent", "1", 0.0, 6.0, "the amplitude grows as the speed to this power",
                  "paper, section 5.1.2"),
       &ImpactSound::exponent},
      {number_row("sliding", "1", 0.0, 1.0,
                  "part of the speed along the surface that counts as speed into it: at 0 a hand "
                  "that slides is silent"),
       &ImpactSound::sliding},
      {number_row("attack", "s", 0.0001, 0.1, "the envelope rises to within 60 dB of its top",
                  kSection6),
       &ImpactSound::attack},
      {number_row("release", "s", 0.01, 5.0, "and falls by 60 dB", kSection6),
       &ImpactSound::release},
      {number_row("frequency", "Hz", 20.0, 2000.0, "middle of the resonance that colours the noise",
                  kSection6),
       &ImpactSound::frequency},
      {number_row("q", "1", 0.6, 50.0,
                  "its frequency over its width at -3 dB; the larger, the longer it rings",
                  "ours: the paper gives none"),
       &ImpactSound::q},
      {number_row("sensation", "1", 0.0, 1.0,
                  "0: the amplitude is that of the two rows above; 1: what is felt grows evenly "
                  "with the logarithm of the speed, as the four rows below say; between: mixed "
                  "in decibels"),
       &ImpactSound::sensation},
      {number_row("slow", "m/s", 0.001, 1.0, "at this speed it is felt as slow_db says",
                  "scenes' detect.impact_speed: no scene sends slower ones"),
       &ImpactSound::slow},
      {number_row("slow_db", "dB", -20.0, 60.0,
                  "loudest third-octave band of its first 125 ms, over the threshold of touch "
                  "that the rig states",
                  "just felt: a vibration twice as strong as the weakest that is"),
       &ImpactSound::slow_db},
      {number_row("fast", "m/s", 1.1, 100.0, "at this speed it is felt as fast_db says",
                  "a hand that strikes"),
       &ImpactSound::fast},
      {number_row("fast_db", "dB", -20.0, 60.0, "the same as slow_db",
                  "strong, and short of the ceiling of the shipped rigs"),
       &ImpactSound::fast_db}};
}

std::vector<Field<CloudSound>> fields(const CloudSound& /*part*/, const std::string& /*name*/) {
  return {
      {number_row("coupling", "1", 0.0, 1.0,
                  "0: each bubble sounds as if it were alone; 1: those around it lower its "
                  "pitch at birth, so that dense clouds sound darker; between: their part",
                  "Xue, Aronson, Wang, Langlois, James 2023"),
       &CloudSound::coupling},
      {number_row("company", "s", 0.001, 1.0, "a bubble counts for others so long after its birth",
                  "ours: until most have rung"),
       &CloudSound::company},
      {number_row("singles", "1/s", 100.0, 1e6,
                  "bubbles a second that sound one by one; where a tenth more than this are "
                  "born, counted over 0.1 s, all others sound together, as noise of the "
                  "same level and colour",
                  "ours: more than 2,000 cannot be distinguished from noise"),
       &CloudSound::singles}};
}

std::vector<Field<FineSound>> fields(const FineSound& /*part*/, const std::string& /*name*/) {
  return {
      {number_row("amount", "1", 0.0, 10.0,
                  "0: none; 1: the bubbles that are too small for the simulator as a noise from "
                  "1 to 16 kHz, on outputs that reach there, as loud as measured sizes have it",
                  "Deane, Stokes 2002"),
       &FineSound::amount},
      {number_row("attack", "s", 0.0005, 0.2,
                  "time constant within which they follow a bubble of the simulator's",
                  "ours: within the splash that makes both"),
       &FineSound::attack},
      {number_row("release", "s", 0.002, 2.0, "time constant with which their power falls",
                  "ours, same"),
       &FineSound::release}};
}

std::vector<Field<FootSound>> fields(const FootSound& /*part*/, const std::string& /*name*/) {
  return {
      {number_row("texture", "m", 0.0, 0.01,
                  "amplitude of the noise under a body where the force on it changes by 1 kN/s "
                  "(a sole that meets the water at 1 m/s: 13 kN/s), on outputs that are felt; "
                  "0: none",
                  "Visell, Giordano, Millet, Cooperstock 2011"),
       &FootSound::texture},
      {number_row("power", "1", 0.05, 2.0,
                  "it grows as the change of force to this power: at a third as the speed of "
                  "what meets the water"),
       &FootSound::power},
      {number_row("frequency", "Hz", 20.0, 1000.0, "middle of the noise",
                  "50 to 300 Hz, where soles feel best"),
       &FootSound::frequency},
      {number_row("q", "1", 0.3, 20.0, "its frequency over its width at -3 dB"), &FootSound::q},
      {number_row("attack", "s", 0.0005, 0.2, "time constant within which it follows the force"),
       &FootSound::attack},
      {number_row("release", "s", 0.005, 2.0, "time constant with which it falls"),
       &FootSound::release},
      {number_row("wash", "m", 0.0, 0.01,
                  "amplitude of slow swells under a body, by the same law, for beaches and "
                  "shoes; 0: none"),
       &FootSound::wash},
      {number_row("wash_frequency", "Hz", 5.0, 60.0, "the swells are noise under this"),
       &FootSound::wash_frequency},
      {number_row("wash_release", "s", 0.05, 5.0, "time constant with which they fall"),
       &FootSound::wash_release},
      {number_row(
           "least", "N/s", 0.0, 1e5,
           "where the simulator tells the force on a body (--forces), so much of its "
           "change is the solver's own noise and not felt",
           "ours: on a disc of 15 cm at rest it changed by 3 N/s at most, in a swing of 2 cm "
           "by 650"),
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
