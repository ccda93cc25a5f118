#pragma once

#include <cstdint>
#include <string>

namespace isostar::native {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// "14.8 MB": three significant digits, decimal units.
std::string readableBytes(uint64_t bytes);

/// The message of a library as one line without a full stop.
std::string oneLine(std::string message);

/// The text as a terminal may show it: control characters, bytes that are not UTF-8 and characters
/// that change the direction of text become escapes such as \\n, \\x1b and \\u202e.
std::string printable(const std::string& text);

/// The file extension in lower case; ".nii.gz" counts as one extension. Empty if there is none.
std::string extensionOf(const std::string& path);

}  // namespace isostar::native
