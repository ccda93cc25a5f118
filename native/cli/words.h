#pragma once

#include <string>

namespace isostar::native {

/// Words go to standard error, results to standard output.
void say(const std::string& words);
void warn(const std::string& words);

}  // namespace isostar::native
