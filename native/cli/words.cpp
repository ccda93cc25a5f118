#include "cli/words.h"

#include <cstdio>

namespace isostar::native {

void say(const std::string& words) {
  std::fprintf(stderr, "isostar: %s\n", words.c_str());
}

void warn(const std::string& words) {
  say("warning: " + words);
}

}  // namespace isostar::native
