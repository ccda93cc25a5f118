#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

/// A file that is written completely or not at all: data goes to a temporary file beside the
/// target, which commit() renames. A target that is not a regular file ("-" for standard output,
/// /dev/null, a pipe) is written directly.
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
  void flush();
  [[noreturn]] void fail(const char* doing) const;

  std::string target_, resolved_, temporary_;
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;
};

/// Checks before long work whether OutputFile could write to the target. Throws a Failure if not.
void requireWritable(const std::string& target);

/// Throws a UsageFault if the target is the input.
void requireDifferent(const std::string& input, const std::string& target);

}  // namespace isostar::native
