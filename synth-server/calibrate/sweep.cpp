// SPDX-License-Identifier: MIT
#include "synth-server/calibrate/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "program/text.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/output/output_guard.hpp"

namespace splash::synth {
namespace {

constexpr double kSeconds = 8.0;    ///< of the sweep
constexpr double kSilence = 1.0;    ///< behind it [s]
constexpr double kLevel = 0.25;     ///< of the ceiling [1]
constexpr double kBeyond = 1.5;     ///< it begins and ends so far outside the band [1]
constexpr double kBefore = 0.005;   ///< kept of the pulse before its top [s] ...
constexpr double kAfter = 0.5;      ///< ... and behind it [s]
constexpr double kLeastTop = 20.0;  ///< of the pulse over the mean of all else [1]

using Complex = std::complex<double>;

/// In place, a power of two.
void transform(std::vector<Complex>& x, bool back) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t length = 2; length <= n; length <<= 1U) {
    const double turn = (back ? 2.0 : -2.0) * std::numbers::pi / static_cast<double>(length);
    std::vector<Complex> turns(length / 2);
    for (std::size_t k = 0; k < turns.size(); ++k) {
      turns[k] = std::polar(1.0, turn * static_cast<double>(k));
    }
    for (std::size_t at = 0; at < n; at += length) {
      for (std::size_t k = 0; k < length / 2; ++k) {
        const Complex even = x[at + k];
        const Complex odd = x[at + k + length / 2];
        const Complex turned(odd.real() * turns[k].real() - odd.imag() * turns[k].imag(),
                             odd.real() * turns[k].imag() + odd.imag() * turns[k].real());
        x[at + k] = even + turned;
        x[at + k + length / 2] = even - turned;
      }
    }
  }
  if (!back) return;
  for (Complex& value : x) value /= static_cast<double>(n);
}

std::vector<Complex> spectrum(std::span<const float> samples, std::size_t size) {
  std::vector<Complex> x(size);
  for (std::size_t i = 0; i < samples.size(); ++i) x[i] = static_cast<double>(samples[i]);
  transform(x, false);
  return x;
}

/// What is heard, over what was sent: a pulse with all that the transducer adds.
std::vector<Complex> compressed(std::span<const float> heard, std::span<const float> sent) {
  std::size_t size = 1;
  while (size < heard.size() + sent.size()) size <<= 1U;
  std::vector<Complex> y = spectrum(heard, size);
  const std::vector<Complex> x = spectrum(sent, size);
  double most = 0.0;
  for (const Complex& value : x) most = std::max(most, std::norm(value));
  for (std::size_t k = 0; k < size; ++k) {
    const Complex reversed = std::conj(x[k]);
    const Complex up(y[k].real() * reversed.real() - y[k].imag() * reversed.imag(),
                     y[k].real() * reversed.imag() + y[k].imag() * reversed.real());
    y[k] = up / (std::norm(x[k]) + 1e-6 * most);
  }
  transform(y, true);
  return y;
}

/// The pulse around its top, everything else away.
std::vector<Complex> cut_out(const std::vector<Complex>& pulse, double sample_rate) {
  const auto size = [](const Complex& value) { return std::abs(value.real()); };
  const auto top = std::max_element(
      pulse.begin(), pulse.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
  double mean = 0.0;
  for (const Complex& value : pulse) mean += size(value) / static_cast<double>(pulse.size());
  if (!(size(*top) > kLeastTop * mean)) {
    throw std::runtime_error(
        "the sweep cannot be told from the rest of the recording: is it from this channel and at "
        "this rate? Play it louder, or put the sensor nearer");
  }
  std::size_t length = 1;
  while (static_cast<double>(length) < 1.3 * sample_rate) length <<= 1U;  // under 1 Hz apart
  std::vector<Complex> kept(std::min(length, pulse.size()));
  const auto before = std::llround(kBefore * sample_rate);
  const auto after = std::llround(kAfter * sample_rate);
  const auto whole = static_cast<std::int64_t>(pulse.size());
  for (std::int64_t n = -before; n < after; ++n) {
    const auto at = static_cast<std::size_t>((top - pulse.begin() + n + whole) % whole);
    const double rest = n < 0 ? 1.0 + static_cast<double>(n) / static_cast<double>(before)
                              : 2.0 * (1.0 - static_cast<double>(n) / static_cast<double>(after));
    const double fade = std::clamp(rest, 0.0, 1.0);
    kept[static_cast<std::size_t>(n + before)] =
        pulse[at].real() * fade * fade * (3.0 - 2.0 * fade);
  }
  transform(kept, false);
  return kept;
}

}  // namespace

