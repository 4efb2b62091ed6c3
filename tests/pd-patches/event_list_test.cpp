// SPDX-License-Identifier: MIT
// The text that Pd plays holds the log's events, on the samples of synth-server's replay.
#include "pd-patches/event_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "program/failure.hpp"

namespace splash::pd {
namespace {

using protocol::Bubble;
using protocol::Cavity;
using protocol::Event;
using protocol::Frame;
using protocol::Impact;
using protocol::LogEntry;
using protocol::to_message;

TEST(EventList, HoldsOneLinePerEventInTheOrderOfTheirSamples) {
  const std::vector<LogEntry> log = {
      {0.010,
       {to_message(Frame{7, 0, 3, 20.0F}),
        to_message(Impact{4, 1, 1.5F, 1.25F, {0.5F, 0.25F, -0.125F}, 2.0F}),
        to_message(Bubble{9, -1, 0.0078125F, 0.0625F, {1.0F, 2.0F, 3.0F}, 0.0F})}},
      {0.020, {to_message(Cavity{2, 0, 0.125F, 0.125F, {0.0F, 0.0F, 0.0F}, 0.0F})}},
      {0.030, {to_message(Cavity{3, 0, 0.125F, 0.0078125F, {0.0F, 0.0F, 0.0F}, 0.0F, 0.25F})}}};
  std::ostringstream text;
  const auto report = write_event_list(log, 8000.0, text);
  EXPECT_EQ(text.str(),
            "10 bubble 9 -1 0.0078125 0.0625 1 2 3;\n"
            "2 impact 4 1 1.5 1.25 0.5 0.25 -0.125;\n"
            "8 cavity 2 0 0.125 0.125 0 0 0;\n"
            "10 cavity 3 0 0.125 0.0078125 0 0 0 0.25;\n");
  EXPECT_EQ(report.events, 4U);
  EXPECT_EQ(report.not_events, 1U);
  EXPECT_EQ(report.last_sample, 240);
}

TEST(EventList, RoundedDeltasDoNotDrift) {
  std::vector<LogEntry> log;
  for (int i = 1; i <= 20000; ++i) {
    log.push_back({i * 0.0123457, {to_message(Bubble{i, -1, 0.01F, 0.1F, {}, 0.0F})}});
  }
  std::stringstream text;
  write_event_list(log, 44100.0, text);
  double sum = 0.0;
  double largest = 0.0;
  std::string line;
  for (int i = 1; std::getline(text, line); ++i) {
    sum += static_cast<double>(std::stof(line));  // as Pd reads and adds it
    const double due = 1000.0 * std::round(i * 0.0123457 * 44100.0) / 44100.0;
    largest = std::max(largest, std::abs(sum - due));
  }
  EXPECT_LT(largest, 1e-6);  // [ms]; a sample is 0.02
}

TEST(EventList, RefusesRatesThatNoDeviceHas) {
  std::ostringstream text;
  for (const double rate : {0.0, 7999.0, 1e6, std::nan("")}) {
    EXPECT_THROW(write_event_list({}, rate, text), std::invalid_argument) << rate;
  }
}

TEST(EventList, RefusesALogOfMoreThanAWeek) {
  std::ostringstream text;
  const std::vector<LogEntry> log = {
      {8.0 * 86400.0, {to_message(Bubble{1, -1, 0.01F, 0.1F, {}, 0.0F})}}};
  EXPECT_THROW(write_event_list(log, 48000.0, text), program::DataError);
}

}  // namespace
}  // namespace splash::pd
