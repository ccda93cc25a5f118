#include "cli/messages.h"

#include <cstdio>

namespace isostar::native {

void printMessage(const std::string& message) {
  std::fprintf(stderr, "isostar: %s\n", message.c_str());
}

void warn(const std::string& message) {
  printMessage("warning: " + message);
}

}  // namespace isostar::native
