// SPDX-License-Identifier: MIT
// Prints the address reference that README.md holds between its markers.
#include <iostream>

#include "protocol/address.hpp"

int main() {
  std::cout << splash::protocol::address_reference();
  return std::cout.flush() ? 0 : 1;
}
