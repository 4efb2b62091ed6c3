// SPDX-License-Identifier: MIT
#include "synth-server/render/ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace splash::synth {
namespace {

constexpr double kFresh = 0.010;  ///< [s]
constexpr std::size_t kShare = 64;
constexpr std::size_t kLeast = 16;  ///< candidates, in small pools
constexpr std::size_t kBins = 256;
constexpr float kSilent = std::numeric_limits<float>::infinity();

std::size_t bin_of(float level, float least, float most) noexcept {
  if (!(most > least)) return 0;
  const float part = (level - least) / (most - least);
  return std::min(kBins - 1, static_cast<std::size_t>(part * static_cast<float>(kBins)));
}

std::size_t wanted(std::size_t sounding) noexcept {
  return std::max(kLeast, sounding / kShare);
}

}  // namespace

Ranking::Ranking(std::size_t places, double sample_rate)
    : sample_rate_(sample_rate),
      fresh_(std::llround(kFresh * sample_rate)),
      lines_(places),
      levels_(places, kSilent) {
  ranked_.reserve(2 * wanted(places));
}

void Ranking::enter(std::uint32_t place, const VoiceLife& life, std::int64_t sample,
                    std::int64_t end) noexcept {
  const double decay = life.decay / sample_rate_;
  const double decay_start = static_cast<double>(sample) + life.hold * sample_rate_;
  lines_[place] = {life.log_amplitude, decay, life.log_amplitude + decay * decay_start, sample, end,
                   life.kept};
  used_ = std::max<std::size_t>(used_, place + 1U);
}

void Ranking::end_at(std::uint32_t place, std::int64_t sample) noexcept {
  lines_[place].until = std::min(lines_[place].until, sample);
}

double Ranking::level(std::uint32_t place, std::int64_t sample) const noexcept {
  const Line& line = lines_[place];
  return std::min(line.top, line.intercept - line.decay * static_cast<double>(sample));
}

bool Ranking::stands(const Candidate& candidate, std::int64_t sample) const noexcept {
  const Line& line = lines_[candidate.place];
  return line.since == candidate.since && line.until > sample;
}

std::uint32_t Ranking::quietest(std::int64_t sample) noexcept {
  const bool fresh = ranked_at_ >= 0 && sample < ranked_at_ + fresh_;
  if (fresh) {
    while (next_ < ranked_.size() && !stands(ranked_[next_], sample)) ++next_;
  }
  if (!fresh || next_ == ranked_.size()) rank(sample);
  return next_ < ranked_.size() ? ranked_[next_].place : kNone;
}

float Ranking::threshold(std::size_t sounding, float least, float most) const noexcept {
  std::array<std::size_t, kBins> counts{};
  for (std::size_t place = 0; place < used_; ++place) {
    if (levels_[place] < kSilent) ++counts[bin_of(levels_[place], least, most)];
  }
  std::size_t bin = 0;
  for (std::size_t found = counts[0]; found < wanted(sounding) && bin + 1 < kBins;) {
    found += counts[++bin];
  }
  return least + (most - least) * static_cast<float>(bin + 1) / static_cast<float>(kBins);
}

void Ranking::rank(std::int64_t sample) noexcept {
  float least = kSilent;
  float most = -kSilent;
  std::size_t sounding = 0;
  for (std::uint32_t place = 0; place < used_; ++place) {
    const bool counts = lines_[place].until > sample && !lines_[place].kept;
    levels_[place] = counts ? static_cast<float>(level(place, sample)) : kSilent;
    if (!counts) continue;
    least = std::min(least, levels_[place]);
    most = std::max(most, levels_[place]);
    ++sounding;
  }
  ranked_.clear();
  next_ = 0;
  ranked_at_ = sample;
  if (sounding == 0) return;
  const float limit = threshold(sounding, least, most);
  for (std::uint32_t place = 0; place < used_ && ranked_.size() < ranked_.capacity(); ++place) {
    if (levels_[place] <= limit) ranked_.push_back({levels_[place], place, lines_[place].since});
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const Candidate& a, const Candidate& b) {
    return a.level != b.level ? a.level < b.level : a.place < b.place;
  });
}

}  // namespace splash::synth
