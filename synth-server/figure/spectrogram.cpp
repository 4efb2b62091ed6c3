// SPDX-License-Identifier: MIT
#include "synth-server/figure/spectrogram.hpp"

#include <kiss_fftr.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

namespace splash::synth {
namespace {

struct FreePlan {
  void operator()(kiss_fftr_state* plan) const { kiss_fftr_free(plan); }
};

/// The transform is this many times longer than the window: enough points between the lines of the
/// spectrum to read rows at 10 Hz by linear interpolation.
constexpr std::size_t kPadding = 4;

std::vector<float> hann(std::size_t length) {
  std::vector<float> window(length);
  for (std::size_t i = 0; i < length; ++i) {
    const double phase =
        2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(length);
    window[i] = static_cast<float>(0.5 - 0.5 * std::cos(phase));
  }
  return window;
}

std::size_t power_of_two_above(std::size_t n) {
  std::size_t size = 1;
  while (size < n) size *= 2;
  return size;
}

/// Amplitude spectrum of one windowed stretch of the signal.
class WindowedTransform {
 public:
  WindowedTransform(double sample_rate, double window_seconds)
      : window_(hann(static_cast<std::size_t>(std::max(16.0, window_seconds * sample_rate)))),
        input_(power_of_two_above(kPadding * window_.size())),
        output_(input_.size() / 2 + 1),
        plan_(kiss_fftr_alloc(static_cast<int>(input_.size()), 0, nullptr, nullptr)),
        bin_width_(sample_rate / static_cast<double>(input_.size())),
        // A sine of amplitude 1 leaves half its window's sum in its line.
        scale_(2.0 / std::accumulate(window_.begin(), window_.end(), 0.0)) {}

  /// Transforms what lies around `middle` [samples].
  void transform(std::span<const float> signal, double middle) {
    const auto length = static_cast<std::ptrdiff_t>(window_.size());
    const auto first = static_cast<std::ptrdiff_t>(std::llround(middle)) - length / 2;
    for (std::ptrdiff_t i = 0; i < length; ++i) {
      const std::ptrdiff_t at = first + i;
      const bool inside = at >= 0 && at < static_cast<std::ptrdiff_t>(signal.size());
      const float sample = inside ? signal[static_cast<std::size_t>(at)] : 0.0F;
      input_[static_cast<std::size_t>(i)] = sample * window_[static_cast<std::size_t>(i)];
    }
    kiss_fftr(plan_.get(), input_.data(), output_.data());
  }

  /// Amplitude at a frequency, between its two neighbouring lines.
  double amplitude(double frequency) const {
    const double position = frequency / bin_width_;
    const auto lower = std::min(static_cast<std::size_t>(position), output_.size() - 2);
    const double part = position - static_cast<double>(lower);
    return (1.0 - part) * magnitude(lower) + part * magnitude(lower + 1);
  }

 private:
  double magnitude(std::size_t bin) const {
    const double re = static_cast<double>(output_[bin].r);
    const double im = static_cast<double>(output_[bin].i);
    return scale_ * std::hypot(re, im);
  }

  std::vector<float> window_;
  std::vector<float> input_;  // the window, then zeros
  std::vector<kiss_fft_cpx> output_;
  std::unique_ptr<kiss_fftr_state, FreePlan> plan_;
  double bin_width_ = 0.0;  // [Hz]
  double scale_ = 0.0;
};

void require_sensible(const SpectrogramSettings& settings, double sample_rate) {
  if (settings.rows < 2 || settings.columns < 1) {
    throw std::invalid_argument("a spectrogram needs two rows and one column at least");
  }
  if (!(settings.from >= 0.0 && settings.to > settings.from)) {
    throw std::invalid_argument("a spectrogram from " + std::to_string(settings.from) + " s to " +
                                std::to_string(settings.to) + " s is empty");
  }
  if (!(settings.lowest > 0.0 && settings.highest > settings.lowest &&
        settings.highest <= sample_rate / 2.0)) {
    throw std::invalid_argument("a spectrogram from " + std::to_string(settings.lowest) +
                                " Hz to " + std::to_string(settings.highest) +
                                " Hz is not possible at a sample rate of " +
                                std::to_string(sample_rate) + " Hz");
  }
}

}  // namespace

Spectrogram spectrogram(std::span<const float> signal, double sample_rate,
                        const SpectrogramSettings& settings) {
  require_sensible(settings, sample_rate);
  Spectrogram result{settings.rows, settings.columns, {}, {}, {}};
  const double ratio = settings.highest / settings.lowest;
  for (std::size_t r = 0; r < settings.rows; ++r) {
    const double part = static_cast<double>(r) / static_cast<double>(settings.rows - 1);
    result.frequency.push_back(settings.lowest * std::pow(ratio, part));
  }
  result.level_db.resize(settings.rows * settings.columns);
  WindowedTransform transform(sample_rate, settings.window);
  const double end = std::min(settings.to, static_cast<double>(signal.size()) / sample_rate);
  const double step = (end - settings.from) / static_cast<double>(settings.columns);
  for (std::size_t c = 0; c < settings.columns; ++c) {
    result.time.push_back(settings.from + (static_cast<double>(c) + 0.5) * step);
    transform.transform(signal, result.time.back() * sample_rate);
    for (std::size_t r = 0; r < settings.rows; ++r) {
      const double level = 20.0 * std::log10(transform.amplitude(result.frequency[r]));
      result.level_db[r * settings.columns + c] =
          static_cast<float>(std::max(level, settings.floor_db));
    }
  }
  return result;
}

}  // namespace splash::synth
