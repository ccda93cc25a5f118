#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "byte_string.h"
#include "scratch_folder.h"

namespace isostar::native {

struct Outcome {
  int status = -1;
  std::string results, words;  // standard output and error
};

class CommandLine : public ScratchFolder {
 protected:
  /// Runs the command in the scratch folder, without a shell.
  Outcome run(std::vector<std::string> arguments,
              const std::string& results = "/dev/null/none") const {
    arguments.insert(arguments.begin(), ISOSTAR_COMMAND);
    return collect(arguments, results == "/dev/null/none" ? path(".out") : results);
  }

  /// Runs a script of the shell in the scratch folder; $ISOSTAR is the command.
  Outcome shell(const std::string& script) const {
    ::setenv("ISOSTAR", ISOSTAR_COMMAND, 1);
    return collect({"/bin/sh", "-c", script}, path(".out"));
  }

  /// A fault is one line on standard error, nothing on standard output, and leaves no new file
  /// behind.
  std::string expectFault(int status, const std::vector<std::string>& arguments) const {
    const size_t before = fileCount();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.words;
    EXPECT_EQ(outcome.results, "");
    EXPECT_EQ(std::count(outcome.words.begin(), outcome.words.end(), '\n'), 1) << outcome.words;
    EXPECT_EQ(outcome.words.rfind("isostar: ", 0), 0u) << outcome.words;
    EXPECT_EQ(fileCount(), before);
    return outcome.words;
  }

  /// A ball of radius 6 in a grid of 20³ with spacing 1, 1, 2.
  std::string ball() const {
    std::vector<float> samples;
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 20; ++i)
          samples.push_back(static_cast<float>(6 - std::hypot(i - 9.6, j - 9.3, k - 9.5)));
    write("ball.nrrd",
          "NRRD0004\ntype: float\ndimension: 3\nsizes: 20 20 20\nspacings: 1 1 2\nencoding: raw\n"
          "endian: little\n\n" +
              bytesOf(samples));
    return "ball.nrrd";
  }

  void encodeBall() const {
    EXPECT_EQ(run({"encode", ball(), "ball.isostar", "--iso", "0"}).status, 0);
  }

 private:
  Outcome collect(const std::vector<std::string>& arguments, const std::string& out) const {
    const pid_t child = ::fork();
    if (child == 0) start(arguments, out);
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                    out == path(".out") ? read(".out") : "", read(".err")};
    std::filesystem::remove(path(".out"));
    std::filesystem::remove(path(".err"));
    return outcome;
  }

  [[noreturn]] void start(const std::vector<std::string>& arguments, const std::string& out) const {
    std::vector<char*> pointers;
    for (const std::string& each : arguments) pointers.push_back(const_cast<char*>(each.c_str()));
    pointers.push_back(nullptr);
    const int outFile = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int errorFile = ::open(path(".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(outFile, STDOUT_FILENO);
    ::dup2(errorFile, STDERR_FILENO);
    if (::chdir(path("").c_str()) == 0) ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
};

}  // namespace isostar::native
