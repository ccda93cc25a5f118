#pragma once

#include <string>

namespace CLI {
class App;
}

namespace isostar::native {

/// "unknown option --max-eror, did you mean --max-error?": the nearest name the command knows, if
/// any is near.
std::string describeUnknown(const CLI::App& command, const std::string& argument);

}  // namespace isostar::native
