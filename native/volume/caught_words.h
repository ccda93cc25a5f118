#pragma once

#include <iostream>
#include <sstream>
#include <string>

#include "files/text.h"

namespace isostar::native {

/// Catches what is written to std::cerr while it lives: the only place where some libraries tell of
/// missing samples.
class CaughtWords {
 public:
  CaughtWords() : before_(std::cerr.rdbuf(words_.rdbuf())) {}
  ~CaughtWords() { std::cerr.rdbuf(before_); }
  CaughtWords(const CaughtWords&) = delete;
  CaughtWords& operator=(const CaughtWords&) = delete;

  std::string line() const { return oneLine(words_.str()); }

 private:
  std::ostringstream words_;
  std::streambuf* before_;
};

}  // namespace isostar::native
