// SPDX-License-Identifier: MIT
// Messages against the address table: types, counts and ranges.
#include <algorithm>

#include "program/text.hpp"
#include "protocol/address.hpp"

namespace splash::protocol {
namespace {

constexpr std::string_view kTypes = "ifst";  // in the order of Argument's types

std::size_t required_count(const AddressRow& row) {
  std::size_t count = 0;
  for (const auto& argument : row.arguments) count += argument.optional ? 0U : 1U;
  return count;
}

bool has_types(const Message& message, const AddressRow& row) {
  const auto& arguments = message.arguments;
  if (arguments.size() < required_count(row)) return false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool fills = i >= row.arguments.size();
    if (fills && !is_command(row)) return false;
    if (kTypes[arguments[i].index()] != (fills ? 's' : row.arguments[i].type)) return false;
  }
  return true;
}

/// How many arguments of a message are in its row: what fills it up is not.
std::size_t told_count(const Message& message, const AddressRow& row) {
  return std::min(message.arguments.size(), row.arguments.size());
}

std::string number(double value) {
  return program::format("%.9g", value);
}

std::string describe_range(const Argument& argument, const ArgumentRow& row) {
  std::string got = "'" + std::string(row.fixed) + "' expected";
  if (const auto* value = std::get_if<std::int32_t>(&argument)) got = std::to_string(*value);
  if (const auto* value = std::get_if<float>(&argument)) got = number(static_cast<double>(*value));
  const std::string unit = row.unit == "1" || row.unit.empty() ? "" : " " + std::string(row.unit);
  std::string reason = std::string(row.name) + ' ' + got;
  if (row.fixed.empty()) {
    reason += unit + ", allowed " + number(row.min) + " to " + number(row.max);
  }
  return reason;
}

}  // namespace

std::string type_tags(const AddressRow& row) {
  std::string tags = ",";
  for (const auto& argument : row.arguments) tags += argument.type;
  return tags;
}

const AddressRow* find_address(std::string_view address) noexcept {
  for (const auto& row : address_table()) {
    if (row.address == address) return &row;
  }
  return nullptr;
}

// Bounds are compared as floats: 1e-4 sent as a float lies under the double 1e-4.
bool in_range(const Argument& argument, const ArgumentRow& row) noexcept {
  if (const auto* value = std::get_if<std::int32_t>(&argument)) {
    return *value >= row.min && *value <= row.max;
  }
  if (const auto* value = std::get_if<float>(&argument)) {
    return *value >= static_cast<float>(row.min) && *value <= static_cast<float>(row.max);
  }
  const auto* value = std::get_if<std::string>(&argument);
  return value == nullptr || row.fixed.empty() || *value == row.fixed;
}

bool conforms(const Message& message, const AddressRow& row) noexcept {
  if (message.address != row.address || !has_types(message, row)) return false;
  for (std::size_t i = 0; i < told_count(message, row); ++i) {
    if (!in_range(message.arguments[i], row.arguments[i])) return false;
  }
  return true;
}

std::optional<std::string> violation(const Message& message) {
  std::string expected;
  for (const auto& row : address_table()) {
    if (row.address != message.address) continue;
    if (conforms(message, row)) return std::nullopt;
    expected += (expected.empty() ? "" : " or ") + type_tags(row);
  }
  for (const auto& row : address_table()) {
    if (row.address != message.address || !has_types(message, row)) continue;
    for (std::size_t i = 0; i < told_count(message, row); ++i) {
      if (in_range(message.arguments[i], row.arguments[i])) continue;
      return describe_range(message.arguments[i], row.arguments[i]);
    }
  }
  if (expected.empty()) return "unknown address";
  return "types are " + type_tags(message) + ", expected " + expected;
}

}  // namespace splash::protocol
