#include "files/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "files/ending_signals.h"
#include "files/failure.h"
#include "files/sanitizers.h"
#include "files/text.h"

namespace isostar::native {
namespace {

// A volume of samples that are almost all equal is 1000 times its file when it is unpacked.
constexpr uint64_t kLeastMemory = uint64_t{1} << 30, kMemoryPerByte = 1000;
constexpr uint64_t kLeastSeconds = 8, kBytesPerSecond = 200'000;

/// In a child: whether an allocation has failed. Libraries report it as damage, if at all.
bool memoryRefused = false;

void refuseMemory() {
  memoryRefused = true;
  throw std::bad_alloc();
}

/// The address space in use, in bytes.
uint64_t addressSpace() {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

uint64_t physicalMemory() {
  return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Lowers a limit of this process. Where it has a lower one already, that stays.
void lower(int resource, uint64_t soft, uint64_t hard) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, hard);
  limit.rlim_cur = std::min<rlim_t>({limit.rlim_cur, limit.rlim_max, soft});
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void limitProcess(const ChildLimits& limits) {
  // The hard limit kills without a signal that says why.
  lower(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
  const uint64_t memory = addressSpace() + limits.memory;
  if (!kReservesAddresses) lower(RLIMIT_AS, memory, memory);
  std::set_new_handler(refuseMemory);
}

/// The child ends with its parent, whatever ends that.
void endWith(pid_t parent) {
  resetEndingSignals();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
}

std::string tooMuch(const std::string& what) {
  return text("reading takes more than %s: the file is damaged or asks for too much", what.c_str());
}

/// Why a child that a signal has ended did so.
std::string reasonOf(int signal, const ChildLimits& limits) {
  if (signal == SIGXCPU)
    return tooMuch(text("%llu s", static_cast<unsigned long long>(limits.seconds)));
  if (signal == SIGKILL) return "cannot be read: its reader was killed, perhaps for lack of memory";
  return "is damaged: its reader crashed";
}

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

ChildLimits limitsFor(uint64_t inputBytes) {
  const uint64_t wanted = inputBytes < UINT64_MAX / kMemoryPerByte - kLeastMemory
                              ? kLeastMemory + kMemoryPerByte * inputBytes
                              : UINT64_MAX;
  return {.memory = std::min(wanted, physicalMemory()),
          .seconds = kLeastSeconds + inputBytes / kBytesPerSecond};
}

// The output begins with an error message, which is empty after success. On failure it overwrites
// the start of the output, and the rest is never read.
void runInChild(ChildOutput& output, const ChildLimits& limits,
                const std::function<void(ChildOutput&)>& work) {
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    endWith(parent);
    silenceProcess();
    limitProcess(limits);
    std::string complaint;
    try {
      output.put(complaint);
      work(output);
      ::_exit(0);
    } catch (const std::bad_alloc&) {
      memoryRefused = true;
    } catch (const std::exception& failure) {
      complaint = failure.what();
    }
    if (memoryRefused)
      complaint = output.path() + ": " + tooMuch(readableBytes(limits.memory) + " of memory");
    output.rewind();
    output.put(complaint);
    ::_exit(0);
  }
  int status = 0;
  if (output.file_ < 0 || child < 0)
    throw Failure(output.path_, text("cannot be read: %s", std::strerror(errno)));
  while (::waitpid(child, &status, 0) != child)
    if (errno != EINTR)
      throw Failure(output.path_, text("cannot be read: %s", std::strerror(errno)));
  if (WIFSIGNALED(status)) throw Failure(output.path_, reasonOf(WTERMSIG(status), limits));
  output.rewind();
  std::string complaint;
  output.take(complaint);
  if (!complaint.empty()) throw Failure(complaint);
}

}  // namespace isostar::native
