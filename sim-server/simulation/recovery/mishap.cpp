// SPDX-License-Identifier: MIT
#include "sim-server/simulation/recovery/mishap.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace splash::sim {
namespace {

std::string cure(const Mishap& mishap) {
  std::ostringstream text;
  text << std::setprecision(2);
  const std::string tries = std::to_string(mishap.tries);
  switch (mishap.remedy) {
    case Remedy::retry:
      text << "computed again with shorter steps, the frame was sound"
           << (mishap.tries > 1 ? " at try " + std::to_string(mishap.tries + 1) : "");
      break;
    case Remedy::calm:
      if (std::isfinite(mishap.calmed)) {
        text << tries << " tries failed: the water within " << mishap.calmed
             << " m of that place was stopped, and nothing of the frame is told";
      } else {
        text << tries << " tries failed: all water was stopped, and nothing of the frame is told";
      }
      break;
    case Remedy::reset:
      text << "stopping the water did not help: the scene begins anew";
      break;
  }
  return text.str();
}

}  // namespace

std::string describe_fault(const Mishap& mishap) {
  const Diagnosis& what = mishap.what;
  std::ostringstream text;
  if (what.particle < 0) {
    text << describe(what.fault);
    if (what.body >= 0) text << ": '" << mishap.body << "'";
    return text.str();
  }
  const Vector3& x = mishap.place;
  text << std::fixed << std::setprecision(3) << "particle " << what.particle << ", last well at ("
       << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  if (!mishap.body.empty()) {
    text << std::setprecision(2) << " and " << mishap.distance << " m from the centre of body '"
         << mishap.body << "'";
  }
  text << ", " << describe(what.fault);
  if (what.particles > 1) text << " (" << what.particles << " particles in all)";
  return text.str();
}

std::string describe(const Mishap& mishap) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "at " << mishap.seconds << " s, in step "
       << mishap.step << ", " << describe_fault(mishap) << "; " << cure(mishap)
       << ". Likely cause: " << likely_cause(mishap.what.fault);
  return text.str();
}

}  // namespace splash::sim
