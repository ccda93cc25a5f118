// Parts of C++20 that the codec uses and the libc++ of Debian's Emscripten 3.1.6 lacks; a newer
// libc++ switches them off. Included before every source file of the codec.
#pragma once

#include <algorithm>
#include <bit>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif

#ifndef __cpp_lib_ranges
namespace std::ranges {
template <class Range, class Predicate>
constexpr bool all_of(const Range& range, Predicate predicate) {
  return std::all_of(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
constexpr bool any_of(const Range& range, Predicate predicate) {
  return std::any_of(std::begin(range), std::end(range), predicate);
}
template <class Range>
constexpr auto min(const Range& range) {
  return *std::min_element(std::begin(range), std::end(range));
}
}  // namespace std::ranges
#endif
