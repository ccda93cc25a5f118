#include "files/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <new>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

void silence() {
  const rlimit noCore{};
  ::setrlimit(RLIMIT_CORE, &noCore);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

}  // namespace

Handover::Handover(std::string path)
    : path_(std::move(path)), file_(::memfd_create("handover", MFD_CLOEXEC)) {}

Handover::~Handover() {
  ::close(file_);
}

void Handover::put(const std::vector<std::string>& lines) {
  put(lines.size());
  for (const std::string& line : lines) put(line);
}

void Handover::take(std::string& words) {
  std::vector<char> letters;
  take(letters);
  words.assign(letters.begin(), letters.end());
}

void Handover::take(std::vector<std::string>& lines) {
  size_t count = 0;
  take(count);
  lines.resize(count);
  for (std::string& line : lines) take(line);
}

void Handover::write(const void* bytes, size_t count) {
  for (const auto* from = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t written = ::write(file_, from, count);
    if (written < 0) ::_exit(1);
    from += written;
    count -= static_cast<size_t>(written);
  }
}

void Handover::read(void* bytes, size_t count) {
  for (auto* to = static_cast<char*>(bytes); count > 0;) {
    const ssize_t got = ::read(file_, to, count);
    if (got <= 0) throw Failure(path_, "is damaged: its reader gave up");
    to += got;
    count -= static_cast<size_t>(got);
  }
}

void Handover::rewind() {
  ::lseek(file_, 0, SEEK_SET);
}

// The first word tells whether the work was done. What a failed work had put before is behind its
// complaint's back.
void runInChild(Handover& handover, const std::function<void(Handover&)>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    silence();
    std::string complaint;
    try {
      handover.put(complaint);
      work(handover);
      ::_exit(0);
    } catch (const std::bad_alloc&) {
      complaint = "out of memory";
    } catch (const std::exception& failure) {
      complaint = failure.what();
    }
    handover.rewind();
    handover.put(complaint);
    ::_exit(0);
  }
  int status = 0;
  if (handover.file_ < 0 || child < 0 || ::waitpid(child, &status, 0) != child)
    throw Failure(handover.path_, text("cannot be read: %s", std::strerror(errno)));
  if (WIFSIGNALED(status)) throw Failure(handover.path_, "is damaged: its reader gave up");
  handover.rewind();
  std::string complaint;
  handover.take(complaint);
  if (!complaint.empty()) throw Failure(complaint);
}

}  // namespace isostar::native
