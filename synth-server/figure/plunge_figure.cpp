// SPDX-License-Identifier: MIT
#include "synth-server/figure/plunge_figure.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "synth-server/figure/gnuplot.hpp"
#include "synth-server/figure/spectrogram.hpp"

namespace splash::synth {

namespace {

/// What a plunge looks like in the paper's Figure 3.
constexpr std::string_view kCaption =
    "Each plunge: first the impact, a short burst at all frequencies; then bubbles, brief and the "
    "smaller the higher; then the cavity, one long low tone that rises.";

constexpr std::size_t kPlotColumns = 1280;  // width of the plots in the picture [pixels]

// Colours that people with colour blindness tell apart: Okabe and Ito 2008.
constexpr std::string_view kColours = R"gp(
impact_colour = "#d55e00"
bubble_colour = "#0072b2"
cavity_colour = "#009e73"
played_colour = "#c3c8d0"
)gp";

constexpr std::string_view kSignalPanel = R"gp(
set tmargin at screen 0.895
set bmargin at screen 0.590
set label 1 figure_title at screen 0.075, 0.958 left noenhanced \
    font "DejaVu Sans Bold,19" textcolor rgb ink
set label 2 subtitle at screen 0.075, 0.922 left font ",13" textcolor rgb "#6b7280"
set ylabel "amplitude  [full scale]" offset 0.2,0 textcolor rgb ink
set format x ""
set format y "%g"
set yrange [-peak:peak]
set grid ytics linecolor rgb "#cbd0d8" linewidth 0.6
set key at screen 0.915,0.9215 right center horizontal Left reverse samplen 1.1 width 1 \
  textcolor rgb ink
set style fill solid 0.62 noborder
plot "played.dat" using 1:(played ? $2 : 1/0):3 with filledcurves linecolor rgb played_colour \
       title (played ? "played" : ""), \
     "impact.dat" using 1:2:3 with filledcurves linecolor rgb impact_colour title "impact", \
     1/0 with filledcurves y=0 linecolor rgb bubble_colour title "bubbles", \
     "cavity.dat" using 1:2:3 with filledcurves linecolor rgb cavity_colour title "cavity", \
     "bubble.dat" using 1:2:3 with filledcurves linecolor rgb bubble_colour notitle, \
     "impact.dat" using 1:3 with lines linewidth 0.6 linecolor rgb impact_colour notitle, \
     "impact.dat" using 1:2 with lines linewidth 0.6 linecolor rgb impact_colour notitle, \
     "cavity.dat" using 1:3 with lines linewidth 0.6 linecolor rgb cavity_colour notitle, \
     "cavity.dat" using 1:2 with lines linewidth 0.6 linecolor rgb cavity_colour notitle, \
     "bubble.dat" using 1:3 with lines linewidth 0.6 linecolor rgb bubble_colour notitle, \
     "bubble.dat" using 1:2 with lines linewidth 0.6 linecolor rgb bubble_colour notitle
)gp";

constexpr std::string_view kSpectrogramPanel = R"gp(
unset label
unset key
unset grid
set style fill solid 1
set tmargin at screen 0.560
set bmargin at screen 0.115
set label 3 caption at screen 0.075, 0.022 left font ",13" textcolor rgb "#6b7280"
set ylabel "frequency  [Hz]" offset 0.2,0 textcolor rgb ink
set yrange [log10(lowest):log10(highest)]
set ytics ("10" 1, "20" log10(20), "50" log10(50), "100" 2, "200" log10(200), "500" log10(500), \
  "1000" 3, "2000" log10(2000), "5000" log10(5000), "10000" 4, "20000" log10(20000))
set cblabel "level  [dB, full-scale sine = 0]" offset 1,0 textcolor rgb ink
set colorbox user origin screen 0.928,0.115 size screen 0.013,0.445 noborder
plot "spectrogram.bin" binary array=(columns,rows) format="%float" \
     origin=(first_time,log10(lowest)) dx=dx dy=dy using 1 with image notitle
)gp";

