// SPDX-License-Identifier: MIT
#include "tests/bench/synth_algorithms.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>

#include "synth-server/render/flush_denormals.hpp"
#include "synth-server/voices/pack_kernels.hpp"
#include "synth-server/voices/paper_bubble.hpp"
#include "tests/bench/synth_float_loops.hpp"
#include "tests/bench/synth_timing.hpp"

namespace splash::bench {

FloatLoops float_loops_portable();
#if defined(__x86_64__)
FloatLoops float_loops_avx2();
FloatLoops float_loops_avx512();
#endif

FloatLoops float_loops(synth::InstructionSet set) {
#if defined(__x86_64__)
  if (set == synth::InstructionSet::avx512) return float_loops_avx512();
  if (set == synth::InstructionSet::avx2) return float_loops_avx2();
#endif
  static_cast<void>(set);
  return float_loops_portable();
}

namespace {

using synth::BubbleTone;
using synth::InstructionSet;
using synth::kCell;
using synth::kPackVoices;

constexpr double kRate = 44100.0;
constexpr int kRuns = 5;
constexpr double kVoiceCells = 200'000.0;  ///< in each timed run

/// Sixteen voices that give a cell's samples at a time, whatever is behind them.
class Sixteen {
 public:
  Sixteen() = default;
  virtual ~Sixteen() = default;
  Sixteen(const Sixteen&) = delete;
  Sixteen& operator=(const Sixteen&) = delete;
  virtual void seat(std::size_t lane, const BubbleTone& tone) = 0;
  virtual void render() = 0;
  [[nodiscard]] virtual double at(std::size_t lane, std::size_t n) const = 0;
  /// Adds all voices to one channel.
  virtual void mix(double* channel) {
    for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
      for (std::size_t n = 0; n < kCell; ++n) channel[n] += at(lane, n);
    }
  }
};

/// sin and exp of the library, for each sample.
class ClosedForm final : public Sixteen {
 public:
  void seat(std::size_t lane, const BubbleTone& tone) override { tones_[lane] = tone; }
  void render() override {
    for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
      for (std::size_t n = 0; n < kCell; ++n) {
        samples_[lane][n] = pressure(tones_[lane], (clock_ + static_cast<double>(n)) / kRate);
      }
    }
    clock_ += kCell;
  }
  [[nodiscard]] double at(std::size_t lane, std::size_t n) const override {
    return samples_[lane][n];
  }

 private:
  std::array<BubbleTone, kPackVoices> tones_;
  std::array<std::array<double, kCell>, kPackVoices> samples_{};
  double clock_ = 0.0;
};

/// One voice after the other, two multiplications of complex numbers per sample.
class ScalarDouble final : public Sixteen {
 public:
  void seat(std::size_t lane, const BubbleTone& tone) override {
    const double w = 2.0 * std::numbers::pi * tone.frequency / kRate;
    const double c = tone.rise / kRate;
    voices_[lane] = {tone.amplitude, std::polar(std::exp(-tone.damping / kRate), w * (1.0 + c)),
                     std::polar(1.0, 2.0 * w * c)};
  }
  void render() override {
    for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
      auto [z, turn, rise] = voices_[lane];
      for (std::size_t n = 0; n < kCell; ++n) {
        samples_[lane][n] = z.imag();
        z = product(z, turn);
        turn = product(turn, rise);
      }
      voices_[lane] = {z, turn, rise};
    }
  }
  [[nodiscard]] double at(std::size_t lane, std::size_t n) const override {
    return samples_[lane][n];
  }

 private:
  using Complex = std::complex<double>;
  static Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }
  struct Voice {
    Complex z, turn, rise;
  };
  std::array<Voice, kPackVoices> voices_;
  std::array<std::array<double, kCell>, kPackVoices> samples_{};
};

