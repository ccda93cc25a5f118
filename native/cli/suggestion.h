#pragma once

#include <string>

namespace CLI {
class App;
}

namespace isostar::native {

/// "unknown option --max-eror, did you mean --max-error?": suggests the most similar name of the
/// command, if one is similar.
std::string describeUnknown(const CLI::App& command, const std::string& argument);

}  // namespace isostar::native
