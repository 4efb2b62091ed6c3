// SPDX-License-Identifier: MIT
// Structs of numbers to messages and back, by the order that each struct tells; types and ranges
// are the address table's.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "protocol/address.hpp"
#include "protocol/message.hpp"

namespace splash::protocol {
namespace {

constexpr float kLengthError = 0.1F;  // of a quaternion [1]
constexpr float kRounding = 1.0e-6F;  // of a quaternion of unit length in floats [1]

// Takes the arguments of a message that conforms to its row, one after the other; what is missing
// at the end is optional and stays as it is.
class Taker {
 public:
  explicit Taker(const Message& message) : message_(message) {}
  template <class Value>
  void operator()(Value& value) {
    if (index_ < message_.arguments.size()) value = std::get<Value>(message_.arguments[index_++]);
  }

 private:
  const Message& message_;
  std::size_t index_ = 0;
};

// Compares the values with their rows, one after the other.
class Checker {
 public:
  Checker(const AddressRow& row, bool& good) : row_(row), good_(good) {}
  template <class Value>
  void operator()(const Value& value) {
    good_ = in_range(value, row_.arguments[index_++]) && good_;
  }

 private:
  const AddressRow& row_;
  bool& good_;
  std::size_t index_ = 0;
};

class Giver {
 public:
  explicit Giver(Message& message) : message_(message) {}
  template <class Value>
  void operator()(const Value& value) {
    message_.arguments.emplace_back(value);
  }

 private:
  Message& message_;
};

// Calls `visit` with all numbers in the order of the message's arguments. `Record` is const when
// giving, not when taking.
template <class Record, class Visit>
void visit_arguments(Record& record, Visit visit) {
  std::apply([&visit](auto&... values) { (visit(values), ...); }, Record::arguments(record));
}

template <class Record>
Message give(const Record& record) {
  Message message{Record::kAddress, {}};
  message.arguments.reserve(10);
  visit_arguments(record, Giver(message));
  return message;
}

/// Of a message that conforms to the record's row.
template <class Record>
Record read(const Message& message) {
  Record record;
  visit_arguments(record, Taker(message));
  return record;
}

template <class Record>
std::optional<Record> take(const Message& message) {
  const auto* row = find_address(Record::kAddress);
  if (row == nullptr || !conforms(message, *row)) return std::nullopt;
  return read<Record>(message);
}

/// As the kind whose address it has.
template <std::size_t... kinds>
std::optional<Event> take_any(const Message& message, std::index_sequence<kinds...> /*all*/) {
  std::optional<Event> event;
  const auto try_kind = [&](auto kind) {
    if (message.address != kind.kAddress) return false;
    if (const auto taken = take<decltype(kind)>(message)) event = *taken;
    return true;
  };
  static_cast<void>((try_kind(std::variant_alternative_t<kinds, Event>()) || ...));
  return event;
}

constexpr std::size_t kOffsetIndex = 7;  // of offset_ms in each kind of event

template <class Kind>
constexpr bool has_offset(const Kind& event) {
  return &std::get<kOffsetIndex>(Kind::arguments(event)) == &event.offset_ms;
}

template <std::size_t... kinds>
constexpr bool all_have_offset(std::index_sequence<kinds...> /*all*/) {
  return (has_offset(std::variant_alternative_t<kinds, Event>()) && ...);
}

}  // namespace

Message to_message(const Frame& frame) {
  return give(frame);
}
Message to_message(const BodyPose& pose) {
  return give(pose);
}
Message to_message(const Push& push) {
  return give(push);
}

Message to_message(const Event& event) {
  return std::visit([](const auto& one) { return give(one); }, event);
}

std::optional<Event> to_event(const Message& message) {
  return take_any(message, std::make_index_sequence<kEventKinds>());
}

bool is_event(std::string_view address) {
  return std::any_of(kKindNames.begin(), kKindNames.end(),
                     [&](const KindNames& kind) { return address == kind.address; });
}

bool conforms(const Event& event) noexcept {
  return std::visit(
      [](const auto& record) {
        bool good = true;
        visit_arguments(record, Checker(*find_address(record.kAddress), good));
        return good;
      },
      event);
}

void set_offset(Message& event, float offset_ms) {
  static_assert(all_have_offset(std::make_index_sequence<kEventKinds>()));
  event.arguments[kOffsetIndex] = offset_ms;
}

std::optional<Frame> to_frame(const Message& message) {
  return take<Frame>(message);
}

std::optional<Push> to_push(const Message& message) {
  return take<Push>(message);
}

std::optional<BodyPose> to_body_pose(const Message& message) {
  const auto* row = find_address(BodyPose::kAddress);
  return row != nullptr && conforms(message, *row) ? conforming_pose(message) : std::nullopt;
}

std::optional<BodyPose> conforming_pose(const Message& message) {
  auto pose = read<BodyPose>(message);
  // Trackers round, filter and blend: what is off by little is brought to unit length. Much is no
  // rotation.
  const float size = std::hypot(std::hypot(pose.qx, pose.qy), std::hypot(pose.qz, pose.qw));
  if (size < 1.0F - kLengthError || size > 1.0F + kLengthError) return std::nullopt;
  if (std::abs(size - 1.0F) < kRounding) return pose;
  for (float* part : {&pose.qx, &pose.qy, &pose.qz, &pose.qw}) *part /= size;
  return pose;
}

}  // namespace splash::protocol
