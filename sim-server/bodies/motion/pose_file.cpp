// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pose_file.hpp"

#include <array>
#include <cmath>

#include "sim-server/bodies/motion/text_table.hpp"
#include "sim-server/scene/pace.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

constexpr std::array<const char*, 8> kColumns = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr std::array<double, 8> kLimits = {1.0e6, 100, 100, 100, 1.1, 1.1, 1.1, 1.1};

void check_header(const TextTable& table, std::size_t line) {
  const auto cells = table.cells(line, ',');
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (i < cells.size() && cells[i].text == kColumns[i]) continue;
    const int column = i < cells.size() ? cells[i].column : cells.back().column;
    throw table.error(line, column, "the header must be t,x,y,z,qx,qy,qz,qw");
  }
  if (cells.size() > kColumns.size()) {
    throw table.error(line, cells[kColumns.size()].column, "there are more than eight columns");
  }
}

Keyframe read_row(const TextTable& table, std::size_t line) {
  constexpr double kLengthError = 0.1;
  const auto cells = table.cells(line, ',');
  if (cells.size() != kColumns.size()) {
    throw table.error(line, cells.back().column,
                      "a pose has eight numbers (got " + std::to_string(cells.size()) + ")");
  }
  std::array<double, 8> v = {};
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = table.number(line, cells[i], kColumns[i], kLimits[i]);
  }
  const double size = std::hypot(std::hypot(v[4], v[5]), std::hypot(v[6], v[7]));
  if (std::abs(size - 1.0) > kLengthError) {
    throw table.error(line, cells[4].column,
                      "the quaternion's length is " + std::to_string(size) + ", not 1 within 0.1");
  }
  return {v[0], {v[1], v[2], v[3]}, unit({v[4], v[5], v[6], v[7]})};
}

std::vector<Keyframe> read_table(const TextTable& table) {
  std::vector<Keyframe> poses;
  std::size_t last_line = 0;
  bool header = false;
  for (std::size_t line = 0; line < table.lines(); ++line) {
    if (table.line(line).empty() || table.line(line).front() == '#') continue;
    if (!header) {
      check_header(table, line);
      header = true;
      continue;
    }
    const Keyframe pose = read_row(table, line);
    if (!poses.empty() && pose.time <= poses.back().time) {
      throw table.error(line, 1, "the time is not later than that of the pose before");
    }
    if (!poses.empty()) {
      const std::string fast = too_fast(poses.back(), pose, kRecordedPace);
      if (!fast.empty()) {
        throw table.error(line, 1,
                          fast + ": one of the poses of lines " + std::to_string(last_line + 1) +
                              " and " + std::to_string(line + 1) + " or its time is wrong");
      }
    }
    last_line = line;
    poses.push_back(pose);
  }
  if (poses.empty()) throw table.error(table.lines(), 1, "there is no pose in the file");
  return poses;
}

}  // namespace

std::vector<Keyframe> read_poses(const std::filesystem::path& path) {
  return read_table(TextTable::load(path));
}

std::vector<Keyframe> parse_poses(const std::string& text, const std::string& file_name) {
  return read_table(TextTable(text, file_name));
}

}  // namespace splash::sim
