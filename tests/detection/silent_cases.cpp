// SPDX-License-Identifier: MIT
// What must not be heard: easing in, sliding, pulling out, drops on a hand, feet that stand.
#include "tests/detection/script.hpp"
#include "tests/detection/sweeps.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::detection {
namespace {

const double kHalfHand = 0.5 * hand().size[2];

/// A hand on its way, which makes no cavity.
Case of_way(const std::string& sweep, const std::string& name, const Basin& basin, const Way& way) {
  Case item = {sweep, name, basin.scene({body_text("hand", shape_text(hand()), way.text())}),
               way.end()};
  item.wishes.cavities = Count{0, 0};
  return item;
}

Case immersion(double speed) {
  const Basin basin;
  Way way({0.0, 0.0, basin.level + 0.01 + kHalfHand});
  way.go({0.0, 0.0, -speed}, 0.03 / speed);
  Case item = of_way("slow", digits(100.0 * speed) + " cm/s", basin, way);
  item.quick = speed == 0.03;
  return item;
}

/// Lowered at 0.3 m/s until its underside is at `height`, then along the level.
Case slide(double height) {
  Basin basin;
  basin.length = 0.9;
  basin.level = 0.2;
  Way way({-0.2, 0.0, basin.level + 0.05 + kHalfHand});
  way.to({-0.2, 0.0, basin.level + height + kHalfHand}, 0.3).wait(0.1);
  way.go({1.5, 0.0, 0.0}, 0.25).wait(0.2);
  Case item = of_way("sliding", "underside at " + digits(1.0e3 * height) + " mm", basin, way);
  item.quick = height == -0.02;
  return item;
}

Case pull_out(double speed) {
  const Basin basin;
  Way way({0.0, 0.0, basin.level - 0.12 + kHalfHand});
  way.wait(0.1).go({0.0, 0.0, speed}, 0.27 / speed).wait(0.5);
  Case item = of_way("pull_out", digits(speed) + " m/s", basin, way);
  item.quick = speed == 1.0;
  return item;
}

/// One particle's water falls on a hand that waits above the basin and then plunges at 1 m/s.
Case lump(double speed) {
  Basin basin;
  basin.spacing = 0.03;
  const double top = basin.level + 0.2;
  Way way({0.0, 0.0, top - kHalfHand});
  way.wait(0.5).go({0.0, 0.0, -1.0}, 0.3).wait(0.3);
  const double fall = speed * speed / (2.0 * 9.81);
  const double half = 0.5 * basin.spacing;
  const std::string water = "  - {lower: " + digits({-half, -half, top + fall}) +
                            ", upper: " + digits({half, half, top + fall + basin.spacing}) + "}\n";
  Case item = {"lump", digits(speed) + " m/s",
               basin.scene({body_text("hand", shape_text(hand()), way.text())}, water), way.end()};
  item.quick = speed == 2.0;
  return item;
}

Case standing_in_pool() {
  Basin basin;
  basin.length = 0.6;
  basin.width = 0.6;
  basin.level = 0.2;
  basin.spacing = 0.03;
  std::vector<std::string> feet;
  for (const double y : {-0.12, 0.12}) {
    sim::Shape foot = box({0.27, 0.1, 0.08});
    foot.rocker = 0.015;
    const Way way({0.0, y, 0.07});
    feet.push_back(body_text(y < 0.0 ? "right" : "left", shape_text(foot), way.text()));
  }
  Case item = {"standing", "still pool", basin.scene(feet), 3.0};
  item.wishes.cavities = Count{0, 0};
  item.quick = true;
  return item;
}

/// Who stands makes no impact unless the scene wants those of waves.
Case standing_in_waves() {
  const std::string coarse =
      tests::changed(tests::scene_text("beach.yaml"), "particles: 15000", "particles: 8000");
  Case item = {"standing", "beach waves",
               tests::changed(coarse, "impact_waves: true", "impact_waves: false"), 6.0};
  item.wishes.cavities = Count{0, 0};
  return item;
}

}  // namespace

std::vector<Case> silent_cases() {
  return {immersion(0.01), immersion(0.03),    slide(-0.02),       slide(-0.005), slide(0.003),
          slide(0.01),     pull_out(0.3),      pull_out(1.0),      pull_out(2.0), lump(0.5),
          lump(2.0),       standing_in_pool(), standing_in_waves()};
}

}  // namespace splash::detection
