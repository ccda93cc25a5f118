#pragma once

namespace isostar::native {

/// Whether a sanitizer is built in that reserves far more address space than the process uses.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kReservesAddresses = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
inline constexpr bool kReservesAddresses = true;
#else
inline constexpr bool kReservesAddresses = false;
#endif
#else
inline constexpr bool kReservesAddresses = false;
#endif

}  // namespace isostar::native
