// SPDX-License-Identifier: MIT
// Prints the generated part of a README: one program for each, made by splash_reference() in
// CMakeLists.txt, which defines the two names below.
#include <iostream>

#include SPLASH_REFERENCE_HEADER

int main() {
  std::cout << SPLASH_REFERENCE();
  return std::cout.flush() ? 0 : 1;
}
