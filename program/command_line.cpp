// SPDX-License-Identifier: MIT
#include "program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "program/text.hpp"

namespace splash::program {

namespace {

constexpr std::size_t kLongest = 64;  ///< of a word that is told [bytes]

int refuse(const CLI::App& app, const std::string& text) {
  const std::string& name = app.get_name();
  std::cerr << name << ": " << text << " (" << name << " --help lists the options)\n";
  return kExitUsage;
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
  return names;
}

}  // namespace

std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv,
                                     const std::function<void()>& take) {
  try {
    app.parse(argc, argv);
    take();
  } catch (const CLI::Success& help) {
    return app.exit(help) == 0 ? kExitOk : kExitUsage;
  } catch (const CLI::ExtrasError&) {
    return refuse(app, unknown_option(app.remaining(), names_of(app)));
  } catch (const CLI::ParseError& error) {
    return refuse(app, error.what());
  } catch (const std::invalid_argument& error) {
    return refuse(app, error.what());
  }
  return {};
}

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
