// SPDX-License-Identifier: MIT
// Structs that host and kernels share stand once, in a header that both include, followed by
// SPLASH_SHARED_STRUCT with their size: each compiler of either side checks it. With members of 4
// bytes only, none can pad, and the offsets are the same as well (tests/sim-server/fluid/
// shared_struct_test.cpp asks the device for them).
#ifndef SPLASH_SHARED_STRUCT_H
#define SPLASH_SHARED_STRUCT_H

#ifdef __cplusplus
#include <cstddef>
#include <string_view>

namespace splash::sim {

/// What kernels call a type in their parameters; types without a name here are not passed to them.
template <class T>
inline constexpr std::string_view kKernelType{};
template <>
inline constexpr std::string_view kKernelType<int> = "int";
template <>
inline constexpr std::string_view kKernelType<unsigned> = "uint";
template <>
inline constexpr std::string_view kKernelType<float> = "float";
/// Memory that kernels keep their own structs in, of any type.
inline constexpr std::string_view kAnyKernelType = "any";
template <>
inline constexpr std::string_view kKernelType<std::byte> = kAnyKernelType;

/// A number in the precision of the kernels.
[[nodiscard]] inline float as_float(double value) {
  return static_cast<float>(value);
}

}  // namespace splash::sim

#define SPLASH_SHARED_STRUCT(type, bytes)                                        \
  static_assert(sizeof(type) == (bytes), #type " has another size on the host"); \
  template <>                                                                    \
  inline constexpr std::string_view kKernelType<type> = #type;
#else
#define SPLASH_SHARED_STRUCT(type, bytes) \
  typedef char type##_has_its_size[sizeof(type) == (bytes) ? 1 : -1];
#endif

#endif
