#include "volume/child_reader.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {
namespace {

/// What goes through the memory file, before the words and the samples.
struct Head {
  bool failed = false;
  uint64_t words = 0, samples = 0;
  std::array<int32_t, 3> size{};
  Placement placement{};
};

void writeAll(int file, const void* bytes, size_t count) {
  for (const auto* from = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t written = ::write(file, from, count);
    if (written < 0) ::_exit(1);
    from += written;
    count -= static_cast<size_t>(written);
  }
}

void readAll(int file, void* bytes, size_t count, const std::string& path) {
  for (auto* to = static_cast<char*>(bytes); count > 0;) {
    const ssize_t got = ::read(file, to, count);
    if (got <= 0) throw Failure(path, "is damaged: its reader gave up");
    to += got;
    count -= static_cast<size_t>(got);
  }
}

void send(int file, const Head& head, const std::string& words, const std::vector<float>& samples) {
  writeAll(file, &head, sizeof head);
  writeAll(file, words.data(), words.size());
  writeAll(file, samples.data(), samples.size() * sizeof(float));
}

void sendFailure(int file, const std::string& words) {
  send(file, {.failed = true, .words = words.size()}, words, {});
}

void sendVolume(int file, const LoadedVolume& volume) {
  std::string words;
  for (const std::string& remark : volume.remarks) words += remark + '\n';
  send(file, {false, words.size(), volume.samples.size(), volume.size, volume.placement}, words, volume.samples);
}

/// The child's whole life.
[[noreturn]] void serve(int file, const std::function<LoadedVolume()>& read) {
  const rlimit noCore{};
  ::setrlimit(RLIMIT_CORE, &noCore);
  const int silence = ::open("/dev/null", O_WRONLY);
  ::dup2(silence, STDOUT_FILENO);
  ::dup2(silence, STDERR_FILENO);
  try {
    sendVolume(file, read());
  } catch (const std::bad_alloc&) {
    sendFailure(file, "out of memory");
  } catch (const std::exception& failure) {
    sendFailure(file, failure.what());
  }
  ::_exit(0);
}

LoadedVolume receive(int file, const std::string& path) {
  Head head;
  ::lseek(file, 0, SEEK_SET);
  readAll(file, &head, sizeof head, path);
  std::string words(head.words, '\0');
  readAll(file, words.data(), words.size(), path);
  if (head.failed) throw Failure(words);
  LoadedVolume volume{std::vector<float>(head.samples), head.size, head.placement, {}};
  readAll(file, volume.samples.data(), volume.samples.size() * sizeof(float), path);
  for (size_t at = 0, end; (end = words.find('\n', at)) != std::string::npos; at = end + 1)
    volume.remarks.push_back(words.substr(at, end - at));
  return volume;
}

}  // namespace

LoadedVolume readInChild(const std::string& path, const std::function<LoadedVolume()>& read) {
  struct MemoryFile {
    const int descriptor = ::memfd_create("volume", MFD_CLOEXEC);
    ~MemoryFile() { ::close(descriptor); }
  } const file;
  const pid_t child = ::fork();
  if (child == 0) serve(file.descriptor, read);
  int status = 0;
  if (file.descriptor < 0 || child < 0 || ::waitpid(child, &status, 0) != child)
    throw Failure(path, text("cannot be read: %s", std::strerror(errno)));
  if (WIFSIGNALED(status)) throw Failure(path, "is damaged: its reader gave up");
  return receive(file.descriptor, path);
}

}  // namespace isostar::native
