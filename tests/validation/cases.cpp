// SPDX-License-Identifier: MIT
#include "tests/validation/cases.hpp"

#include <cmath>
#include <stdexcept>

namespace splash::validation {

bool Figure::has_gate() const {
  return std::isfinite(lowest) || std::isfinite(highest);
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> kCases = {hydrostatic(),       standing_wave(), elliptical_drop(),
                                           oscillating_drop(),  vortex(),        dam_martin_moyce(),
                                           dam_koshizuka_oka(), spheric2(),      slap(),
                                           pinch_off(),         closed_box(),    pressure_noise(),
                                           floating(),          sinking_cube(),  sinking_ball()};
  return kCases;
}

const Case& case_named(const std::string& name) {
  std::string known;
  for (const Case& item : all_cases()) {
    if (item.name == name) return item;
    known += " " + item.name;
  }
  throw std::out_of_range("there is no case '" + name + "'; there are:" + known);
}

}  // namespace splash::validation
