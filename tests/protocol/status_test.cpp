// SPDX-License-Identifier: MIT
#include "protocol/status.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocol/control.hpp"
#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

// Each field a value of its own, so that a swap shows.
SynthStatus synth_status() {
  return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10.5F, 11.5F, 48000.0F, 13, 0.25F, 15, 16};
}
SimStatus sim_status() {
  return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1.25F, 240.0F, 0.01F, 14, 15};
}

/// Behind the program's name.
void expect_numbers(const Message& message, const std::vector<double>& numbers) {
  ASSERT_EQ(message.arguments.size(), 1 + numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Argument& argument = message.arguments[1 + i];
    const auto* whole = std::get_if<std::int32_t>(&argument);
    const double number =
        whole != nullptr ? *whole : static_cast<double>(std::get<float>(argument));
    EXPECT_NEAR(number, numbers[i], 1e-9) << i;
  }
}

TEST(Status, ComesBackAndFitsTheGate) {
  for (const auto& message : {to_message(synth_status()), to_message(sim_status())}) {
    const auto decoded = decode(encode(message));
    ASSERT_EQ(decoded.packet.messages.size(), 1U);
    EXPECT_EQ(decoded.packet.messages[0], message);
    EXPECT_FALSE(violation(message)) << *violation(message);
    EXPECT_LE(message.arguments.size(), kMaxArguments);
  }
  EXPECT_EQ(to_synth_status(to_message(synth_status())), synth_status());
  EXPECT_EQ(to_sim_status(to_message(sim_status())), sim_status());
  EXPECT_FALSE(to_sim_status(to_message(synth_status())));
  EXPECT_FALSE(to_synth_status(to_message(sim_status())));
}

TEST(Status, NamesOfTheTableAreInTheStructsOrder) {
  const std::vector<std::string_view> synth = {
      "voices",   "events",  "late",    "early",       "lost",     "duplicates",
      "refused",  "dropped", "xruns",   "cpu_average", "cpu_peak", "sample_rate",
      "silenced", "level",   "loudest", "most_voices"};
  const std::vector<std::string_view> sim = {"particles",        "steps",
                                             "impacts",          "bubbles",
                                             "cavities",         "late",
                                             "unsent",           "refused",
                                             "resets",           "skipped",
                                             "real_time_factor", "steps_per_second",
                                             "density_error",    "bubble_particles",
                                             "thinned"};
  const auto names = [](std::span<const ArgumentRow> fields) {
    std::vector<std::string_view> all;
    for (const ArgumentRow& field : fields.subspan(1)) all.push_back(field.name);  // the program's
    return all;
  };
  EXPECT_EQ(names(synth_status_fields()), synth);
  EXPECT_EQ(names(sim_status_fields()), sim);
  expect_numbers(to_message(synth_status()),
                 {1, 2, 3, 4, 5, 6, 7, 8, 9, 10.5, 11.5, 48000, 13, 0.25, 15, 16});
  expect_numbers(to_message(sim_status()),
                 {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1.25, 240, 0.01, 14, 15});
}

TEST(Status, CountersWrapAndFloatsStayInRange) {
  SimStatus status;
  status.steps = (1ULL << 40U) + 5;
  status.real_time_factor = std::numeric_limits<float>::quiet_NaN();
  status.steps_per_second = std::numeric_limits<float>::infinity();
  const auto back = to_sim_status(to_message(status));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->steps, 5U);
  EXPECT_EQ(back->real_time_factor, 0.0F);
  EXPECT_EQ(back->steps_per_second, 1e6F);
}

TEST(Status, ANewerSenderMaySayMore) {
  auto message = to_message(synth_status());
  message.arguments.emplace_back(99);
  EXPECT_EQ(to_synth_status(message), synth_status());
  message.arguments.resize(13);
  EXPECT_FALSE(to_synth_status(message));
}

TEST(Control, RepliesFitTheTable) {
  const std::vector<Message> replies = {
      done("/notify", 3),        done("/quit"),
      fail("/sync", "no"),       synced(-7),
      ping(TimeTag{5}),          pong(TimeTag{1}, TimeTag{2}, TimeTag{3}),
      version_reply(kSimProgram)};
  for (const auto& reply : replies) {
    EXPECT_FALSE(violation(reply)) << *violation(reply);
    EXPECT_EQ(gate(encode(reply)), Refusal::none);
  }
  EXPECT_EQ(done("/quit").arguments.size(), 1U);
  EXPECT_EQ(std::get<std::int32_t>(done("/notify", 3).arguments.at(1)), 3);
}

TEST(Control, FailureTextsAreMadeFitForTheWire) {
  const auto reply = fail("/b\n", std::string(100, 'x') + "\xff");
  EXPECT_EQ(std::get<std::string>(reply.arguments.at(0)), "/b?");
  EXPECT_EQ(std::get<std::string>(reply.arguments.at(1)), std::string(64, 'x'));
  EXPECT_EQ(std::get<std::string>(fail("/a", "\xc3\xa9").arguments.at(1)), "??");
}

}  // namespace
}  // namespace splash::protocol
