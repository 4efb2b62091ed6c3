// SPDX-License-Identifier: MIT
#include "synth-server/figure/envelope.hpp"

#include <algorithm>

namespace splash::synth {

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
