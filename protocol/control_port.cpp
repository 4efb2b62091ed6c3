// SPDX-License-Identifier: MIT
#include "protocol/control_port.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>
#include <variant>

#include "program/text.hpp"
#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"

namespace splash::protocol {

namespace {

/// The first argument of a message that conforms to its row.
std::int32_t first_integer(const Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}

/// Replies and events are never answered, lest two programs answer each other for ever.
bool is_never_answered(const AddressRow& row) noexcept {
  return row.direction == Direction::reply || row.direction == Direction::subscribers ||
         row.direction == Direction::to_synth;
}

}  // namespace

Outcome done_unless(const std::string& refused, const Message& command) {
  if (!refused.empty()) return {.refused = refused};
  return {.reply = done(command.address)};
}

ControlPort::ControlPort(Settings settings, std::function<void()> quit)
    : settings_(std::move(settings)) {
  on("/version", [this](const Message&, const Visit&) {
    return Outcome{.reply = version_reply(settings_.program)};
  });
  // Commands are carried out in their order: nothing is left to wait for.
  on("/sync", [](const Message& message, const Visit&) {
    return Outcome{.reply = synced(first_integer(message))};
  });
  on("/ping", [](const Message& message, const Visit& visit) {
    return Outcome{.reply = pong(std::get<TimeTag>(message.arguments.front()),
                                 to_time_tag(visit.unix_time), to_time_tag(unix_now()))};
  });
  on("/dumpOSC", [this](const Message& message, const Visit&) {
    dump_level_ = static_cast<unsigned>(first_integer(message));
    return done_unless({}, message);
  });
  on("/error", [this](const Message& message, const Visit&) {
    reports_failures_ = first_integer(message) != 0;
    return done_unless({}, message);
  });
  on("/quit", [quit = std::move(quit)](const Message& message, const Visit& visit) {
    if (!is_loopback(visit.from)) return Outcome{.refused = "only from the program's own host"};
    if (!quit) return Outcome{.refused = "this program does not end on request"};
    quit();
    return done_unless({}, message);
  });
}

void ControlPort::on(const std::string& address, Command command) {
  if (find_address(address) == nullptr) {
    throw std::logic_error(address + " is not in the address table");
  }
  commands_[address] = {std::move(command)};
}

std::vector<std::string> ControlPort::missing() const {
  const Direction alone =
      settings_.program == kSimProgram ? Direction::sim_alone : Direction::synth_alone;
  std::vector<std::string> missing;
  for (const AddressRow& row : address_table()) {
    const bool ours = row.direction == Direction::to_both || row.direction == alone;
    const std::string address(row.address);
    const bool named = !missing.empty() && missing.back() == address;  // in a row of other types
    if (ours && !named && !commands_.contains(address)) missing.push_back(address);
  }
  return missing;
}

bool ControlPort::allows(const Endpoint& from) const noexcept {
  const auto& hosts = settings_.allowed;
  return is_loopback(from) || std::find(hosts.begin(), hosts.end(), from.address) != hosts.end();
}

void ControlPort::turn_away(const Endpoint& from, double now) {
  ++counts_.not_allowed;
  report(from,
         "not heard: this host is not among the allowed ones; --allow with its address lets it in",
         now);
}

bool ControlPort::inspect(Bytes bytes, const DecodeResult& read, const Endpoint& from, double now) {
  dump(bytes, read, from, now);
  if (read.refusal == Refusal::none) return true;
  ++counts_.refused[static_cast<std::size_t>(read.refusal)];
  report(from, "datagram refused: " + std::string(describe(read.refusal)), now);
  return false;
}

void ControlPort::dump(Bytes bytes, const DecodeResult& read, const Endpoint& from, double now) {
  if (dump_level_ == 0 || !settings_.print) return;
  const std::string head = to_string(from) + ' ';
  const auto print = [&](const std::string& text) {
    dumped_.print(head + text, now, settings_.print);
  };
  if ((dump_level_ & 2U) != 0) print(to_hexadecimal(bytes));
  if ((dump_level_ & 1U) == 0) return;
  if (read.refusal != Refusal::none) print("refused: " + std::string(describe(read.refusal)));
  for (const Message& message : read.packet.messages) print(to_text(message, read.packet.time));
}

void ControlPort::take(const Message& message, Visit& visit, std::vector<Reply>& replies) {
  const AddressRow* row = find_address(message.address);
  if (row != nullptr && is_never_answered(*row)) {
    ++counts_.unasked;
    return;
  }
  const Outcome outcome = carry_out(message, visit);
  if (!outcome.refused.empty()) {
    ++counts_.failed;
    report(visit.from, message.address + ": " + outcome.refused, visit.arrival);
    answer(message.address, fail(message.address, outcome.refused), visit, replies);
  } else if (outcome.reply) {
    answer(message.address, *outcome.reply, visit, replies);
  }
}

Outcome ControlPort::carry_out(const Message& message, Visit& visit) {
  try {
    const auto command = commands_.find(message.address);
    if (command != commands_.end()) {
      const auto reason = violation(message);
      if (!reason) return command->second.run(message, visit);
      ++command->second.violations;
      ++counts_.out_of_table;
      return {.refused = *reason};
    }
    if (find_address(message.address) != nullptr) {
      return {.refused = "not a command of " + settings_.program};
    }
    if (others_ && others_(message, visit)) return {};
  } catch (const std::exception& problem) {
    return {.refused = problem.what()};
  }
  ++counts_.out_of_table;
  return {.refused = unknown(message.address)};
}

std::string ControlPort::unknown(const std::string& address) const {
  std::vector<std::string> known;
  for (const auto& [name, entry] : commands_) known.push_back(name);
  const std::string nearest = program::nearest_name(address, known);
  return nearest.empty() ? "unknown command" : "unknown command, did you mean " + nearest + "?";
}

void ControlPort::answer(const std::string& command, const Message& reply, Visit& visit,
                         std::vector<Reply>& replies) {
  auto fitting = visit.budget.take(reply);
  if (!fitting) report(visit.from, visit.budget.complaint(command, reply), visit.arrival);
  RateLimit& limit = reply.address == "/pong" ? pongs_ : replies_;
  if (!fitting || !limit.allow(visit.from, visit.arrival)) {
    ++counts_.withheld;
    return;
  }
  ++counts_.replies;
  replies.push_back({visit.from, std::move(*fitting)});
}

void ControlPort::report(const Endpoint& from, const std::string& failure, double now) {
  if (!reports_failures_ || !settings_.print || !reports_.allow(from, now)) return;
  settings_.print(to_string(from) + ' ' + failure);
}

std::uint64_t ControlPort::violations(const std::string& address) const {
  const auto command = commands_.find(address);
  return command == commands_.end() ? 0 : command->second.violations;
}

namespace {

std::string text_of(std::int32_t value) {
  return std::to_string(value);
}

std::string text_of(const std::string& value) {
  return '"' + value + '"';
}

std::string text_of(float value) {
  // Nine digits name each float and no other (IEEE 754-2008, 5.12.2).
  return program::format("%.9g", static_cast<double>(value));
}

std::string text_of(TimeTag tag) {
  return program::format("%08x.%08x", static_cast<unsigned>(tag.value >> 32U),
                         static_cast<unsigned>(tag.value & 0xffffffffU));
}

}  // namespace

std::string to_text(const Message& message, const std::optional<TimeTag>& time) {
  std::string text = time ? text_of(*time) + ' ' : std::string();
  text += message.address + ' ' + type_tags(message);
  for (const auto& argument : message.arguments) {
    text += ' ' + std::visit([](const auto& value) { return text_of(value); }, argument);
  }
  return text;
}

std::string to_hexadecimal(Bytes bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[std::to_integer<unsigned>(byte >> 4)];
    text += kDigits[std::to_integer<unsigned>(byte & std::byte{0x0F})];
  }
  return text;
}

}  // namespace splash::protocol
