// SPDX-License-Identifier: MIT
// Prints the scene reference that configs/README.md holds between its markers.
#include <iostream>

#include "sim-server/scene/scene_reference.hpp"

int main() {
  std::cout << splash::sim::scene_reference();
  return std::cout.flush() ? 0 : 1;
}
