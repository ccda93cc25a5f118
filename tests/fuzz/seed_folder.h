// A folder of numbered files: a corpus for one fuzz target.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace isostar {

class SeedFolder {
 public:
  explicit SeedFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }

  void write(const std::string& bytes, const std::string& extension = "") {
    std::ofstream(next(extension), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  /// The path of the next file.
  std::string next(const std::string& extension = "") {
    return (folder_ / (std::to_string(number_++) + extension)).string();
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  std::filesystem::path folder_;
  int number_ = 0;
};

}  // namespace isostar
