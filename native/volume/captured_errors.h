#pragma once

#include <iostream>
#include <sstream>
#include <string>

#include "files/text.h"

namespace isostar::native {

/// Captures what is written to std::cerr during its lifetime. Some libraries report missing samples
/// only there.
class CapturedErrors {
 public:
  CapturedErrors() : before_(std::cerr.rdbuf(captured_.rdbuf())) {}
  ~CapturedErrors() { std::cerr.rdbuf(before_); }
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;

  std::string line() const { return oneLine(captured_.str()); }

 private:
  std::ostringstream captured_;
  std::streambuf* before_;
};

}  // namespace isostar::native
