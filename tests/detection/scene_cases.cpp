// SPDX-License-Identifier: MIT
// The scenes as they ship.
#include "tests/detection/sweeps.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::detection {
namespace {

Case shipped_case(const std::string& name, double seconds, Count cavities, bool quick = false) {
  Case item = {"scenes", name, tests::scene_text(name + ".yaml"), seconds};
  item.wishes.cavities = cavities;
  item.quick = quick;
  return item;
}

}  // namespace

/// How many cavities: the basin's third plunge is too slow, the pool's feet stop too soon, floating
/// balls and boats do not go under. A ball that is braked and hands that stop 12 cm deep are at the
/// limit of the laws: either is right.
std::vector<Case> scene_cases() {
  std::vector<Case> all = {
      shipped_case("basin", 10.0, {3, 3}, true), shipped_case("bucket", 9.0, {0, 2}),
      shipped_case("ducks", 8.0, {0, 3}),        shipped_case("boat", 8.0, {0, 2}),
      shipped_case("plunge", 3.0, {1, 1}),       shipped_case("pool", 8.0, {0, 0}),
      shipped_case("beach", 20.0, {0, 0})};
  // Ten crests, one every two seconds, reach two feet; some of the backwash hits their toes.
  all.back().wishes.waves = Count{18, 36};
  return all;
}

}  // namespace splash::detection