std::vector<float> sweep_of(const Rig& rig, std::size_t channel, double sample_rate) {
  std::size_t first = 0;
  const auto output =
      std::find_if(rig.outputs.begin(), rig.outputs.end(), [&](const Output& candidate) {
        const auto count = static_cast<std::size_t>(channel_count(candidate));
        if (channel < first + count) return true;
        first += count;
        return false;
      });
  if (output == rig.outputs.end()) throw std::invalid_argument("the rig has no such channel");
  Output plain = *output;
  plain.equalisers.clear();
  OutputGuard guard(plain, sample_rate, static_cast<int>(channel - first));
  const double low = plain.band.low / kBeyond;
  const double high = std::min(plain.band.high * kBeyond, 0.45 * sample_rate);
  const double length = kSeconds / std::log(high / low);  // L [s]
  const auto frames = static_cast<std::size_t>((kSeconds + kSilence) * sample_rate);
  std::vector<float> samples(frames);
  Fade fade(Fade::kSeconds, sample_rate);
  for (std::size_t n = 0; n < frames; ++n) {
    const double t = static_cast<double>(n) / sample_rate;
    const double phase = 2.0 * std::numbers::pi * low * length * std::expm1(t / length);
    const double gain = fade.next(t < kSeconds - Fade::kSeconds);
    const double in = gain > 0.0 ? kLevel * plain.ceiling * gain * std::sin(phase) : 0.0;
    constexpr double kOpen = 1.0;
    guard.process(&in, &kOpen, &samples[n], 1);
  }
  return samples;
}

MeasuredResponse response_of(std::span<const float> heard, std::span<const float> sent,
                             const Band& band, double sample_rate) {
  const std::vector<Complex> found = cut_out(compressed(heard, sent), sample_rate);
  const double apart = sample_rate / static_cast<double>(found.size());  // [Hz]
  MeasuredResponse response;
  const double highest = std::min(band.high, 0.4 * sample_rate);
  for (int third = -30; third <= 24; ++third) {
    const double middle = 1000.0 * std::exp2(third / 3.0);
    if (middle < band.low || middle > highest) continue;
    const auto from = static_cast<std::size_t>(std::ceil(middle * std::exp2(-1.0 / 6.0) / apart));
    const auto to = static_cast<std::size_t>(std::floor(middle * std::exp2(1.0 / 6.0) / apart));
    double power = 0.0;
    for (std::size_t k = from; k <= to; ++k) power += std::norm(found[k]);
    response.frequency.push_back(middle);
    response.level_db.push_back(10.0 *
                                std::log10(power / static_cast<double>(to - from + 1) + 1e-30));
  }
  if (response.frequency.size() < 2) {
    throw std::runtime_error("the channel's band is narrower than two thirds of an octave");
  }
  std::vector<double> sorted = response.level_db;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (double& level : response.level_db) level -= median;
  return response;
}

std::string equaliser_text(const MeasuredResponse& response, const std::string& part) {
  const auto list = [](const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) {
      text += (text.empty() ? "[" : ", ") + program::format("%.1f", number);
    }
    return text + ']';
  };
  return "    equalisers:\n      - " +
         (part.empty() ? std::string("response:\n")
                       : "channels: [" + part + "]\n        response:\n") +
         "          frequency: " + list(response.frequency) +
         "\n          level_db: " + list(response.level_db) + '\n';
}

}  // namespace splash::synth
