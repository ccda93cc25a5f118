// A fuzzer's bytes as a file, for readers that take a path.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace isostar {

/// A file in a folder of this process, in memory where there is a file system for that. Both are
/// removed at the end.
class FuzzFile {
 public:
  explicit FuzzFile(const std::string& extension) {
    namespace fs = std::filesystem;
    const fs::path shared = "/dev/shm";
    folder_ = (fs::is_directory(shared) ? shared : fs::temp_directory_path()) /
              ("isostar-fuzz-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    path_ = (folder_ / ("input" + extension)).string();
  }
  ~FuzzFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  void write(const uint8_t* data, std::size_t size) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::filesystem::path folder_;
  std::string path_;
};

}  // namespace isostar
