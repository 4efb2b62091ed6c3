// SPDX-License-Identifier: MIT
// The three engines on the same logs: what of the difference to synth-server's own rendering falls
// into which band, for scsynth (non-real-time) and for Pd (offline).
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "synth-server/output/biquad.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/report.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/supercollider/comparison.hpp"

namespace {

using namespace splash;
using Samples = std::vector<float>;

constexpr double kRate = 48000.0;
constexpr std::int64_t kFrames = 216000;
/// Lower ends of the bands [Hz]; the last is an upper end.
constexpr std::array kEdges = {20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0, 5120.0};
constexpr std::size_t kBands = kEdges.size() - 1;
using Energies = std::array<double, kBands>;

/// Adds the energy of a - b in each band.
void add_energy(const Samples& a, const Samples& b, Energies& energies) {
  for (std::size_t band = 0; band < kBands; ++band) {
    synth::BandFilter filter({kEdges[band], kEdges[band + 1]}, kRate);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double out = filter.process(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      energies[band] += out * out;
    }
  }
}

struct Comparison {
  std::string engine;
  std::string scene;
  Energies signal{};
  Energies residual{};
  double worst = 0.0;  ///< largest difference over the largest sample [dB]
};

Comparison compare(const std::string& engine, const std::string& scene, const pd::Channels& ours,
                   const pd::Channels& theirs) {
  Comparison c{engine, scene};
  double peak = 0.0;
  for (std::size_t channel = 0; channel < ours.size(); ++channel) {
    add_energy(ours[channel], Samples(ours[channel].size()), c.signal);
    add_energy(ours[channel], theirs[channel], c.residual);
    for (const float sample : ours[channel]) {
      peak = std::max(peak, std::abs(static_cast<double>(sample)));
    }
  }
  c.worst = pd::decibels(pd::largest_difference(ours, theirs) / peak);
  return c;
}

std::vector<Comparison> compare_all() {
  std::vector<Comparison> all;
  for (const char* scene : supercollider::kScenes) {
    // Impacts are noise, which no two engines draw alike.
    const auto log = pd::tones(supercollider::scene_log(scene), HUGE_VAL);
    const auto both =
        supercollider::render_both(log, kFrames, supercollider::loud_gain(log, kFrames));
    all.push_back(compare("scsynth", scene, {both.synth}, {both.scsynth}));
    all.push_back(compare("pd", scene, pd::render_with_synth(log, pd::kTiles, kFrames),
                          pd::render_with_pd(log, pd::kTiles, kFrames)));
  }
  return all;
}

double level(double part, double whole) {
  return 10.0 * std::log10(std::max(part, 1e-30) / std::max(whole, 1e-30));
}

void report(bench::Bench& bench, const std::vector<Comparison>& all) {
  bench::Row head = {"engine", "scene", "largest sample [dB]"};
  for (std::size_t band = 0; band < kBands; ++band) {
    head.push_back("from " + bench::number(kEdges[band]) + " Hz");
  }
  auto table = bench.table("crosscheck.csv", head);
  bench::Plot plot(bench.out() / "crosscheck.png", 1000, 600);
  for (const Comparison& c : all) {
    bench::Row row = {c.engine, c.scene, bench::number(c.worst)};
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t band = 0; band < kBands; ++band) {
      x.push_back(kEdges[band]);
      y.push_back(level(c.residual[band], c.signal[band]));
      row.push_back(bench::number(y.back()));
    }
    table.add(row);
    plot.add({x, y}, "with linespoints title '" + c.engine + ", " + c.scene + "'");
  }
  bench.tell(
      "What of the difference to synth-server falls into which band, over the signal in it [dB]; "
      "the largest sample over the peak.");
  bench.tell(table);
  plot.script() << "set logscale x 2\nset xtics (20,40,80,160,320,640,1280)\nset yrange [-140:0]\n"
                << "set xlabel 'band, from [Hz]'\nset ylabel 'residual over signal [dB]'\n"
                << "set key outside\n";
  plot.draw();
}

}  // namespace

int main(int argc, char** argv) {
  bench::Bench bench("crosscheck", "accuracy.md", "The sound by three engines",
                     "Renders logs with synth-server, scsynth and Pd and compares them.");
  return bench.run(argc, argv, [&] {
    report(bench, compare_all());
    return true;
  });
}
