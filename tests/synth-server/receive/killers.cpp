// SPDX-License-Identifier: MIT
#include "tests/synth-server/receive/killers.hpp"

#include <string_view>

#include "protocol/message.hpp"

namespace splash::synth {
namespace {

using namespace std::string_view_literals;

std::vector<std::byte> raw(std::string_view text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

/// A float argument with these bits.
std::vector<std::byte> with_float(std::string_view bits) {
  return raw(std::string("/x\0\0,f\0\0", 8) + std::string(bits));
}

std::vector<std::byte> nested(int levels) {
  std::string text = std::string("/x\0\0,\0\0\0", 8);
  for (int level = 0; level < levels; ++level) {
    const auto size = static_cast<unsigned>(text.size());
    std::string head("#bundle\0\0\0\0\0\0\0\0\1", 16);
    for (int shift = 24; shift >= 0; shift -= 8) {
      head += static_cast<char>(size >> static_cast<unsigned>(shift) & 0xFFU);
    }
    text = head + text;
  }
  return raw(text);
}

std::string bundle_with_element(std::string_view size, std::string_view rest) {
  return std::string("#bundle\0\0\0\0\0\0\0\0\1", 16) + std::string(size) + std::string(rest);
}

}  // namespace

std::vector<Killer> killers() {
  return {
      {"a word: ends oscpack's listener", raw("hello")},
      {"an address that is not closed", raw("/abc")},
      {"nothing at all", {}},
      {"a 2 GB blob in 12 bytes", raw("/b\0\0,b\0\0\x7f\xff\xff\xf0"sv)},
      {"a blob without its size", raw("/b\0\0,b\0\0"sv)},
      {"the 20 bytes that hang oscpack", raw(bundle_with_element("\xff\xff\xff\xfc"sv, ""))},
      {"an element of size zero", raw(bundle_with_element("\0\0\0\0"sv, ""))},
      {"an element of odd size", raw(bundle_with_element("\0\0\0\3"sv, "/x\0"sv))},
      {"an element past the end", raw(bundle_with_element("\0\0\1\0"sv, "/x\0\0,\0\0\0"sv))},
      {"an array that closes first", raw("/x\0\0,][\0"sv)},
      {"a pattern bomb", raw("*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?*?q\0,\0\0\0"sv)},
      {"3200 bundles in each other", nested(3200)},
      {"two bundles in each other", nested(2)},
      {"no type string", raw("/x\0\0"sv)},
      {"not a number", with_float("\x7f\xc0\0\0"sv)},
      {"infinity", with_float("\x7f\x80\0\0"sv)},
      {"minus infinity", with_float("\xff\x80\0\0"sv)},
      {"arguments cut off", raw("/x\0\0,ff\0\x3f\x80\0\0"sv)},
      {"bytes left over", raw("/x\0\0,\0\0\0\0\0\0\0"sv)},
      {"padding that is not zero", raw("/x\0y,\0\0\0"sv)},
      {"5000 bytes", std::vector<std::byte>(5000, std::byte{'a'})},
      {"the largest datagram", std::vector<std::byte>(65507, std::byte{0})},
  };
}

}  // namespace splash::synth
