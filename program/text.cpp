// SPDX-License-Identifier: MIT
// UTF-8 as RFC 3629 has it: table 3-7 of the Unicode standard, "well-formed byte sequences".
#include "program/text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdarg>
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
    const std::string shown =
        length > 0 ? std::string(text.substr(0, length)) : format("\\x%02x", at(text, 0));
    if (out.size() + shown.size() > longest) return out + "...";
    out += shown;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

std::string lower(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

void TextLimit::print(const std::string& line, double now,
                      const std::function<void(const std::string&)>& print) {
  left_ = std::min(kBurst, left_ + kRate * std::max(0.0, now - filled_));
  filled_ = now;
  const auto size = static_cast<double>(line.size() + 1);
  if (size > left_) {
    ++left_out_;
    return;
  }
  left_ -= size;
  if (left_out_ > 0) print("(" + std::to_string(left_out_) + " lines too many were left out)");
  left_out_ = 0;
  print(line);
}

// NOLINTNEXTLINE(cert-dcl50-cpp): the compiler checks the arguments as it does printf's
std::string format(const char* pattern, ...) {
  std::va_list arguments;
  std::va_list again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, pattern, arguments);
  std::string text(static_cast<std::size_t>(std::max(size, 0)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

// Edit distance with swaps of neighbours (optimal string alignment; Damerau 1964).

namespace {

constexpr std::size_t kLongestName = 64;  // longer ones are not worth their quadratic cost

std::string folded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    out += lower == '-' || lower == ' ' ? '_' : lower;
  }
  return out;
}

std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> two_back(b.size() + 1);
  std::vector<std::size_t> back(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) back[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({back[j] + 1, row[j - 1] + 1, back[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    two_back.swap(back);
    back.swap(row);
  }
  return back[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& wrong, const std::vector<std::string>& known) {
  std::string best;
  if (wrong.empty() || wrong.size() > kLongestName) return best;
  std::size_t least = kLongestName;
  for (const auto& name : known) {
    const std::size_t apart = distance(folded(wrong), folded(name));
    if (apart < least && apart <= std::max<std::size_t>(1, name.size() / 3)) {
      least = apart;
      best = name;
    }
  }
  return best;
}

}  // namespace splash::program
