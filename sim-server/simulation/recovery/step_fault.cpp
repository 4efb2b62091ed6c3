// SPDX-License-Identifier: MIT
#include "sim-server/simulation/recovery/step_fault.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace splash::sim {
namespace {

std::string cure(const StepFault& step_fault) {
  std::ostringstream text;
  text << std::setprecision(2);
  const std::string tries = std::to_string(step_fault.tries);
  switch (step_fault.remedy) {
    case Remedy::retry:
      text << "computed again with shorter steps, the frame was sound"
           << (step_fault.tries > 1 ? " at try " + std::to_string(step_fault.tries + 1) : "");
      break;
    case Remedy::calm:
      if (std::isfinite(step_fault.calmed)) {
        text << tries << " tries failed: the water within " << step_fault.calmed
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

std::string describe_fault(const StepFault& step_fault) {
  const Diagnosis& what = step_fault.what;
  std::ostringstream text;
  if (what.particle < 0) {
    text << describe(what.fault);
    if (what.body >= 0) text << ": '" << step_fault.body << "'";
    return text.str();
  }
  const Vector3& x = step_fault.place;
  text << std::fixed << std::setprecision(3) << "particle " << what.particle << ", last well at ("
       << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  if (!step_fault.body.empty()) {
    text << std::setprecision(2) << " and " << step_fault.distance << " m from the centre of body '"
         << step_fault.body << "'";
  }
  text << ", " << describe(what.fault);
  if (what.particles > 1) text << " (" << what.particles << " particles in all)";
  return text.str();
}

std::string describe(const StepFault& step_fault) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "at " << step_fault.seconds << " s, in step "
       << step_fault.step << ", " << describe_fault(step_fault) << "; " << cure(step_fault)
       << ". Likely cause: " << likely_cause(step_fault.what.fault);
  return text.str();
}

}  // namespace splash::sim
