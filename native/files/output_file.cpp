#include "files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "files/ending_signals.h"
#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

constexpr size_t kBuffer = size_t{1} << 20;
constexpr int kMostTries = 100;  // to find an unused name for the temporary file

std::filesystem::path folderOf(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

void keepMode(int descriptor, const std::string& target) {
  struct stat about;
  if (::stat(target.c_str(), &about) == 0) (void)!::fchmod(descriptor, about.st_mode & 07777);
}

}  // namespace

OutputFile::OutputFile(std::string target)
    : target_(std::move(target)), resolved_(outputTargetOf(target_)) {
  buffer_.reserve(kBuffer);
  requireWritable(target_);
  if (resolved_.descriptor >= 0) {
    descriptor_ = ::fcntl(resolved_.descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  } else if (resolved_.isDirect()) {
    descriptor_ = ::open(resolved_.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } else {
    descriptor_ = createTemporary();
    if (descriptor_ >= 0) keepMode(descriptor_, resolved_.path);
  }
  if (descriptor_ < 0) fail("cannot be written");
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  forgetTemporary();
}

/// The name does not contain the target's, which may be as long as the file system permits.
int OutputFile::createTemporary() {
  const std::filesystem::path folder = std::filesystem::path(resolved_.path).parent_path();
  for (int number = 0;; ++number) {
    temporary_ = folder / text(".isostar-%d-%d.part", static_cast<int>(::getpid()), number);
    removeOnSignal(temporary_.c_str());
    const int descriptor =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    const int error = errno;
    forgetTemporary();
    errno = error;
    if (error != EEXIST || number == kMostTries) return -1;
  }
}

void OutputFile::forgetTemporary() {
  keepOnSignal(temporary_.c_str());
  temporary_.clear();
}

void OutputFile::write(const void* bytes, size_t count) {
  const auto* from = static_cast<const std::byte*>(bytes);
  while (count > 0) {
    const size_t taken = std::min(count, kBuffer - buffer_.size());
    buffer_.insert(buffer_.end(), from, from + taken);
    from += taken;
    count -= taken;
    if (buffer_.size() == kBuffer) flush();
  }
}

void OutputFile::flush() {
  for (size_t done = 0; done < buffer_.size();) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno != EINTR) fail("cannot be written");
    if (written > 0) done += static_cast<size_t>(written);
  }
  buffer_.clear();
}

void OutputFile::commit() {
  flush();
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be written");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), resolved_.path.c_str()) != 0) fail("cannot be replaced");
  forgetTemporary();
}

void OutputFile::fail(const char* doing) const {
  throw Failure(target_, text("%s: %s", doing, std::strerror(errno)));
}

void requireWritable(const std::string& target) {
  const OutputTarget resolved = outputTargetOf(target);
  const auto fail = [&target](int error) {
    throw Failure(target, text("cannot be written: %s", std::strerror(error)));
  };
  if (resolved.descriptor >= 0) {
    const int flags = ::fcntl(resolved.descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) fail(EBADF);
    return;
  }
  std::error_code ignored;
  const auto folder = folderOf(resolved.path);
  if (!std::filesystem::is_directory(folder, ignored))
    throw Failure(target, text("cannot be written: there is no folder %s", folder.c_str()));
  if (std::filesystem::is_directory(resolved.path, ignored))
    throw Failure(target, "cannot be written: it is a folder");
  if (::access(resolved.path.c_str(), W_OK) != 0 && errno != ENOENT) fail(errno);
  if (!resolved.isDirect() && ::access(folder.c_str(), W_OK | X_OK) != 0) fail(errno);
}

}  // namespace isostar::native
