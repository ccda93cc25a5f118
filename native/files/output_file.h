#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

/// A file that appears whole or not at all: it is written beside the target and renamed by
/// commit(). A target that is no regular file ("-" for standard output, /dev/null, a pipe) is
/// written directly.
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

/// Says before long work what OutputFile would say after it.
void requireWritable(const std::string& target);

/// Refuses a target that is one of the command's own inputs.
void requireDifferent(const std::string& input, const std::string& target);

}  // namespace isostar::native
