// SPDX-License-Identifier: MIT
// A long signal as narrow as a picture: the lowest and highest sample of each column.
#pragma once

#include <span>
#include <vector>

namespace splash::synth {

struct Extent {
  double time = 0.0;  ///< of the column's middle, from the first sample [s]
  float lowest = 0.0F;
  float highest = 0.0F;
};

/// At most `columns` extents of equal width; one per sample when there are fewer samples.
std::vector<Extent> envelope(std::span<const float> signal, double sample_rate,
                             std::size_t columns);

}  // namespace splash::synth
