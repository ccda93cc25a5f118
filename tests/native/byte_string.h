#pragma once

#include <string>
#include <vector>

namespace isostar::native {

/// The bytes of a value as they lie in memory.
template <class Value>
std::string bytesOf(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class Value>
std::string bytesOf(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// 0, 1, 2 …: every sample states its place.
template <class Value>
std::vector<Value> counting(size_t count) {
  std::vector<Value> values(count);
  for (size_t i = 0; i < count; ++i) values[i] = static_cast<Value>(i);
  return values;
}

}  // namespace isostar::native
