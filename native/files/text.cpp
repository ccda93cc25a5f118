#include "files/text.h"

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <filesystem>

namespace isostar::native {

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

std::string extensionOf(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::string last = std::filesystem::path(name).extension().string();
  if (last != ".gz") return last;
  return std::filesystem::path(name).stem().extension().string() + last;
}

}  // namespace isostar::native
