#pragma once

#include <charconv>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

namespace isostar::native {

inline bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

/// Removes the next word from `line` and returns it; empty at the end.
inline std::string_view nextWord(std::string_view& line) {
  size_t first = 0;
  while (first < line.size() && isBlank(line[first])) ++first;
  size_t last = first;
  while (last < line.size() && !isBlank(line[last])) ++last;
  const std::string_view word = line.substr(first, last - first);
  line.remove_prefix(last);
  return word;
}

/// Parses the whole word as a number; false if it is not one.
template <class Number>
bool parseNumber(std::string_view word, Number& number) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto result = std::from_chars(word.data(), word.data() + word.size(), number);
  return result.ec == std::errc() && result.ptr == word.data() + word.size();
}

/// Reads a file in memory as lines, words or bytes, never past its end.
class WordReader {
 public:
  explicit WordReader(std::span<const std::byte> bytes)
      : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  bool atEnd() const { return rest_.empty(); }
  size_t left() const { return rest_.size(); }
  std::string_view word() { return nextWord(rest_); }

  std::string_view line() {
    const size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  bool copy(void* to, size_t count) {
    if (rest_.size() < count) return false;
    std::memcpy(to, rest_.data(), count);
    rest_.remove_prefix(count);
    return true;
  }

 private:
  std::string_view rest_;
};

}  // namespace isostar::native
