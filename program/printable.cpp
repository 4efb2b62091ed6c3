// SPDX-License-Identifier: MIT
// UTF-8 as RFC 3629 has it: table 3-7 of the Unicode standard, "well-formed byte sequences".
#include "program/printable.hpp"

#include <array>
#include <cstdio>

namespace splash::program {
namespace {

unsigned at(std::string_view text, std::size_t index) {
  return index < text.size() ? static_cast<unsigned char>(text[index]) : 0U;
}

bool continues(std::string_view text, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    if ((at(text, i) & 0xC0U) != 0x80U) return false;
  }
  return true;
}

/// Bytes of the printable character at the head of `text`; 0: there is none.
std::size_t printable_length(std::string_view text) {
  const unsigned first = at(text, 0);
  const unsigned second = at(text, 1);
  if (first < 0x80U) return first >= 0x20U && first != 0x7FU ? 1 : 0;
  if (first >= 0xC2U && first <= 0xDFU) {
    const bool control = first == 0xC2U && second < 0xA0U;
    return continues(text, 1, 2) && !control ? 2 : 0;
  }
  if (first >= 0xE0U && first <= 0xEFU) {
    const bool too_long = first == 0xE0U && second < 0xA0U;
    const bool surrogate = first == 0xEDU && second > 0x9FU;
    return continues(text, 1, 3) && !too_long && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0U && first <= 0xF4U) {
    const bool too_long = first == 0xF0U && second < 0x90U;
    const bool beyond = first == 0xF4U && second > 0x8FU;
    return continues(text, 1, 4) && !too_long && !beyond ? 4 : 0;
  }
  return 0;
}

}  // namespace

bool is_printable(std::string_view text) noexcept {
  while (!text.empty()) {
    const bool layout = text.front() == '\n' || text.front() == '\t';
    const std::size_t length = layout ? 1 : printable_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    std::array<char, 5> code{};
    std::snprintf(code.data(), code.size(), "\\x%02x", at(text, 0));
    const std::string_view shown = length > 0 ? text.substr(0, length) : code.data();
    if (out.size() + shown.size() > longest) return out + "...";
    out += shown;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

}  // namespace splash::program