/// Single precision alone, started afresh every `cells` cells, 0: never.
class FloatAlone final : public Sixteen {
 public:
  FloatAlone(InstructionSet set, int cells) : loops_(float_loops(set)), cells_(cells) {}
  void seat(std::size_t lane, const BubbleTone& tone) override {
    tones_[lane] = tone;
    start(lane, 0.0);
  }
  void render() override {
    if (cells_ > 0 && cell_ > 0 && cell_ % cells_ == 0) {
      for (std::size_t lane = 0; lane < kPackVoices; ++lane) start(lane, 64.0 * cell_);
    }
    loops_.advance(pack_, samples_.data());
    ++cell_;
  }
  [[nodiscard]] double at(std::size_t lane, std::size_t n) const override {
    return static_cast<double>(samples_[n * kPackVoices + lane]);
  }
  void mix(double* channel) override {
    for (std::size_t n = 0; n < kCell; ++n) {
      float sum = 0.0F;
      for (std::size_t lane = 0; lane < kPackVoices; ++lane)
        sum += samples_[n * kPackVoices + lane];
      channel[n] += static_cast<double>(sum);
    }
  }

 private:
  void start(std::size_t lane, double n) {
    const BubbleTone& tone = tones_[lane];
    const double w = 2.0 * std::numbers::pi * tone.frequency / kRate;
    const double c = tone.rise / kRate;
    const double fall = tone.damping / kRate;
    set(pack_.re, pack_.im, lane,
        std::polar(tone.amplitude * std::exp(-fall * n), w * n * (1.0 + c * n)));
    set(pack_.turn_re, pack_.turn_im, lane,
        std::polar(std::exp(-fall), w * (1.0 + c * (2.0 * n + 1.0))));
    set(pack_.rise_re, pack_.rise_im, lane, std::polar(1.0, 2.0 * w * c));
  }
  static void set(float* re, float* im, std::size_t lane, std::complex<double> value) {
    re[lane] = static_cast<float>(value.real());
    im[lane] = static_cast<float>(value.imag());
  }
  FloatLoops loops_;
  int cells_;
  int cell_ = 0;
  std::array<BubbleTone, kPackVoices> tones_;
  FloatPack pack_;
  alignas(64) std::array<float, kPackVoices * kCell> samples_{};
};

/// The synth's own.
template <class Pack>
class Product final : public Sixteen {
 public:
  explicit Product(const synth::PackKernels<Pack>& kernels) : kernels_(kernels) {
    for (Real& gain : feed_.gains) gain = Real{1};
  }
  void seat(std::size_t lane, const BubbleTone& tone) override {
    set_lane(pack_, lane, tone, kRate, 0);
  }
  void render() override { kernels_.advance(pack_, 0, kCell, rows_.data()); }
  [[nodiscard]] double at(std::size_t lane, std::size_t n) const override {
    return static_cast<double>(rows_[n * kPackVoices + lane]);
  }
  void mix(double* channel) override {
    packs_.rows[packs_.count] = rows_.data();
    packs_.feeds[packs_.count] = &feed_;
    if (++packs_.count == synth::kMixedPacks<Real>) {
      kernels_.mix(packs_, 0, kCell, sums_.data());
      packs_.count = 0;
    }
    if (++mixed_ % kPacks == 0) kernels_.collect(sums_.data(), 0, kCell, channel);
  }

 private:
  using Real = typename Pack::Real;
  /// A pool's worth of packs shares the collecting of a channel's lanes.
  static constexpr int kPacks = 64;
  synth::PackKernels<Pack> kernels_;
  Pack pack_{};
  synth::PackFeed<Real> feed_;
  synth::PackMix<Real> packs_;
  alignas(64) std::array<Real, synth::kRows> rows_{};
  alignas(64) std::array<Real, synth::kRows> sums_{};
  int mixed_ = 0;
};

using Make = std::function<std::unique_ptr<Sixteen>()>;

double radius_of(int index, int count) {
  return 0.001 * std::pow(300.0, index / (count - 1.0));
}

