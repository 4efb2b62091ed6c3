// SPDX-License-Identifier: MIT
#include "program/failure.hpp"

#include <csignal>
#include <iostream>

#include "program/config.hpp"

namespace splash::program {

int exit_code_of(const char* program, const std::function<void()>& run) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader of the output that goes away ends nothing
  std::signal(SIGXFSZ, SIG_IGN);  // nor does a file as long as it may be: that is a full disk
  try {
    run();
    return kExitOk;
  } catch (const ConfigError& error) {
    std::cerr << error.what() << '\n';
    return error.code();
  } catch (const Failure& failure) {
    std::cerr << program << ": " << failure.what() << '\n';
    return failure.code();
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return kExitInternal;
  }
}

}  // namespace splash::program
