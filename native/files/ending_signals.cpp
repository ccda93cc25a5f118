#include "files/ending_signals.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>

namespace isostar::native {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

/// More than a command has open at the same time; a further file is not removed.
constexpr int kMostFiles = 4;
std::array<std::atomic<const char*>, kMostFiles> files;
static_assert(std::atomic<const char*>::is_always_lock_free, "signal handlers use it");

/// Calls async-signal-safe functions only. The signal is blocked until the handler returns, and
/// then ends the process by the default action that SA_RESETHAND has restored.
void onSignal(int signal) {
  for (const auto& file : files)
    if (const char* path = file.load()) ::unlink(path);
  ::raise(signal);
}

}  // namespace

void handleEndingSignals() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : kSignals) ::sigaddset(&action.sa_mask, signal);
  for (const int signal : kSignals) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(signal, &action, nullptr);
  }
}

void resetEndingSignals() {
  for (const int signal : kSignals) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == onSignal)
      ::signal(signal, SIG_DFL);
  }
}

void removeOnSignal(const char* path) {
  for (auto& file : files) {
    const char* unused = nullptr;
    if (file.compare_exchange_strong(unused, path)) return;
  }
}

void keepOnSignal(const char* path) {
  for (auto& file : files) {
    const char* expected = path;
    if (file.compare_exchange_strong(expected, nullptr)) return;
  }
}

}  // namespace isostar::native
