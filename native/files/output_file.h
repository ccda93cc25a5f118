#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/output_target.h"

namespace isostar::native {

/// A file that is written completely or not at all: data goes to a temporary file beside the
/// target, which commit() renames. It is removed if there is no commit(), and if one of the signals
/// of handleEndingSignals() ends the process. A target that is not a regular file ("-" or
/// /dev/stdout for standard output, /dev/null, a pipe) is written directly, at the place where it
/// is: what is there already is kept.
class OutputFile {
 public:
  explicit OutputFile(std::string target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, size_t count);
  void commit();
  const std::string& target() const { return target_; }

 private:
  int createTemporary();
  void flush();
  [[noreturn]] void fail(const char* doing) const;

  void forgetTemporary();

  std::string target_;
  OutputTarget resolved_;
  std::string temporary_;
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;
};

/// Checks before long work whether OutputFile could write to the target. Throws a Failure if not.
void requireWritable(const std::string& target);

}  // namespace isostar::native
