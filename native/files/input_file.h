#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostar::native {

/// All bytes of a file; "-" is standard input.
std::vector<std::byte> readFile(const std::string& path);

/// A file of which parts are read. Functions throw a Failure naming it.
class PartialFile {
 public:
  explicit PartialFile(const std::string& path);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile();

  /// At most `length` bytes from `offset` on: fewer only at the end of the file.
  [[nodiscard]] std::vector<std::byte> read(uint64_t offset, size_t length) const;

 private:
  std::string path_;
  int descriptor_;
};

/// Is it a file of which parts can be read, no pipe and not "-"?
bool isRegularFile(const std::string& path);

/// The length of a regular file in bytes. Throws a Failure if it does not exist or is a folder.
uint64_t fileSize(const std::string& path);

}  // namespace isostar::native
