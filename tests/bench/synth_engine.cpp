// SPDX-License-Identifier: MIT
#include "tests/bench/synth_engine.hpp"

#include <cmath>
#include <stdexcept>

#include "synth-server/render/routing.hpp"
#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/cloud.hpp"
#include "tests/bench/synth_timing.hpp"

namespace splash::bench {
namespace {

using synth::Engine;
using synth::EngineSettings;
using synth::Output;
using synth::Rig;

constexpr double kRate = 44100.0;
constexpr int kRuns = 5;

/// Reproducible draws in [0, 1).
class Draw {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_ = 2026;
};

/// `full_scale` [m]
Rig rig_of(int tiles, double full_scale) {
  Output output;
  output.name = "out";
  output.band = {1.0, 20000.0};
  output.full_scale = full_scale;
  if (tiles > 0) {
    output.kind = synth::OutputKind::tiles;
    output.tiles_x = tiles;
    output.tiles_y = tiles;
  }
  Rig rig;
  rig.name = "bench";
  rig.outputs = {output};
  return rig;
}

EngineSettings settings_of(const std::string& instructions, int voices) {
  EngineSettings settings;
  settings.sample_rate = kRate;
  settings.start_ramp = 0.0;
  settings.max_voices = voices;
  settings.max_scheduled = 1 << 18;
  settings.instructions = instructions == "portable"  ? synth::InstructionSet::portable
                          : instructions == "AVX2"    ? synth::InstructionSet::avx2
                          : instructions == "AVX-512" ? synth::InstructionSet::avx512
                                                      : synth::InstructionSet::best;
  return settings;
}

protocol::Vec3 place(Draw& draw, int tiles) {
  const double edge = 0.305 * tiles;
  return {static_cast<float>(edge * draw()), static_cast<float>(edge * draw()), 0.0F};
}

/// Blocks without end.
class Player {
 public:
  Player(Engine& engine, int block) : engine_(engine), block_(block) {
    for (int c = 0; c < engine.channels(); ++c) out_.emplace_back(static_cast<std::size_t>(block));
    for (auto& channel : out_) pointers_.push_back(channel.data());
  }
  void play(std::int64_t frames) {
    for (std::int64_t done = 0; done < frames; done += block_) {
      engine_.render(pointers_.data(), block_);
      consume(out_[0].data());
    }
  }

 private:
  Engine& engine_;
  int block_;
  std::vector<std::vector<float>> out_;
  std::vector<float*> pointers_;
};

double mean_routes(const Rig& rig, int tiles) {
  synth::Routing routing(rig, {});
  std::vector<synth::Route> routes(static_cast<std::size_t>(routing.max_routes()));
  Draw draw;
  double sum = 0.0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    sum += routing.route({place(draw, tiles), -1, 100.0}, routes).routes;
  }
  return sum / kDraws;
}

}  // namespace

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const auto set : {synth::InstructionSet::portable, synth::InstructionSet::avx2,
                         synth::InstructionSet::avx512}) {
    if (available(set) == set) names.emplace_back(name_of(set));
  }
  return names;
}

EngineCase measure_engine(EngineCase wanted, double seconds) {
  const Rig rig = rig_of(wanted.tiles, 100.0);  // no limiter acts, no voice ends early
  wanted.routes = mean_routes(rig, wanted.tiles);
  const auto settings = settings_of(wanted.instructions, std::max(1, wanted.voices));
  const auto measured = [&](int voices) {
    Engine engine(rig, settings);
    Draw draw;
    for (int i = 0; i < voices; ++i) {  // 0.1 to 0.3 m: they last for seconds
      protocol::Bubble bubble;
      bubble.radius = static_cast<float>(0.1 + 0.2 * draw());
      bubble.epsilon = 0.1F;
      bubble.position = place(draw, wanted.tiles);
      engine.schedule({bubble, i / 256 * 64});
    }
    Player player(engine, wanted.block);
    player.play(voices / 256 * 64 + 2 * synth::kCell);
    if (engine.counters().voices != static_cast<std::uint64_t>(voices)) {
      throw std::runtime_error("not all voices sound: " + std::to_string(engine.counters().voices));
    }
    const auto frames = static_cast<std::int64_t>(seconds * kRate);
    const double spent = median_time(kRuns, [&] { player.play(frames); });
    return spent /
           (static_cast<double>((frames + wanted.block - 1) / wanted.block) * wanted.block / kRate);
  };
  wanted.cost = measured(wanted.voices);
  return wanted;
}