void write_envelope(const std::filesystem::path& file, const std::vector<float>& signal,
                    const Components& components) {
  std::ofstream out(file);
  for (const Extent& extent : envelope(signal, components.sample_rate, kPlotColumns)) {
    out << components.start + extent.time << ' ' << extent.lowest << ' ' << extent.highest << '\n';
  }
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

float peak_of(const Components& components) {
  float peak = 0.0F;
  for (const auto* part :
       {&components.impact, &components.bubble, &components.cavity, &components.played}) {
    for (const float sample : *part) peak = std::max(peak, std::abs(sample));
  }
  return peak;
}

void write_data(const std::filesystem::path& folder, const Components& components,
                const Spectrogram& spectrum) {
  write_envelope(folder / "impact.dat", components.impact, components);
  write_envelope(folder / "bubble.dat", components.bubble, components);
  write_envelope(folder / "cavity.dat", components.cavity, components);
  write_envelope(folder / "played.dat", components.signal(), components);
  write_floats(folder / "spectrogram.bin", spectrum.level_db);
}

std::string subtitle(const Components& components) {
  std::ostringstream text;
  text << "channel " << components.channel << "  ·  " << components.sample_rate / 1000.0
       << " kHz  ·  Hann window of " << SpectrogramSettings{}.window * 1000.0 << " ms";
  return text.str();
}

/// The numbers of this picture as gnuplot variables.
std::string variables(const Components& components, const FigureSettings& settings,
                      const Spectrogram& spectrum) {
  const float top_db = *std::max_element(spectrum.level_db.begin(), spectrum.level_db.end());
  const double step_log =
      std::log10(settings.highest / settings.lowest) / static_cast<double>(spectrum.rows - 1);
  std::ostringstream text;
  text << "figure_title = " << quoted(settings.title) << '\n'
       << "subtitle = " << quoted(subtitle(components)) << '\n'
       << "caption = " << quoted(std::string(kCaption)) << '\n'
       << "played = " << (components.played.empty() ? 0 : 1) << '\n'
       << "peak = " << std::max(1.08F * peak_of(components), 1e-6F) << '\n'
       << "lowest = " << settings.lowest << "\nhighest = " << settings.highest << '\n'
       << "columns = " << spectrum.columns << "\nrows = " << spectrum.rows << '\n'
       << "first_time = " << spectrum.time.front() << '\n'
       << "dx = " << components.duration() / static_cast<double>(spectrum.columns) << '\n'
       << "dy = " << step_log << '\n'
       << "top_db = " << std::ceil(top_db / 5.0F) * 5.0F << '\n'
       << "range_db = " << settings.range_db << '\n'
       << "set xrange [" << components.start << ':' << components.start + components.duration()
       << "]\n";
  return text.str();
}

void write_script(const std::filesystem::path& script, const std::string& numbers,
                  const std::filesystem::path& png) {
  std::ofstream out(script);
  out << numbers << kCanvas << kColours << "set output " << quoted(png.string()) << '\n'
      << "set multiplot\n"
      << kSignalPanel << kLevels << kSpectrogramPanel << "unset multiplot\n";
  if (!out) throw std::runtime_error("cannot write " + script.string());
}

}  // namespace

void draw_plunge(const Components& components, const FigureSettings& settings,
                 const std::filesystem::path& png) {
  const Components part = cut(components, settings.from, settings.to);
  SpectrogramSettings spectrum_settings;
  spectrum_settings.from = part.start;
  spectrum_settings.to = part.start + part.duration();
  spectrum_settings.lowest = settings.lowest;
  spectrum_settings.highest = settings.highest;
  spectrum_settings.columns = kPlotColumns;
  const Spectrogram spectrum =
      spectrogram(components.signal(), components.sample_rate, spectrum_settings);
  const ScratchFolder folder;
  write_data(folder.path(), part, spectrum);
  const std::filesystem::path script = folder.path() / "plunge.gp";
  write_script(script,
               "cd " + quoted(folder.path().string()) + '\n' + variables(part, settings, spectrum),
               std::filesystem::absolute(png));
  run_gnuplot(script);
  if (!std::filesystem::exists(png)) throw GnuplotError("gnuplot wrote no " + png.string());
}

std::vector<Extent> envelope(std::span<const float> signal, double sample_rate,
                             std::size_t columns) {
  columns = std::min(columns, signal.size());
  std::vector<Extent> extents;
  extents.reserve(columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t first = c * signal.size() / columns;
    const std::size_t last = (c + 1) * signal.size() / columns;
    // One sample of the neighbour belongs to each column, so that the columns touch.
    const std::size_t shared = std::min(last + 1, signal.size());
    const auto part = signal.subspan(first, shared - first);
    const auto [lowest, highest] = std::minmax_element(part.begin(), part.end());
    extents.push_back(
        {static_cast<double>(first + last - 1) / 2.0 / sample_rate, *lowest, *highest});
  }
  return extents;
}

}  // namespace splash::synth
