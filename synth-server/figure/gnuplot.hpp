// SPDX-License-Identifier: MIT
// Runs gnuplot on a script and says in one sentence what went wrong.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace splash::synth {

/// gnuplot could not be started, or did not like its script.
class GnuplotError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs `program` (found on the PATH) in the script's folder; what it prints goes to a file beside
/// the script, and into the error's text when it fails. Throws GnuplotError.
void run_gnuplot(const std::filesystem::path& script, const char* program = "gnuplot");

/// A string of a script in double quotes, on one line.
[[nodiscard]] std::string quoted(const std::string& text);

/// Writes numbers for a script's `binary format="%float"`. Throws std::runtime_error.
void write_floats(const std::filesystem::path& file, const std::vector<float>& numbers);

/// A new empty folder below the system's temporary one, removed with its content at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace splash::synth
