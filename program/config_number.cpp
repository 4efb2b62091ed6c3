// SPDX-License-Identifier: MIT
// A small grammar in front of from_chars, which reads independently of the locale.
#include "program/config_number.hpp"

#include <cctype>
#include <charconv>
#include <cmath>

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

std::string lower(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
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

}  // namespace splash::program
