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

void silenceProcess() {
  const rlimit noCore{};
  ::setrlimit(RLIMIT_CORE, &noCore);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

}  // namespace

ChildOutput::ChildOutput(std::string path)
    : path_(std::move(path)), file_(::memfd_create("isostar", MFD_CLOEXEC)) {}

ChildOutput::~ChildOutput() {
  ::close(file_);
}

void ChildOutput::put(const std::vector<std::string>& lines) {
  put(lines.size());
  for (const std::string& line : lines) put(line);
}

void ChildOutput::take(std::string& text) {
  std::vector<char> letters;
  take(letters);
  text.assign(letters.begin(), letters.end());
}

void ChildOutput::take(std::vector<std::string>& lines) {
  size_t count = 0;
  take(count);
  lines.resize(count);
  for (std::string& line : lines) take(line);
}

void ChildOutput::write(const void* bytes, size_t count) {
  for (const auto* from = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t written = ::write(file_, from, count);
    if (written < 0) ::_exit(1);
    from += written;
    count -= static_cast<size_t>(written);
  }
}

void ChildOutput::read(void* bytes, size_t count) {
  for (auto* to = static_cast<char*>(bytes); count > 0;) {
    const ssize_t got = ::read(file_, to, count);
    if (got <= 0) throw Failure(path_, "is damaged: its reader crashed");
    to += got;
    count -= static_cast<size_t>(got);
  }
}

void ChildOutput::rewind() {
  ::lseek(file_, 0, SEEK_SET);
}

// The output begins with an error message, which is empty after success. On failure it overwrites
// the start of the output, and the rest is never read.
void runInChild(ChildOutput& output, const std::function<void(ChildOutput&)>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    silenceProcess();
    std::string complaint;
    try {
      output.put(complaint);
      work(output);
      ::_exit(0);
    } catch (const std::bad_alloc&) {
      complaint = "out of memory";
    } catch (const std::exception& failure) {
      complaint = failure.what();
    }
    output.rewind();
    output.put(complaint);
    ::_exit(0);
  }
  int status = 0;
  if (output.file_ < 0 || child < 0 || ::waitpid(child, &status, 0) != child)
    throw Failure(output.path_, text("cannot be read: %s", std::strerror(errno)));
  if (WIFSIGNALED(status)) throw Failure(output.path_, "is damaged: its reader crashed");
  output.rewind();
  std::string complaint;
  output.take(complaint);
  if (!complaint.empty()) throw Failure(complaint);
}

}  // namespace isostar::native
