#include "files/output_target.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as in Linux

/// The number of a descriptor if `folder` is the one of this process's descriptors, else -1.
int descriptorNamed(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (folder.empty() || folder != fs::canonical("/proc/self/fd", ignored)) return -1;
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

bool about(const std::string& path, int standard, struct stat& found) {
  return (path == "-" ? ::fstat(standard, &found) : ::stat(path.c_str(), &found)) == 0;
}

bool isSame(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace

bool OutputTarget::isDirect() const {
  struct stat found;
  return descriptor >= 0 ||
         (::stat(path.c_str(), &found) == 0 && !S_ISREG(found.st_mode) && !S_ISDIR(found.st_mode));
}

OutputTarget outputTargetOf(const std::string& target) {
  if (target == "-") return {target, STDOUT_FILENO};
  fs::path path = target;
  for (int links = 0; links <= kMostLinks; ++links) {
    std::error_code ignored;
    const fs::path folder =
        fs::canonical(path.has_parent_path() ? path.parent_path() : ".", ignored);
    const int descriptor = descriptorNamed(folder, path.filename().string());
    if (descriptor >= 0 || !fs::is_symlink(path, ignored)) return {path.string(), descriptor};
    path = folder / fs::read_symlink(path, ignored);
  }
  throw Failure(target, text("cannot be written: %s", std::strerror(ELOOP)));
}

bool isSameFile(const std::string& a, const std::string& b) {
  struct stat first, second;
  return about(a, STDIN_FILENO, first) && about(b, STDOUT_FILENO, second) &&
         S_ISREG(first.st_mode) && isSame(first, second);
}

void requireDifferent(const std::string& input, const std::string& target) {
  if (isSameFile(input, target))
    throw UsageFault(text("%s is the input too; name another output", target.c_str()));
}

bool isStandardOutput(const std::string& target) {
  if (outputTargetOf(target).descriptor == STDOUT_FILENO) return true;
  struct stat file, standard;
  return about(target, STDOUT_FILENO, file) && ::fstat(STDOUT_FILENO, &standard) == 0 &&
         (S_ISREG(file.st_mode) || S_ISFIFO(file.st_mode)) && isSame(file, standard);
}

}  // namespace isostar::native
