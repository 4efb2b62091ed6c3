// SPDX-License-Identifier: MIT
// Runs gnuplot on a script and says in one sentence what went wrong.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
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

/// How a picture begins: its size, ink and frame.
inline constexpr std::string_view kCanvas = R"gp(
set terminal pngcairo size 1500,1060 enhanced font "DejaVu Sans,15" linewidth 1.4 \
  background "#ffffff"
set encoding utf8
set minussign
ink = "#30343b"
set border 3 linecolor rgb ink linewidth 0.9
set tics nomirror out scale 0.6 textcolor rgb ink
set lmargin at screen 0.075
set rmargin at screen 0.915
)gp";

/// A panel of levels over the time, from top_db - range_db up to top_db. The colour map is
/// matplotlib's "magma" (CC0), seven points of it: even steps of brightness.
inline constexpr std::string_view kLevels = R"gp(
set border 15
set format x "%g"
set xlabel "time  [s]" offset 0,0.2 textcolor rgb ink
set cbrange [top_db-range_db:top_db]
set cbtics out scale 0.4
set palette defined (0 "#000004", 1 "#2c115f", 2 "#721f81", 3 "#b73779", 4 "#f1605d", \
  5 "#feb078", 6 "#fcfdbf")
)gp";

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
