// SPDX-License-Identifier: MIT
#include "sim-server/scene/live_rows.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "program/text.hpp"
#include "sim-server/scene/scene_rules.hpp"

namespace splash::sim {
namespace {

constexpr const char* kSection = "detect/";

using Member = decltype(program::Field<DetectSettings>::member);

std::string text(double value) {
  return program::format("%.6g", value);
}

template <class Value>
constexpr bool kIsNumber = std::is_arithmetic_v<Value>;

/// Of a row whose member is a number or a switch.
double read(const DetectSettings& detect, const Member& member) {
  return std::visit(
      [&](auto pointer) {
        using Value = std::remove_cvref_t<decltype(detect.*pointer)>;
        if constexpr (kIsNumber<Value>) return static_cast<double>(detect.*pointer);
        return 0.0;
      },
      member);
}

void write(DetectSettings& detect, const Member& member, double value) {
  std::visit(
      [&](auto pointer) {
        using Value = std::remove_cvref_t<decltype(detect.*pointer)>;
        if constexpr (std::is_same_v<Value, bool>) {
          detect.*pointer = value > 0.5;
        } else if constexpr (kIsNumber<Value>) {
          detect.*pointer = static_cast<Value>(value);
        }
      },
      member);
}

bool is_switch(const Member& member) {
  return std::holds_alternative<bool DetectSettings::*>(member);
}

bool is_whole(const Member& member) {
  return std::holds_alternative<int DetectSettings::*>(member);
}

const program::Field<DetectSettings>* find(const std::string& name) {
  const auto& fields = detect_fields();
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
    return field.row.live && kSection + field.row.key == name;
  });
  return found == fields.end() ? nullptr : &*found;
}

std::vector<LiveRow> rows_of(const DetectSettings& detect) {
  std::vector<LiveRow> rows;
  for (const auto& [row, member] : detect_fields()) {
    if (row.live)
      rows.push_back({kSection + row.key, &row, is_switch(member), read(detect, member)});
  }
  return rows;
}

/// "no live row, did you mean detect/bubble_speed?"
std::string unknown(const std::string& name) {
  std::vector<std::string> names;
  for (const LiveRow& row : rows_of({})) names.push_back(row.name);
  const std::string nearest = program::nearest_name(name, names);
  return nearest.empty() ? "no live row of the scene" : "did you mean " + nearest + "?";
}

/// Empty: within its range. What came as a float is compared as one.
std::string out_of_range(const program::Field<DetectSettings>& field, double value) {
  const auto& [row, member] = field;
  const double min = is_switch(member) ? 0.0 : row.min;
  const double max = is_switch(member) ? 1.0 : row.max;
  const auto given = static_cast<float>(value);
  const bool within = given >= static_cast<float>(min) && given <= static_cast<float>(max);
  const bool fits = !(is_switch(member) || is_whole(member)) || value == std::round(value);
  if (within && fits) return {};
  return text(value) + (row.unit.empty() || row.unit == "1" ? "" : " " + row.unit) + ", allowed " +
         text(min) + " to " + text(max) + (fits ? "" : ", whole numbers");
}

}  // namespace

std::string LiveRows::set(const std::string& name, double value) {
  const auto* field = find(name);
  if (field == nullptr) return unknown(name);
  if (std::string reason = out_of_range(*field, value); !reason.empty()) return reason;
  const std::lock_guard lock(mutex_);
  DetectSettings next = wanted_;
  write(next, field->member, std::clamp(value, field->row.min, field->row.max));
  if (std::string reason = wrong_order(next); !reason.empty()) return reason;
  wanted_ = next;
  changed_ = true;
  return {};
}

std::optional<double> LiveRows::get(const std::string& name) const {
  const auto* field = find(name);
  if (field == nullptr) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return read(wanted_, field->member);
}

std::vector<LiveRow> LiveRows::rows() const {
  const std::lock_guard lock(mutex_);
  return rows_of(wanted_);
}

std::optional<LiveRows::Change> LiveRows::take() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(changed_, false)) return std::nullopt;
  Change change{wanted_, {}};
  const std::vector<LiveRow> before = rows_of(held_);
  const std::vector<LiveRow> now = rows_of(wanted_);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].value != before[i].value) change.rows.push_back(now[i]);
  }
  held_ = wanted_;
  return change;
}

}  // namespace splash::sim
