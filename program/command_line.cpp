// SPDX-License-Identifier: MIT
#include "program/command_line.hpp"

#include <algorithm>
#include "program/text.hpp"

namespace splash::program {

namespace {

constexpr std::size_t kLongest = 64;  ///< of a word that is told [bytes]

}  // namespace

std::string unknown_option(const std::vector<std::string>& words,
                           const std::vector<std::string>& options) {
  // What follows a mistyped option is its value: the option is the one to tell.
  const auto wrong = std::find_if(words.begin(), words.end(),
                                  [](const std::string& word) { return word.starts_with('-'); });
  if (wrong == words.end())
    return "'" + printable(words.front(), kLongest) + "' belongs to no option";
  const std::string name = wrong->substr(0, wrong->find('='));
  const std::string nearest = nearest_name(name, options);
  return "there is no option " + printable(name, kLongest) +
         (nearest.empty() ? std::string() : "; did you mean " + nearest + "?");
}

}  // namespace splash::program
