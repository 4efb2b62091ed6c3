// SPDX-License-Identifier: MIT
// A small grammar in front of from_chars, which reads independently of the locale.
#include "program/config_value.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "program/text.hpp"

namespace splash::program {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t skip_digits(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::size_t skip_sign(const std::string& text, std::size_t at) {
  return at < text.size() && (text[at] == '+' || text[at] == '-') ? at + 1 : at;
}

// "010": eight in YAML 1.1, ten in YAML 1.2.
bool looks_octal(const std::string& text) {
  const std::size_t start = skip_sign(text, 0);
  const std::size_t end = skip_digits(text, start);
  return end - start > 1 && text[start] == '0';
}

bool is_whole(const std::string& text) {
  const std::size_t start = skip_sign(text, 0);
  const std::size_t end = skip_digits(text, start);
  return end > start && end == text.size() && !looks_octal(text);
}

bool is_decimal(const std::string& text) {
  const std::size_t start = skip_sign(text, 0);
  std::size_t at = skip_digits(text, start);
  std::size_t digits = at - start;
  if (at < text.size() && text[at] == '.') {
    const std::size_t end = skip_digits(text, at + 1);
    digits += end - at - 1;
    at = end;
  }
  if (digits == 0 || looks_octal(text)) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t exponent = skip_sign(text, at + 1);
    at = skip_digits(text, exponent);
    if (at == exponent) return false;
  }
  return at == text.size();
}

template <class Number>
std::optional<Number> read(const std::string& text) {
  const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  Number value{};
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;  // out of the type's range
  return value;
}

}  // namespace

std::optional<double> parse_number(const std::string& text) {
  if (!is_decimal(text)) return std::nullopt;
  return read<double>(text);
}

std::optional<int> parse_whole(const std::string& text) {
  if (!is_whole(text)) return std::nullopt;
  return read<int>(text);
}

std::optional<bool> parse_truth(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return std::nullopt;
}

std::string number_advice(const std::string& text) {
  const std::string plain = lower(text);
  if (plain.find("inf") != std::string::npos || plain.find("nan") != std::string::npos) {
    return "it must be finite";
  }
  if (text.find(',') != std::string::npos) return "write the decimal point as '.'";
  if (text.find('_') != std::string::npos) return "write the digits without '_'";
  if (plain.rfind("0x", 0) == 0 || plain.rfind("0o", 0) == 0) return "write it in decimal";
  if (looks_octal(text)) return "a leading zero may mean octal, leave it out";
  if (is_decimal(text)) return "too large or too small a number";
  const std::size_t end = skip_digits(text, skip_sign(text, 0));
  if (end > skip_sign(text, 0)) return "write the number alone, without a unit";
  return "";
}

// A conversion for each kind of member a configuration can fill.

using Kind = ConfigTree::Kind;

