#include "files/ending_signals.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/output_file.h"
#include "scratch_folder.h"

namespace isostar::native {
namespace {

class EndingSignals : public ScratchFolder {
 protected:
  /// The status of a process that gets a signal while it writes.
  int statusAfter(int signal) const {
    const pid_t child = ::fork();
    if (child == 0) {
      handleEndingSignals();
      OutputFile file(path("out"));
      file.write("half", 4);
      ::raise(signal);
      file.commit();
      ::_exit(7);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }
};

TEST_F(EndingSignals, removeTheTemporaryFile) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const int status = statusAfter(signal);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
    EXPECT_EQ(fileCount(), 0u) << signal;
  }
}

TEST_F(EndingSignals, stayIgnored) {
  const auto before = ::signal(SIGHUP, SIG_IGN);
  const int status = statusAfter(SIGHUP);
  ::signal(SIGHUP, before);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7);
  EXPECT_EQ(read("out"), "half");
}

}  // namespace
}  // namespace isostar::native
