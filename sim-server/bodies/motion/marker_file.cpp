// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/marker_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim-server/bodies/motion/text_table.hpp"

namespace splash::sim {

namespace {

// Lines of the header, counted from 0; data begin after them and after blank lines.
constexpr std::size_t kKeyLine = 1;
constexpr std::size_t kValueLine = 2;
constexpr std::size_t kNameLine = 3;
constexpr std::size_t kAxisLine = 4;
constexpr std::size_t kHeaderLines = 5;

constexpr double kLargestTime = 1.0e6;   // s
constexpr double kLargestPlace = 100.0;  // m

struct Header {
  double rate = 0.0;
  std::size_t frames = 0;
  double metres = 1.0;  ///< per unit of the file
};

std::size_t read_count(const TextTable& table, const Cell& cell, const std::string& what) {
  const double value = table.number(kValueLine, cell, what, 1.0e7);
  if (value < 1.0 || value != std::floor(value)) {
    throw table.error(kValueLine, cell.column, what + " is not a whole number above zero");
  }
  return static_cast<std::size_t>(value);
}

Header read_header(const TextTable& table) {
  static const std::map<std::string_view, double> kUnits = {
      {"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}};
  if (table.lines() < kHeaderLines || table.cells(0, '\t')[0].text != "PathFileType") {
    throw table.error(0, 1, "is no TRC file: its first line begins with PathFileType");
  }
  const auto keys = table.cells(kKeyLine, '\t');
  const auto values = table.cells(kValueLine, '\t');
  const auto value = [&](std::string_view key) -> Cell {
    for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
      if (keys[i].text == key) return values[i];
    }
    throw table.error(kKeyLine, 1, "the header has no " + std::string(key));
  };
  Header header;
  const Cell rate = value("DataRate");
  header.rate = table.number(kValueLine, rate, "DataRate", 1.0e5);
  if (header.rate <= 0.0) throw table.error(kValueLine, rate.column, "DataRate is not above zero");
  header.frames = read_count(table, value("NumFrames"), "NumFrames");
  const Cell unit = value("Units");
  if (!kUnits.contains(unit.text)) {
    throw table.error(kValueLine, unit.column,
                      "Units is '" + std::string(unit.text) + "'; known are mm, cm and m");
  }
  header.metres = kUnits.at(unit.text);
  return header;
}

/// Names stand over the first of each marker's three columns. The line of axes may go on beyond
/// the last name.
std::vector<std::string> read_names(const TextTable& table) {
  const auto cells = table.cells(kNameLine, '\t');
  if (cells.size() < 2 || cells[0].text != "Frame#" || cells[1].text != "Time") {
    throw table.error(kNameLine, 1, "the line of marker names begins with Frame# and Time");
  }
  std::vector<std::string> names;
  for (std::size_t i = 2; i < cells.size(); ++i) {
    if (cells[i].text.empty()) continue;
    if ((i - 2) % 3 != 0) {
      throw table.error(kNameLine, cells[i].column, "marker names stand three columns apart");
    }
    names.resize((i - 2) / 3);
    names.emplace_back(cells[i].text);
  }
  if (names.empty()) throw table.error(kNameLine, 1, "there is no marker name");
  const auto axes = table.cells(kAxisLine, '\t');
  const auto last =
      std::find_if(axes.rbegin(), axes.rend(), [](const Cell& cell) { return !cell.text.empty(); });
  const auto columns = static_cast<std::size_t>(axes.rend() - last);
  if (columns > 2) names.resize(std::max(names.size(), (columns - 2) / 3));
  return names;
}

bool is_missing(const Cell& cell) {
  return cell.text.empty() || cell.text == "NaN" || cell.text == "nan";
}

std::optional<Vector3> read_marker(const TextTable& table, std::size_t line, const Cell* cells,
                                   const std::string& name, double metres) {
  const auto missing = std::count_if(cells, cells + 3, is_missing);
  if (missing == 3) return std::nullopt;
  if (missing > 0) {
    throw table.error(line, cells[0].column, "marker '" + name + "' lacks a coordinate");
  }
  Vector3 place;
  for (std::size_t i = 0; i < 3; ++i) {
    place[i] = metres * table.number(line, cells[i], name, kLargestPlace / metres);
  }
  return Vector3{place[0], -place[2], place[1]};
}

void read_frame(const TextTable& table, std::size_t line, double metres, MarkerRecording& out) {
  auto cells = table.cells(line, '\t');
  const std::size_t wanted = 2 + 3 * out.names.size();
  while (cells.size() > wanted && cells.back().text.empty()) cells.pop_back();
  if (cells.size() > wanted) {
    throw table.error(line, cells[wanted].column, "there are more numbers than markers");
  }
  const int end = static_cast<int>(table.line(line).size()) + 1;
  cells.resize(wanted, Cell{{}, end});
  const double time = table.number(line, cells[1], "Time", kLargestTime);
  if (!out.times.empty() && time <= out.times.back()) {
    throw table.error(line, cells[1].column, "the time is not later than that of the frame before");
  }
  out.times.push_back(time);
  out.lines.push_back(static_cast<int>(line) + 1);
  auto& frame = out.frames.emplace_back();
  for (std::size_t i = 0; i < out.names.size(); ++i) {
    frame.push_back(read_marker(table, line, &cells[2 + 3 * i], out.names[i], metres));
  }
}

/// 16 or 17 ms between frames of 1/60 s would be 3 % of wrong speed: where all times are the
/// rate's, rounded to milliseconds, take the rate's.
void restore_times(MarkerRecording& recording) {
  constexpr double kRounding = 0.00051;  // s
  const auto ideal = [&](std::size_t i) {
    return recording.times[0] + static_cast<double>(i) / recording.rate;
  };
  for (std::size_t i = 0; i < recording.times.size(); ++i) {
    if (std::abs(recording.times[i] - ideal(i)) > 2.0 * kRounding) return;
  }
  for (std::size_t i = 1; i < recording.times.size(); ++i) recording.times[i] = ideal(i);
}

MarkerRecording read_table(const TextTable& table) {
  const Header header = read_header(table);
  MarkerRecording recording{
      .rate = header.rate, .names = read_names(table), .times = {}, .lines = {}, .frames = {}};
  if (table.line(kAxisLine).find("X1") == std::string_view::npos) {
    throw table.error(kAxisLine, 1, "the line of axes (X1 Y1 Z1 ...) is missing");
  }
  for (std::size_t line = kHeaderLines; line < table.lines(); ++line) {
    if (table.line(line).find_first_not_of(" \t") == std::string_view::npos) continue;
    read_frame(table, line, header.metres, recording);
  }
  if (recording.frames.size() != header.frames) {
    throw table.error(kValueLine, 1,
                      "NumFrames is " + std::to_string(header.frames) + ", but there are " +
                          std::to_string(recording.frames.size()) + " frames");
  }
  restore_times(recording);
  return recording;
}

}  // namespace

MarkerRecording read_markers(const std::filesystem::path& path) {
  return read_table(TextTable::load(path));
}

MarkerRecording parse_markers(const std::string& text, const std::string& file_name) {
  return read_table(TextTable(text, file_name));
}

}  // namespace splash::sim
