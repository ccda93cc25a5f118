// Elements of DICOM files, for tests that write such.
#pragma once

#include <cstdint>
#include <string>

#include "byte_string.h"

namespace isostar::native {

/// One explicit little-endian element.
inline std::string element(uint16_t group, uint16_t number, const std::string& kind,
                           std::string value) {
  if (value.size() % 2 != 0) value += kind == "UI" ? '\0' : ' ';
  const bool longForm = kind == "OB" || kind == "OW";
  return bytesOf(group) + bytesOf(number) + kind +
         (longForm ? std::string(2, '\0') + bytesOf(static_cast<uint32_t>(value.size()))
                   : bytesOf(static_cast<uint16_t>(value.size()))) +
         value;
}

inline std::string element(uint16_t group, uint16_t number, uint16_t value) {
  return element(group, number, "US", bytesOf(value));
}

}  // namespace isostar::native