double largest_error(const Make& make) {
  constexpr int kGroups = 4;
  double worst = 0.0;
  for (int group = 0; group < kGroups; ++group) {
    const auto voices = make();
    std::array<BubbleTone, kPackVoices> tones;
    std::int64_t longest = 0;
    for (int lane = 0; lane < kPackVoices; ++lane) {
      const double radius = radius_of(group * kPackVoices + lane, kGroups * kPackVoices);
      const auto at = static_cast<std::size_t>(lane);
      tones[at] = synth::paper_bubble(radius, 1.0 / radius);
      voices->seat(at, tones[at]);
      longest = std::max(longest, life_of(tones[at], kRate, 3.16e-5).length);
    }
    for (std::int64_t cell = 0; cell * kCell < longest; ++cell) {
      voices->render();
      for (std::size_t lane = 0; lane < kPackVoices; ++lane) {
        for (std::size_t n = 0; n < kCell; ++n) {
          const double t = static_cast<double>(cell * kCell + static_cast<std::int64_t>(n)) / kRate;
          if (tones[lane].damping * t > 10.36) continue;  // -90 dB
          worst = std::max(worst, std::abs(voices->at(lane, n) - pressure(tones[lane], t)));
        }
      }
    }
  }
  return 20.0 * std::log10(worst);
}

double voices_per_core(const Make& make, double share) {
  const auto voices = make();
  for (int lane = 0; lane < kPackVoices; ++lane) {
    const double radius = 0.05 + 0.01 * lane;
    voices->seat(static_cast<std::size_t>(lane), synth::paper_bubble(radius, 0.05));
  }
  const int cells = static_cast<int>(share * kVoiceCells / kPackVoices);
  std::array<double, kCell> channel{};
  const double spent = median_time(kRuns, [&] {
    for (int cell = 0; cell < cells; ++cell) {
      voices->render();
      voices->mix(channel.data());
      consume(channel.data());
    }
  });
  return kPackVoices * cells * (kCell / kRate) / spent;
}

Algorithm measure(const std::string& name, const std::string& instructions, const Make& make,
                  double share = 1.0) {
  return {name, instructions, voices_per_core(make, share), largest_error(make)};
}

std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> found;
  for (const auto set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set) == set) found.push_back(set);
  }
  return found;
}

}  // namespace

std::vector<Algorithm> measure_algorithms() {
  const synth::FlushDenormals flush;
  std::vector<Algorithm> all;
  all.push_back(measure(
      "sin and exp (reference)", "portable", [] { return std::make_unique<ClosedForm>(); }, 0.05));
  all.push_back(
      measure("double, one by one", "portable", [] { return std::make_unique<ScalarDouble>(); }));
  for (const InstructionSet set : sets()) {
    const std::string name = name_of(set);
    for (const int cells : {0, 4, 1}) {
      const std::string fresh = cells == 0 ? "never" : "every " + std::to_string(64 * cells);
      all.push_back(measure("float, afresh " + fresh, name,
                            [&] { return std::make_unique<FloatAlone>(set, cells); }));
    }
    all.push_back(measure("exact", name, [&] {
      return std::make_unique<Product<synth::ExactPack>>(synth::exact_kernels(set));
    }));
    all.push_back(measure("fast", name, [&] {
      return std::make_unique<Product<synth::FastPack>>(synth::fast_kernels(set));
    }));
  }
  return all;
}

std::vector<Limit> measure_limits() {
  std::vector<Limit> limits;
  for (const InstructionSet set : sets()) {
    const FloatLoops loops = float_loops(set);
    std::vector<double> rates;
    for (int run = 0; run < kRuns; ++run) rates.push_back(loops.vector_rate());
    const double rate = median(rates);
    // Two multiplications of complex numbers per sample: 4 products each, half of them fused with
    // the sums where the set can.
    const double operations = loops.fused ? 8.0 : 12.0;
    limits.push_back({name_of(set), rate, rate * loops.lanes / operations / kRate});
  }
  return limits;
}

}  // namespace splash::bench
