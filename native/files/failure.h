#pragma once

#include <stdexcept>
#include <string>

namespace isostar::native {

/// An error in the input or the output: exit status 1. The message is one line: file, what, where.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  Failure(const std::string& file, const std::string& what)
      : std::runtime_error(file + ": " + what) {}
};

/// An error in the command line: exit status 2.
class UsageFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace isostar::native