namespace {

std::string number(double value) {
  return format("%.10g", value);
}

std::string with_unit(const std::string& text, const Row& row) {
  return row.unit.empty() || row.unit == "1" ? text : text + ' ' + row.unit;
}

std::string range_of(const Row& row) {
  const bool low = row.min > -std::numeric_limits<double>::infinity();
  const bool high = row.max < std::numeric_limits<double>::infinity();
  if (low && high) return with_unit(number(row.min) + ".." + number(row.max), row);
  if (low) return "at least " + with_unit(number(row.min), row);
  if (high) return "at most " + with_unit(number(row.max), row);
  return row.unit.empty() || row.unit == "1" ? "" : "in " + row.unit;
}

std::string with_range(const std::string& expected, const Row& row) {
  const auto range = range_of(row);
  return range.empty() ? expected : expected + ", " + range;
}

bool is_plain(const ConfigValue& value) {
  return value.tree.kind == Kind::scalar && !value.tree.quoted;
}

// The error of a value that should have been a number.
ConfigError wrong(const ConfigValue& value, const std::string& expected) {
  const auto& tree = value.tree;
  if (tree.kind == Kind::null) return value.error("has no value", expected);
  if (tree.kind != Kind::scalar) return value.error("wrong kind of value", expected);
  if (tree.quoted) return value.error("text in quotes is no number", expected);
  const auto advice = number_advice(tree.text);
  return value.error(advice.empty() ? "wrong kind of value" : advice, expected);
}

void check_range(const ConfigValue& value, double number) {
  if (number >= value.row.min && number <= value.row.max) return;
  throw value.error("out of range", range_of(value.row));
}

void convert(const ConfigValue& value, double& out) {
  const auto parsed = is_plain(value) ? parse_number(value.tree.text) : std::nullopt;
  if (!parsed) throw wrong(value, with_range("a number", value.row));
  check_range(value, *parsed);
  out = *parsed;
}

void convert(const ConfigValue& value, int& out) {
  const auto parsed = is_plain(value) ? parse_whole(value.tree.text) : std::nullopt;
  if (parsed) {
    check_range(value, *parsed);
    out = *parsed;
    return;
  }
  const auto expected = with_range("a whole number", value.row);
  const bool fraction = value.tree.text.find_first_of(".eE") != std::string::npos;
  if (is_plain(value) && fraction && parse_number(value.tree.text)) {
    throw value.error("it must be whole", expected);
  }
  throw wrong(value, expected);
}

void convert(const ConfigValue& value, bool& out) {
  const auto parsed = is_plain(value) ? parse_truth(value.tree.text) : std::nullopt;
  if (!parsed) throw value.error("wrong kind of value", "true or false");
  out = *parsed;
}

void convert(const ConfigValue& value, std::string& out) {
  const auto& choices = value.row.choices;
  if (value.tree.kind != Kind::scalar) {
    throw value.error(value.tree.kind == Kind::null ? "has no value" : "wrong kind of value",
                      "text");
  }
  const auto& text = value.tree.text;
  // Names are printed, on terminals too.
  if (!is_printable(text)) throw value.error("has a control character", "printable UTF-8 text");
  bool known = choices.empty();
  std::string listed;
  for (const auto& choice : choices) {
    known = known || choice == text;
    listed += (listed.empty() ? "" : ", ") + choice;
  }
  if (!known) {
    const auto error = value.error("unknown choice", "one of " + listed);
    const auto nearest = nearest_name(text, choices);
    if (nearest.empty()) throw error;
    throw ConfigError::with_suggestion(error, nearest);
  }
  out = text;
}

template <std::size_t Count>
void convert(const ConfigValue& value, std::array<double, Count>& out) {
  if (value.tree.kind != Kind::list || value.tree.items.size() != Count) {
    const auto expected = "a list of " + std::to_string(Count) + " numbers";
    throw value.error("wrong kind of value", with_range(expected, value.row));
  }
  std::array<double, Count> numbers{};
  for (std::size_t i = 0; i < Count; ++i) convert(value.item(i), numbers[i]);
  out = numbers;
}

template <class Item>
void convert(const ConfigValue& value, std::vector<Item>& out) {
  if (value.tree.kind != Kind::list) {
    throw value.error("wrong kind of value", "a list, such as [a, b]");
  }
  std::vector<Item> items(value.tree.items.size());
  for (std::size_t i = 0; i < items.size(); ++i) convert(value.item(i), items[i]);
  out = std::move(items);
}

}  // namespace

ConfigError ConfigValue::error(const std::string& reason, const std::string& expected) const {
  return {tree.place, "key '" + key + "': " + reason + " (got " + describe_kind(tree) +
                          ", expected " + expected + ")"};
}

ConfigValue ConfigValue::item(std::size_t index) const {
  return {tree.items[index], row, key + '[' + std::to_string(index) + ']'};
}

void convert(const ConfigValue& value, const MemberPlace& out) {
  std::visit([&](auto* member) { convert(value, *member); }, out);
}

}  // namespace splash::program
