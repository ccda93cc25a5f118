#pragma once

#include <string>

namespace isostar::native {

/// Messages go to standard error, results to standard output. What a terminal would obey is
/// escaped.
void printMessage(const std::string& message);
void warn(const std::string& message);

}  // namespace isostar::native