namespace {

/// Radius of the bubble that falls by 60 dB in `life` [s], by bisection [m].
double radius_lasting(double life) {
  double low = 1e-4;
  double high = 0.1;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (6.91 / synth::paper_damping(middle) < life ? low : high) = middle;
  }
  return low;
}

/// Each of amplitude 10 um, which a rig of full scale 0.01 m forgets 60 dB later.
std::vector<protocol::Bubble> bubbles_of_10_to_300_ms(int count, int tiles) {
  Draw draw;
  std::vector<protocol::Bubble> bubbles;
  for (int i = 0; i < count; ++i) {
    const double radius = radius_lasting(0.010 * std::pow(30.0, draw()));
    protocol::Bubble bubble;
    bubble.radius = static_cast<float>(radius);
    bubble.epsilon = static_cast<float>(1e-5 / radius);
    bubble.position = place(draw, tiles);
    bubbles.push_back(bubble);
  }
  return bubbles;
}

}  // namespace

OnsetCase measure_onsets(const std::string& instructions, int tiles) {
  constexpr int kPerCell = 145;  // 100 000 per second
  constexpr int kCells = 345;    // half a second
  const Rig rig = rig_of(tiles, 0.01);
  const auto bubbles = bubbles_of_10_to_300_ms(20000, tiles);
  OnsetCase result{instructions, tiles};
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    Engine engine(rig, settings_of(instructions, 65536));
    Player player(engine, synth::kCell);
    std::size_t next = 0;
    double spent = 0.0;
    result.voices = 0.0;
    for (int cell = 0; cell < 2 * kCells; ++cell) {  // the first half fills the pool
      const double start = cpu_seconds();
      for (int i = 0; i < kPerCell; ++i) {
        engine.schedule({bubbles[next++ % bubbles.size()], engine.clock() + i % synth::kCell});
      }
      player.play(synth::kCell);
      if (cell < kCells) continue;
      spent += cpu_seconds() - start;
      result.voices += static_cast<double>(engine.counters().voices) / kCells;
    }
    const auto counters = engine.counters();
    if (counters.started.of<protocol::Bubble>() != 2U * kCells * kPerCell)
      throw std::runtime_error("bubbles were dropped");
    times.push_back(spent);
  }
  result.onsets = kPerCell * kCells / median(times);
  return result;
}

double measure_flood(int births, double singles, bool everything) {
  constexpr int kSeconds = 4;
  constexpr int kTiles = 6;
  EngineSettings settings = settings_of("best", 131072);
  settings.max_scheduled = 1 << 20;
  settings.sound.cloud.singles = singles;
  if (everything) {
    settings.sound.cloud.coupling = 1.0;
    settings.sound.fine.amount = 1.0;
    settings.sound.foot.texture = settings.sound.foot.wash = 1e-4;
    settings.sound.bubble.place = settings.sound.cavity.place = 1.0;
    settings.sound.bubble.gain_db = -6.0;
  }
  Engine engine(rig_of(kTiles, 1.0), settings);
  Draw draw;
  for (int i = 0; i < births * kSeconds; ++i) {  // sizes as r^-3
    protocol::Bubble bubble;
    const double u = draw();
    bubble.radius = static_cast<float>(0.003 / std::sqrt(1.0 - 0.99 * u));
    bubble.epsilon = static_cast<float>(0.01 + 0.09 * draw());
    bubble.position = place(draw, kTiles);
    engine.schedule({bubble, static_cast<std::int64_t>(i * kRate / births)});
  }
  Player player(engine, 256);
  const double start = cpu_seconds();
  player.play(static_cast<std::int64_t>(kSeconds * kRate));
  return (cpu_seconds() - start) / kSeconds;
}

double measure_clouds() {
  constexpr int kBirths = 10000;
  Draw draw;
  synth::Cloud cloud(kRate);
  const synth::CloudSound sound{1.0, 1.0};
  return median_time(kRuns, [&] {
    double sum = 0.0;
    for (int i = 0; i < kBirths; ++i) {
      sum += cloud.enter(sound, place(draw, 6), 0.003 + 0.02 * draw(), 300.0, i);
    }
    consume(&sum);
  });
}

}  // namespace splash::bench
