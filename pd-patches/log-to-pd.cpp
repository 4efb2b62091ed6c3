// SPDX-License-Identifier: MIT
// log-to-pd: turns an event log into the text that offline.pd renders, and prints the command.
#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

#include "pd-patches/event_list.hpp"
#include "program/command_line.hpp"

namespace {

struct Options {
  std::string log;
  std::string list;
  double sample_rate = 48000.0;  // [Hz]
  double tail = 2.0;             // [s]
};

int convert(const Options& options) {
  const auto log = splash::protocol::read_log(options.log);
  std::ofstream file(options.list);
  if (!file) {
    std::cerr << "log-to-pd: cannot create '" << options.list
              << "': does its folder exist, may you write there?\n";
    return 1;
  }
  const auto report = splash::pd::write_event_list(log, options.sample_rate, file);
  if (!file.flush()) {
    std::cerr << "log-to-pd: cannot write '" << options.list << "': is the disk full?\n";
    return 1;
  }
  const auto frames = report.last_sample + std::llround(options.tail * options.sample_rate);
  std::cout << report.events << " events in " << log.size() << " bundles, " << frames
            << " frames with the tail. Render them with\n  pd -batch -nogui -noaudio -r "
            << std::llround(options.sample_rate) << " -open pd-patches/offline.pd -send "
            << "\"splash-render " << options.list << " out.wav " << frames << "\"\n"
            << "(relative paths begin at the patch's folder)\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Turns an event log into a text that pd-patches/offline.pd renders."};
  Options options;
  app.add_option("log", options.log, "event log, as sim-server --record writes it")->required();
  app.add_option("list", options.list, "text to write")->required();
  app.add_option("--rate", options.sample_rate, "sample rate of the rendering [Hz]")
      ->check(CLI::Range(8000.0, 384000.0))
      ->check(splash::program::refuse_nan)
      ->capture_default_str();
  app.add_option("--tail", options.tail, "rendered after the last event [s]")
      ->check(CLI::Range(0.0, 3600.0))
      ->check(splash::program::refuse_nan)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return convert(options);
  } catch (const std::exception& error) {
    std::cerr << "log-to-pd: " << error.what() << '\n';
    return 1;
  }
}
