#include "files/text.h"

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace isostar::native {
namespace {

/// The length of the UTF-8 character at the start of `bytes` and its code; length 0 if there is
/// none.
struct Character {
  size_t length = 0;
  uint32_t code = 0;
};

Character characterAt(std::string_view bytes) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {1, first};
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || bytes.size() < length) return {};
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < kLeast[length] || code > 0x10ffff || surrogate ? Character{}
                                                               : Character{length, code};
}

bool isControl(uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029 ||
         (code >= 0x200e && code <= 0x200f) || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string text(const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  std::string out(std::max(0, std::vsnprintf(nullptr, 0, format, arguments)), '\0');
  std::vsnprintf(out.data(), out.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  return out;
}

std::string readableBytes(uint64_t bytes) {
  static constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  double value = static_cast<double>(bytes);
  int unit = 0;
  for (; value >= 999.5; value /= 1000) ++unit;
  const int decimals = unit == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return text("%.*f %s", decimals, value, kUnits[unit]);
}

std::string oneLine(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return std::isspace(c); }, ' ');
  const auto bothSpaces = [](char a, char b) { return a == ' ' && b == ' '; };
  message.erase(std::unique(message.begin(), message.end(), bothSpaces), message.end());
  while (!message.empty() && (message.back() == ' ' || message.back() == '.')) message.pop_back();
  message.erase(0, std::min(message.find_first_not_of(' '), message.size()));
  return message;
}

std::string printable(const std::string& bytes) {
  std::string shown;
  for (std::string_view rest = bytes; !rest.empty();) {
    const auto [length, code] = characterAt(rest);
    if (length == 0)
      shown += text("\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(rest[0])));
    else if (!isControl(code))
      shown += rest.substr(0, length);
    else if (code == '\n')
      shown += "\\n";
    else
      shown += text(code < 0x80 ? "\\x%02x" : "\\u%04x", code);
    rest.remove_prefix(std::max<size_t>(length, 1));
  }
  return shown;
}

std::string extensionOf(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::string last = std::filesystem::path(name).extension().string();
  if (last != ".gz") return last;
  return std::filesystem::path(name).stem().extension().string() + last;
}

}  // namespace isostar::native
