#include "cli/messages.h"

#include <cstdio>

#include "files/text.h"

namespace isostar::native {

void printMessage(const std::string& message) {
  std::fprintf(stderr, "isostar: %s\n", printable(message).c_str());
}

void warn(const std::string& message) {
  printMessage("warning: " + message);
}

}  // namespace isostar::native
