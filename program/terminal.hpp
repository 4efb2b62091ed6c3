// SPDX-License-Identifier: MIT
// The terminal that a program runs in. SIGHUP comes when it is closed, and also from those who want
// the program to begin its files anew; only the terminal itself tells which of the two it was.
#pragma once

#include <termios.h>
#include <unistd.h>

#include <array>

namespace splash::program {

class Terminal {
 public:
  /// Returns whether standard input, output or error was a terminal when this was made, and that
  /// terminal has been closed since. A signal handler may call it.
  [[nodiscard]] bool closed() const noexcept {
    for (int file = 0; file < 3; ++file) {
      termios settings = {};
      if (is_terminal_[static_cast<std::size_t>(file)] && tcgetattr(file, &settings) != 0) {
        return true;
      }
    }
    return false;
  }

 private:
  std::array<bool, 3> is_terminal_ = {isatty(0) != 0, isatty(1) != 0, isatty(2) != 0};
};

}  // namespace splash::program
