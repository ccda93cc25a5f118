#include "files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

constexpr size_t kBuffer = size_t{1} << 20;

bool isStandardOutput(const std::string& target) {
  return target == "-";
}

std::filesystem::path folderOf(const std::string& target) {
  const auto folder = std::filesystem::path(target).parent_path();
  return folder.empty() ? "." : folder;
}

bool isSpecial(const std::string& target) {
  struct stat about;
  return ::stat(target.c_str(), &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

/// The target of a symbolic link: renaming must replace the file that the link points to, not the
/// link.
std::string resolve(const std::string& target) {
  std::error_code ignored;
  const auto resolved = std::filesystem::canonical(target, ignored);
  return resolved.empty() ? target : resolved.string();
}

void keepMode(int descriptor, const std::string& target) {
  struct stat about;
  if (::stat(target.c_str(), &about) == 0) (void)!::fchmod(descriptor, about.st_mode & 07777);
}

}  // namespace

OutputFile::OutputFile(std::string target) : target_(std::move(target)), resolved_(target_) {
  buffer_.reserve(kBuffer);
  if (isStandardOutput(target_)) {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  requireWritable(target_);
  if (isSpecial(target_)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    resolved_ = resolve(target_);
    temporary_ = text("%s.%d.part", resolved_.c_str(), static_cast<int>(::getpid()));
    descriptor_ =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) keepMode(descriptor_, resolved_);
  }
  if (descriptor_ < 0) {
    temporary_.clear();
    fail("cannot be written");
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
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
  if (descriptor_ == STDOUT_FILENO) return;
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("cannot be written");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), resolved_.c_str()) != 0) fail("cannot be replaced");
  temporary_.clear();
}

void OutputFile::fail(const char* doing) const {
  throw Failure(target_, text("%s: %s", doing, std::strerror(errno)));
}

void requireWritable(const std::string& target) {
  if (isStandardOutput(target)) return;
  std::error_code ignored;
  const auto folder = folderOf(target);
  if (!std::filesystem::is_directory(folder, ignored))
    throw Failure(target, text("cannot be written: there is no folder %s", folder.c_str()));
  if (std::filesystem::is_directory(target, ignored))
    throw Failure(target, "cannot be written: it is a folder");
  const bool exists = std::filesystem::exists(target, ignored);
  if (::access(exists ? target.c_str() : folder.c_str(), W_OK) != 0)
    throw Failure(target, text("cannot be written: %s", std::strerror(errno)));
}

void requireDifferent(const std::string& input, const std::string& target) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, target, ignored))
    throw UsageFault(text("%s is the input too; name another output", target.c_str()));
}

}  // namespace isostar::native
