// SPDX-License-Identifier: MIT
#include "tests/bench/synth_charts.hpp"

#include <fstream>
#include <stdexcept>

#include "synth-server/figure/gnuplot.hpp"

namespace splash::bench {
namespace {

std::ofstream open_file(const std::filesystem::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error(path.string() + " cannot be written");
  return file;
}

void write_engine(std::ofstream& file, const char* sweep, const std::vector<EngineCase>& cases) {
  for (const EngineCase& c : cases) {
    file << sweep << ',' << c.precision << ',' << c.instructions << ',' << c.voices << ','
         << (c.tiles > 0 ? c.tiles * c.tiles : 1) << ',' << c.block << ',' << c.routes << ','
         << c.cost << ',' << c.voices_per_core() << '\n';
  }
}

/// "x y" lines as a gnuplot data block.
template <class Y>
void write_block(std::ofstream& out, const std::string& name, const std::vector<EngineCase>& cases,
                 const std::string& precision, const Y& x_and_y) {
  out << '$' << name << " << EOD\n";
  for (const EngineCase& c : cases) {
    if (c.precision != precision) continue;
    const auto [x, y] = x_and_y(c);
    out << x << ' ' << y << '\n';
  }
  out << "EOD\n";
}

void write_algorithm_chart(const SynthFigures& figures, const std::filesystem::path& script) {
  std::ofstream out = open_file(script);
  out << "set terminal pngcairo size 1100,700\nset output '"
      << std::filesystem::path(script).replace_extension("png").string()
      << "'\n"
         "set title 'A bubble, every way tried: one core, 44.1 kHz, largest error of radii from "
         "1 mm to 0.3 m'\n"
         "set logscale x\nset xlabel 'voices per core in real time'\n"
         "set ylabel 'largest error [dB re A0]'\nset xrange [500:500000]\nset yrange [-170:200]\n"
         "set grid\nset key outside\n";
  for (const char* set : {"portable", "AVX2", "AVX-512"}) {
    out << "$" << set[0] << (set[3] == '2' ? "2" : "") << (set[3] == '-' ? "5" : "") << " << EOD\n";
    for (const Algorithm& a : figures.algorithms) {
      if (a.instructions == set) {
        out << a.voices << ' ' << a.error_db << " \"" << a.name << "\"\n";
      }
    }
    out << "EOD\n";
  }
  out << "$one << EOD\n";
  for (const Algorithm& a : figures.algorithms) {
    if (a.name.starts_with("double"))
      out << a.voices << ' ' << a.error_db << " \"" << a.name << "\"\n";
  }
  out << "EOD\n$peers << EOD\n";
  for (const Peer& peer : figures.peers) {
    out << peer.voices << ' ' << peer.error_db << " \"" << peer.name << "\"\n";
  }
  out << "EOD\nset arrow from graph 0, first -90 to graph 1, first -90 nohead dashtype 2\n";
  out << "plot '$p' with points pt 7 lc 1 title 'portable', '$one' with labels left offset 1,0 "
         "notitle, '$A2' with points pt 7 lc 2 title 'AVX2', '$A5' with points pt 7 lc 3 title "
         "'AVX-512', '$A5' with labels left offset 1,0 notitle, '$peers' with points pt 5 lc 4 "
         "title 'others (5 mm)', '$peers' with labels left offset 1,0 notitle\n";
}

void write_engine_chart(const SynthFigures& figures, const std::filesystem::path& script) {
  std::ofstream out = open_file(script);
  for (const char* precision : {"fast", "exact"}) {
    const std::string tag(1, precision[0]);
    write_block(out, "voices_" + tag, figures.by_voices, precision, [](const EngineCase& c) {
      return std::pair(static_cast<double>(c.voices), 100.0 * c.cost);
    });
    write_block(out, "channels_" + tag, figures.by_channels, precision, [](const EngineCase& c) {
      return std::pair(c.tiles > 0 ? c.tiles * c.tiles : 1, 100.0 * c.cost);
    });
    write_block(out, "block_" + tag, figures.by_block, precision, [](const EngineCase& c) {
      return std::pair(static_cast<double>(c.block), 100.0 * c.cost);
    });
  }
  out << "set terminal pngcairo size 1500,500\nset output '"
      << std::filesystem::path(script).replace_extension("png").string()
      << "'\nset grid\n"
         "set multiplot layout 1,3\nset logscale x 2\nset ylabel 'of one core [%]'\n"
         "set key bottom right\nset logscale y\nset xtics 1,4\n"
         "set xlabel 'voices (mono)'\nplot '$voices_f' with linespoints title 'fast', '$voices_e' "
         "with linespoints title 'exact'\nunset logscale y\nset yrange [0:*]\n"
         "set xtics autofreq\n"
         "set xlabel 'channels (16384 voices)'\nplot '$channels_f' with linespoints title 'fast', "
         "'$channels_e' with linespoints title 'exact'\n"
         "set xlabel 'block [frames] (16384 voices, mono)'\nplot '$block_f' with linespoints title "
         "'fast', '$block_e' with linespoints title 'exact'\nunset multiplot\n";
}

}  // namespace

void write_tables(const SynthFigures& figures, const std::filesystem::path& folder) {
  std::ofstream algorithms = open_file(folder / "algorithms.csv");
  algorithms << "algorithm,instructions,voices_per_core,largest_error_db\n";
  for (const Algorithm& a : figures.algorithms) {
    algorithms << a.name << ',' << a.instructions << ',' << a.voices << ',' << a.error_db << '\n';
  }
  for (const Limit& limit : figures.limits) {
    algorithms << "arithmetic alone," << limit.instructions << ',' << limit.voices << ",\n";
  }
  std::ofstream engine = open_file(folder / "engine.csv");
  engine << "sweep,precision,instructions,voices,channels,block,channels_per_voice,cost,"
            "voices_per_core\n";
  write_engine(engine, "capacity", figures.capacity);
  write_engine(engine, "voices", figures.by_voices);
  write_engine(engine, "channels", figures.by_channels);
  write_engine(engine, "block", figures.by_block);
  std::ofstream onsets = open_file(folder / "onsets.csv");
  onsets << "precision,instructions,channels,onsets_per_second,voices\n";
  for (const OnsetCase& c : figures.onsets) {
    onsets << c.precision << ',' << c.instructions << ',' << (c.tiles > 0 ? c.tiles * c.tiles : 1)
           << ',' << c.onsets << ',' << c.voices << '\n';
  }
  std::ofstream peers = open_file(folder / "peers.csv");
  peers << "engine,voices_per_core,onsets_per_second,error_db\n";
  for (const Peer& peer : figures.peers) {
    peers << peer.name << ',' << peer.voices << ',' << peer.onsets << ',' << peer.error_db << '\n';
  }
}

void draw_charts(const SynthFigures& figures, const std::filesystem::path& folder) {
  write_algorithm_chart(figures, folder / "algorithms.gp");
  synth::run_gnuplot(folder / "algorithms.gp");
  write_engine_chart(figures, folder / "engine.gp");
  synth::run_gnuplot(folder / "engine.gp");
}

}  // namespace splash::bench
