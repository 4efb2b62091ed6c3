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
    file << sweep << ',' << c.instructions << ',' << c.voices << ','
         << (c.tiles > 0 ? c.tiles * c.tiles : 1) << ',' << c.block << ',' << c.routes << ','
         << c.cost << ',' << c.voices_per_core() << '\n';
  }
}

/// "x y" lines as a gnuplot data block.
template <class Y>
void write_block(std::ofstream& out, const std::string& name, const std::vector<EngineCase>& cases,
                 const Y& x_and_y) {
  out << '$' << name << " << EOD\n";
  for (const EngineCase& c : cases) {
    const auto [x, y] = x_and_y(c);
    out << x << ' ' << y << '\n';
  }
  out << "EOD\n";
}

void write_engine_chart(const SynthFigures& figures, const std::filesystem::path& script) {
  std::ofstream out = open_file(script);
  write_block(out, "voices", figures.by_voices, [](const EngineCase& c) {
    return std::pair(static_cast<double>(c.voices), 100.0 * c.cost);
  });
  write_block(out, "channels", figures.by_channels, [](const EngineCase& c) {
    return std::pair(c.tiles > 0 ? c.tiles * c.tiles : 1, 100.0 * c.cost);
  });
  write_block(out, "block", figures.by_block, [](const EngineCase& c) {
    return std::pair(static_cast<double>(c.block), 100.0 * c.cost);
  });
  out << "set terminal pngcairo size 1500,500\nset output '"
      << std::filesystem::path(script).replace_extension("png").string()
      << "'\nset grid\nunset key\n"
         "set multiplot layout 1,3\nset logscale x 2\nset ylabel 'of one core [%]'\n"
         "set logscale y\nset xtics 1,4\n"
         "set xlabel 'voices (mono)'\nplot '$voices' with linespoints\n"
         "unset logscale y\nset yrange [0:*]\nset xtics autofreq\n"
         "set xlabel 'channels (16384 voices)'\nplot '$channels' with linespoints\n"
         "set xlabel 'block [frames] (16384 voices, mono)'\nplot '$block' with linespoints\n"
         "unset multiplot\n";
}

}  // namespace

void write_tables(const SynthFigures& figures, const std::filesystem::path& folder) {
  std::ofstream engine = open_file(folder / "engine.csv");
  engine << "sweep,instructions,voices,channels,block,channels_per_voice,cost,"
            "voices_per_core\n";
  write_engine(engine, "capacity", figures.capacity);
  write_engine(engine, "voices", figures.by_voices);
  write_engine(engine, "channels", figures.by_channels);
  write_engine(engine, "block", figures.by_block);
  std::ofstream onsets = open_file(folder / "onsets.csv");
  onsets << "instructions,channels,onsets_per_second,voices\n";
  for (const OnsetCase& c : figures.onsets) {
    onsets << c.instructions << ',' << (c.tiles > 0 ? c.tiles * c.tiles : 1) << ',' << c.onsets
           << ',' << c.voices << '\n';
  }
  std::ofstream peers = open_file(folder / "peers.csv");
  peers << "engine,voices_per_core,onsets_per_second,error_db\n";
  for (const Peer& peer : figures.peers) {
    peers << peer.name << ',' << peer.voices << ',' << peer.onsets << ',' << peer.error_db << '\n';
  }
}

void draw_chart(const SynthFigures& figures, const std::filesystem::path& folder) {
  write_engine_chart(figures, folder / "engine.gp");
  synth::run_gnuplot(folder / "engine.gp");
}

}  // namespace splash::bench
