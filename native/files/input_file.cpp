#include "files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

/// An open descriptor, closed with its scope.
struct Descriptor {
  explicit Descriptor(const std::string& path)
      : number(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number > STDIN_FILENO) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int number;
};

[[noreturn]] void fail(const std::string& path) {
  throw Failure(path, text("cannot be read: %s", std::strerror(errno)));
}

}  // namespace

std::vector<std::byte> readFile(const std::string& path) {
  const Descriptor file(path);
  struct stat about;
  if (file.number < 0 || ::fstat(file.number, &about) != 0) fail(path);
  std::vector<std::byte> bytes(S_ISREG(about.st_mode) ? static_cast<size_t>(about.st_size) : 0);
  for (size_t filled = 0;;) {
    // A pipe has no length: the buffer grows while data arrives.
    if (filled == bytes.size()) bytes.resize(filled + std::max<size_t>(filled, 65536));
    const ssize_t got = ::read(file.number, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno != EINTR) fail(path);
    if (got > 0) filled += static_cast<size_t>(got);
    if (got == 0 && path != "-" && filled < static_cast<size_t>(about.st_size))
      throw Failure(path, text("was cut from %zu to %zu bytes while it was read",
                               static_cast<size_t>(about.st_size), filled));
    if (got == 0 || (S_ISREG(about.st_mode) && filled == static_cast<size_t>(about.st_size))) {
      bytes.resize(filled);
      return bytes;
    }
  }
}

PartialFile::PartialFile(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail(path_);
}
PartialFile::~PartialFile() {
  ::close(descriptor_);
}

std::vector<std::byte> PartialFile::read(uint64_t offset, size_t length) const {
  std::vector<std::byte> bytes(length);
  for (size_t filled = 0; filled < length;) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + filled, length - filled,
                                static_cast<off_t>(offset + filled));
    if (got < 0 && errno != EINTR) fail(path_);
    if (got == 0) bytes.resize(length = filled);
    if (got > 0) filled += static_cast<size_t>(got);
  }
  return bytes;
}

bool isRegularFile(const std::string& path) {
  struct stat about;
  return path != "-" && ::stat(path.c_str(), &about) == 0 && S_ISREG(about.st_mode);
}

uint64_t fileSize(const std::string& path) {
  struct stat about;
  if (::stat(path.c_str(), &about) != 0) fail(path);
  if (S_ISDIR(about.st_mode)) throw Failure(path, "is a folder, a file is needed");
  return static_cast<uint64_t>(about.st_size);
}

}  // namespace isostar::native
