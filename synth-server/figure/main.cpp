// SPDX-License-Identifier: MIT
// splash-figure: draws a plunge's signal by component, and its spectrogram; or a log's events and
// the level of each channel over time.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "synth-server/figure/components.hpp"
#include "synth-server/figure/event_figure.hpp"
#include "synth-server/figure/gnuplot.hpp"
#include "synth-server/figure/plunge_figure.hpp"

namespace {

// sysexits.h
constexpr int kUsage = 64;
constexpr int kBadData = 65;
constexpr int kUnavailable = 69;

struct Options {
  splash::synth::ComponentFiles files;
  std::string out;
  splash::synth::FigureSettings figure;
  splash::synth::EventFigure events;
};

void declare(CLI::App& app, Options& options) {
  auto* impact = app.add_option("--impact", options.files.impact, "WAV file of the impacts");
  auto* bubble = app.add_option("--bubble", options.files.bubble, "WAV file of the bubbles");
  auto* cavity = app.add_option("--cavity", options.files.cavity, "WAV file of the cavities");
  impact->needs(bubble)->needs(cavity);
  auto* levels = app.add_option("--levels", options.events.levels,
                                "with --events: WAV file of what was rendered of the log, with "
                                "all its channels");
  app.add_option("--events", options.events.events,
                 "an event log: the picture is of its events, and of each channel's level")
      ->needs(levels)
      ->excludes(impact);
  app.add_option("--played", options.files.played,
                 "WAV file of what was played: the picture is of it, the components lie over it");
  app.add_option("--out", options.out, "PNG file to write")->required();
  app.add_option("--title", options.figure.title, "headline")->capture_default_str();
  app.add_option("--from", options.figure.from, "first moment to draw [s]")->capture_default_str();
  app.add_option("--to", options.figure.to, "last moment to draw [s]; the end, if not given");
  app.add_option("--lowest", options.figure.lowest, "lowest frequency [Hz]")->capture_default_str();
  app.add_option("--highest", options.figure.highest, "highest frequency [Hz]")
      ->capture_default_str();
  app.add_option("--range", options.figure.range_db, "span of the colours [dB]")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 200.0));
}

void draw(Options options) {
  if (!options.events.events.empty()) {
    const bool untitled = options.figure.title == splash::synth::FigureSettings{}.title;
    options.events.title =
        untitled ? options.events.events.filename().string() : options.figure.title;
    options.events.range_db = options.figure.range_db;
    splash::synth::draw_events(options.events, options.out);
    return;
  }
  const splash::synth::Components components = splash::synth::read_components(options.files);
  splash::synth::draw_plunge(components, options.figure, options.out);
}

int run(int argc, char** argv) {
  CLI::App app{"splash-figure: a plunge's signal by component, and its spectrogram"};
  Options options;
  declare(app, options);
  try {
    app.parse(argc, argv);
    if (options.events.events.empty() && options.files.impact.empty()) {
      throw CLI::RequiredError("--impact, --bubble and --cavity, or --events and --levels: they");
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsage;
  }
  draw(options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const splash::synth::GnuplotError& error) {
    std::cerr << "splash-figure: " << error.what() << '\n';
    return kUnavailable;
  } catch (const std::exception& error) {
    std::cerr << "splash-figure: " << error.what() << '\n';
    return kBadData;
  }
}
