#pragma once

#include <stdexcept>
#include <string>

namespace isostar::native {

/// The input or the output was at fault: exit status 1. One line: file, what, where.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  Failure(const std::string& file, const std::string& what)
      : std::runtime_error(file + ": " + what) {}
};

/// The command line was at fault: exit status 2.
class UsageFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace isostar::native
