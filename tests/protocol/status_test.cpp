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

double value_of(const Message& message, std::span<const ArgumentRow> fields, const char* name) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].name != name) continue;
    if (const auto* whole = std::get_if<std::int32_t>(&message.arguments.at(i))) return *whole;
    return static_cast<double>(std::get<float>(message.arguments.at(i)));
  }
  ADD_FAILURE() << "no field " << name;
  return std::nan("");
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
  const auto synth = to_message(synth_status());
  const auto fields = synth_status_fields();
  ASSERT_EQ(fields.size(), synth.arguments.size());
  EXPECT_EQ(value_of(synth, fields, "voices"), 1);
  EXPECT_EQ(value_of(synth, fields, "events"), 2);
  EXPECT_EQ(value_of(synth, fields, "late"), 3);
  EXPECT_EQ(value_of(synth, fields, "early"), 4);
  EXPECT_EQ(value_of(synth, fields, "lost"), 5);
  EXPECT_EQ(value_of(synth, fields, "duplicates"), 6);
  EXPECT_EQ(value_of(synth, fields, "refused"), 7);
  EXPECT_EQ(value_of(synth, fields, "dropped"), 8);
  EXPECT_EQ(value_of(synth, fields, "xruns"), 9);
  EXPECT_EQ(value_of(synth, fields, "cpu_average"), 10.5);
  EXPECT_EQ(value_of(synth, fields, "cpu_peak"), 11.5);
  EXPECT_EQ(value_of(synth, fields, "sample_rate"), 48000);
  EXPECT_EQ(value_of(synth, fields, "silenced"), 13);
  EXPECT_EQ(value_of(synth, fields, "level"), 0.25);
  EXPECT_EQ(value_of(synth, fields, "loudest"), 15);
  EXPECT_EQ(value_of(synth, fields, "most_voices"), 16);
  const auto sim = to_message(sim_status());
  ASSERT_EQ(sim_status_fields().size(), sim.arguments.size());
  EXPECT_EQ(value_of(sim, sim_status_fields(), "particles"), 1);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "steps"), 2);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "impacts"), 3);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "bubbles"), 4);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "cavities"), 5);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "late"), 6);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "unsent"), 7);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "refused"), 8);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "resets"), 9);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "skipped"), 10);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "real_time_factor"), 1.25);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "steps_per_second"), 240);
  EXPECT_NEAR(value_of(sim, sim_status_fields(), "density_error"), 0.01, 1e-9);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "bubble_particles"), 14);
  EXPECT_EQ(value_of(sim, sim_status_fields(), "thinned"), 15);
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
