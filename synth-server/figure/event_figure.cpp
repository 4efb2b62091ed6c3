// SPDX-License-Identifier: MIT
#include "synth-server/figure/event_figure.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "protocol/event_log.hpp"
#include "synth-server/figure/gnuplot.hpp"

namespace splash::synth {
namespace {

constexpr std::size_t kColumns = 1280;  // width of the plots in the picture [pixels]

// Colours as in plunge_figure.cpp.
constexpr std::string_view kPanels = R"gp(
set multiplot
set label 1 figure_title at screen 0.075, 0.965 left noenhanced \
    font "DejaVu Sans Bold,19" textcolor rgb ink
set label 2 subtitle at screen 0.075, 0.932 left font ",13" textcolor rgb "#6b7280"
set tmargin at screen 0.905
set bmargin at screen 0.770
set format x ""
set ylabel "impacts  [m/s]" textcolor rgb ink
set yrange [0:*]
set ytics impact_step
set grid xtics linecolor rgb "#cbd0d8" linewidth 0.6
plot "impact.dat" using 1:2 with impulses linewidth 2 linecolor rgb "#d55e00" notitle
unset label
set tmargin at screen 0.745
set bmargin at screen 0.480
set ytics autofreq
set logscale y
set ylabel "radius  [mm]" textcolor rgb ink
set yrange [0.5:200]
set key at screen 0.915,0.740 right top horizontal Left reverse samplen 1 textcolor rgb ink
plot "bubble.dat" using 1:2 with points pointtype 7 pointsize 0.35 linecolor rgb "#0072b2" \
       title "bubbles", \
     "cavity.dat" using 1:2 with points pointtype 7 pointsize 1.3 linecolor rgb "#009e73" \
       title "cavities"
unset logscale y
unset key
)gp";

constexpr std::string_view kLevelPanel = R"gp(
unset grid
set tmargin at screen 0.455
set bmargin at screen 0.085
set ylabel "channel" textcolor rgb ink
set yrange [channels+0.5:0.5]
set ytics 1,channel_step
set cblabel "level  [dB, full scale = 0]" offset 1,0 textcolor rgb ink
set colorbox user origin screen 0.928,0.085 size screen 0.013,0.37 noborder
plot "levels.bin" binary array=(columns,channels) format="%float" origin=(0.5*dx,1) dx=dx dy=1 \
     using 1 with image notitle
unset multiplot
)gp";

/// A kind of event, and what of it is drawn.
struct Kind {
  const char* address;
  const char* many;
  const char* file;
  std::size_t value;  ///< its argument
  double scale;
  std::size_t offset;  ///< argument: moment after its bundle's time [ms]
};
constexpr Kind kKinds[] = {{"/impact", "impacts", "impact.dat", 3, 1.0, 7},
                           {"/bubble", "bubbles", "bubble.dat", 2, 1000.0, 7},
                           {"/cavity", "cavities", "cavity.dat", 2, 1000.0, 7}};

double number(const protocol::Message& message, std::size_t argument) {
  const auto* value = argument < message.arguments.size()
                          ? std::get_if<float>(&message.arguments[argument])
                          : nullptr;
  return value == nullptr ? 0.0 : static_cast<double>(*value);
}

struct Written {
  int count = 0;
  double largest = 0.0;  ///< of what is drawn
};

/// The events of a kind, a line each.
Written write_events(const std::filesystem::path& folder, const Kind& kind,
                     const std::vector<protocol::LogEntry>& log) {
  std::ofstream out(folder / kind.file);
  Written written;
  for (const protocol::LogEntry& entry : log) {
    for (const protocol::Message& message : entry.messages) {
      if (message.address != kind.address) continue;
      out << entry.seconds + 1e-3 * number(message, kind.offset) << ' '
          << kind.scale * number(message, kind.value) << '\n';
      ++written.count;
      written.largest = std::max(written.largest, kind.scale * number(message, kind.value));
    }
  }
  if (written.count == 0) out << "NaN NaN\n";  // gnuplot wants a line
  if (!out) throw std::runtime_error("cannot write " + (folder / kind.file).string());
  return written;
}

/// Between two marks of an axis from 0 to `largest`, so that there are three to six.
double step_to(double largest) {
  if (!(largest > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  if (largest < 2.0 * power) return 0.5 * power;
  return largest < 5.0 * power ? power : 2.0 * power;
}

}  // namespace

LevelMap level_map(const WavSignal& signal, std::size_t columns) {
  LevelMap map{columns, signal.channels.size(), {}};
  for (const std::vector<float>& channel : signal.channels) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t from = column * channel.size() / columns;
      const std::size_t to = std::max((column + 1) * channel.size() / columns, from + 1);
      double sum = 0.0;
      for (std::size_t i = from; i < std::min(to, channel.size()); ++i) {
        sum += static_cast<double>(channel[i]) * static_cast<double>(channel[i]);
      }
      const double power = sum / static_cast<double>(to - from);
      const auto level = static_cast<float>(10.0 * std::log10(std::max(power, 1e-30)));
      map.level_db.push_back(std::max(level, kLowestLevel));
    }
  }
  return map;
}

void draw_events(const EventFigure& figure, const std::filesystem::path& png) {
  const std::vector<protocol::LogEntry> log = protocol::read_log(figure.events);
  const WavSignal signal = read_wav(figure.levels);
  if (signal.frames() == 0) throw std::runtime_error(figure.levels.string() + " holds no sample");
  const double duration = static_cast<double>(signal.frames()) / signal.sample_rate;
  const LevelMap map = level_map(signal, kColumns);
  const ScratchFolder folder;
  std::ostringstream subtitle;
  double impact_step = 1.0;  // [m/s]
  for (const Kind& kind : kKinds) {
    const Written written = write_events(folder.path(), kind, log);
    if (&kind == &kKinds[0]) impact_step = step_to(written.largest);
    subtitle << written.count << ' ' << kind.many << "   ";
  }
  write_floats(folder.path() / "levels.bin", map.level_db);
  const float top = *std::max_element(map.level_db.begin(), map.level_db.end());
  const std::filesystem::path script = folder.path() / "events.gp";
  std::ofstream out(script);
  out << "cd " << quoted(folder.path().string()) << "\nfigure_title = " << quoted(figure.title)
      << "\nsubtitle = " << quoted(subtitle.str()) << "\ncolumns = " << map.columns
      << "\nchannels = " << map.channels << "\nchannel_step = " << (map.channels > 12 ? 5 : 1)
      << "\ndx = " << duration / static_cast<double>(kColumns)
      << "\ntop_db = " << std::ceil(top / 5.0F) * 5.0F << "\nrange_db = " << figure.range_db
      << "\nimpact_step = " << impact_step << "\nset xrange [0:" << duration << "]\n"
      << kCanvas << "set output " << quoted(std::filesystem::absolute(png).string()) << '\n'
      << kPanels << kLevels << kLevelPanel;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + script.string());
  run_gnuplot(script);
  if (!std::filesystem::exists(png)) throw GnuplotError("gnuplot wrote no " + png.string());
}

}  // namespace splash::synth
