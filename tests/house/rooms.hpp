// SPDX-License-Identifier: MIT
// Who may know whom: the house's plan as a table, one row per room.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splash::house {

/// A folder of sources, without those below it; the folders (with a / at the end: and all below
/// them) or single headers it may include besides its own; and the outer libraries (by the start of
/// their header names) it may use besides the C++ library.
struct Room {
  std::string_view folder;
  std::vector<std::string_view> knows;
  std::vector<std::string_view> libraries;
};

/// The rows, in the order in which data flows.
const std::vector<Room>& rooms();

/// Outer libraries that belong to some rooms only: a room whose row does not name one may not
/// include it. Kept from the rows above.
std::vector<std::string_view> guarded_libraries();

/// Headers that stand for the operating system, threads, locks or streams: none of them may be
/// known where audio is rendered.
const std::vector<std::string_view>& banned_while_rendering();

/// True for the rooms whose code runs inside the audio callback.
bool renders(std::string_view room);

/// Empty when `room` may include `header`, else the sentence that says why not.
std::string complaint(std::string_view room, std::string_view header);

/// Empty when a target of `room` may link a target that `other` defines, else why not.
std::string link_complaint(std::string_view room, std::string_view other);

}  // namespace splash::house
