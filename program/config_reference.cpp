// SPDX-License-Identifier: MIT
// Rows of a configuration as a Markdown table.
#include <cmath>

#include "program/config.hpp"
#include "program/text.hpp"

namespace splash::program {
namespace {

std::string number(double value) {
  return format("%.10g", value);
}

std::string range_of(const Row& row) {
  std::string out;
  for (const auto& choice : row.choices) out += (out.empty() ? "`" : ", `") + choice + "`";
  if (!row.choices.empty()) return out;
  const bool low = std::isfinite(row.min);
  const bool high = std::isfinite(row.max);
  if (low && high) return number(row.min) + " .. " + number(row.max);
  if (low) return "at least " + number(row.min);
  return high ? "at most " + number(row.max) : "any";
}

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string text_of(double value) {
  return format("%.6g", value);
}
std::string text_of(int value) {
  return std::to_string(value);
}
std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(const std::string& value) {
  return value;
}
template <class List>
std::string text_of(const List& list) {
  std::string out;
  for (const auto& item : list) out += (out.empty() ? "" : ", ") + text_of(item);
  return "[" + out + "]";
}

}  // namespace

std::string default_text(const MemberPlace& value) {
  return std::visit([](const auto* member) { return text_of(*member); }, value);
}

std::string describe(const std::vector<Row>& rows, const std::vector<std::string>& defaults) {
  std::string out =
      "| key | unit | default | range | meaning | source |\n|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    std::string fallback = i < defaults.size() ? cell(defaults[i]) : "";
    if (row.required) fallback = "required";
    out += "| `" + row.key + "` | " + row.unit + " | " + fallback + " | " + range_of(row) + " | " +
           cell(row.meaning) + (row.live ? " *Live.*" : "") + " | " + cell(row.source) + " |\n";
  }
  return out;
}

}  // namespace splash::program
