#pragma once

#include <cstdint>
#include <string>

namespace isostar::native {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// "14.8 MB": three significant digits, decimal units.
std::string readableBytes(uint64_t bytes);

/// What a library said, as one line without a full stop.
std::string oneLine(std::string words);

/// The extension in lower case, ".nii.gz" in one piece; empty where there is none.
std::string extensionOf(const std::string& path);

}  // namespace isostar::native
