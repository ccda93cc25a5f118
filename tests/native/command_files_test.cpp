// The command among the files, descriptors and signals of a Unix system.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <random>
#include <thread>

#include "command_line.h"

namespace isostar::native {
namespace {

class CommandFiles : public CommandLine {
 protected:
  /// The same volume as ball(), in a header and a file of samples.
  void detachedBall() const {
    const std::string whole = read(ball());
    const size_t end = whole.find("\n\n");
    write("ball.raw", whole.substr(end + 2));
    write("ball.nhdr", whole.substr(0, end) + "\ndata file: ball.raw\n");
  }

  void expectSound(const std::string& stream) const {
    EXPECT_EQ(run({"decode", stream, "sound.ply"}).status, 0) << stream;
    std::filesystem::remove(path("sound.ply"));
  }

  /// The output is an input too: refused, and the input keeps its bytes.
  void expectRefused(const std::string& input, const std::string& output) const {
    const std::string before = read(output);
    EXPECT_NE(expectFault(1, {"encode", input, output, "--iso", "0"}).find("is the input too"),
              std::string::npos)
        << input;
    EXPECT_EQ(read(output), before) << input;
  }
};

TEST_F(CommandFiles, writesWhereStandardDescriptorsAreClosed) {
  ball();
  for (const char* closed : {">&-", "<&- >&-", "<&- >&- 2>&-", "2>&-"}) {
    std::filesystem::remove(path("a.isostar"));
    EXPECT_EQ(
        shell(std::string("\"$ISOSTAR\" encode ball.nrrd a.isostar --iso 0 ") + closed).status, 0)
        << closed;
    expectSound("a.isostar");
  }
  EXPECT_EQ(shell("\"$ISOSTAR\" info a.isostar >&-").status, 1);
  EXPECT_EQ(shell("\"$ISOSTAR\" encode ball.nrrd - --iso 0 >&-").status, 1);
  EXPECT_EQ(shell("\"$ISOSTAR\" info - <&-").status, 1);
}

TEST_F(CommandFiles, refusesToOverwriteTheFilesOfAnInput) {
  detachedBall();
  expectRefused("ball.nhdr", "ball.raw");
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nDimSize = 20 20 20\nElementType = MET_FLOAT\n";
  write("ball.mhd", meta + "ElementDataFile = ball.raw\n");
  expectRefused("ball.mhd", "ball.raw");
  std::filesystem::create_hard_link(path("ball.raw"), path("linked.raw"));
  expectRefused("ball.mhd", "linked.raw");
  write("rows.nhdr",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 20 20 20\ndata file: ball%02d.raw 1 2 1\n");
  write("ball02.raw", "x");
  expectRefused("rows.nhdr", "ball02.raw");
  write("list.nhdr",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 20 20 20\ndata file: LIST\na\nball.raw\n");
  expectRefused("list.nhdr", "ball.raw");
  write("pair.hdr", "x");
  write("pair.img", "x");
  expectRefused("pair.hdr", "pair.img");
  std::filesystem::create_directory(path("folder"));
  write("folder/1.dcm", "x");
  expectRefused("folder", "folder/1.dcm");
}

TEST_F(CommandFiles, refusesToOverwriteTheInputItself) {
  const std::string before = read(ball());
  std::filesystem::create_hard_link(path("ball.nrrd"), path("hard"));
  std::filesystem::create_symlink("ball.nrrd", path("soft"));
  expectFault(2, {"encode", "ball.nrrd", "hard", "--iso", "0"});
  expectFault(2, {"encode", "ball.nrrd", "soft", "--iso", "0"});
  EXPECT_EQ(shell("\"$ISOSTAR\" encode ball.nrrd - --iso 0 >> ball.nrrd").status, 2);
  EXPECT_EQ(shell("\"$ISOSTAR\" encode ball.nrrd /dev/stdout --iso 0 >> ball.nrrd").status, 2);
  EXPECT_EQ(read("ball.nrrd"), before);
}

TEST_F(CommandFiles, appendsToWhatDescriptorsHave) {
  ball();
  for (const char* output : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    write("a", "before");
    EXPECT_EQ(
        shell(std::string("\"$ISOSTAR\" encode ball.nrrd ") + output + " --iso 0 >> a").status, 0);
    EXPECT_EQ(read("a").substr(0, 6), "before") << output;
    write("a.isostar", read("a").substr(6));
    expectSound("a.isostar");
  }
  write("b", "");
  EXPECT_EQ(
      shell(
          "exec 3> b; echo before >&3; \"$ISOSTAR\" encode ball.nrrd /dev/fd/3 --iso 0; echo after "
          ">&3")
          .status,
      0);
  const std::string content = read("b");
  EXPECT_EQ(content.substr(0, 7), "before\n");
  EXPECT_EQ(content.substr(content.size() - 6), "after\n");
  expectFault(1, {"encode", "ball.nrrd", "/dev/fd/77", "--iso", "0"});
}

TEST_F(CommandFiles, doesNotMixJsonAndTheStream) {
  ball();
  for (const char* line :
       {"encode ball.nrrd /dev/stdout --iso 0 --json", "encode ball.nrrd /dev/fd/1 --iso 0 --json",
        "encode ball.nrrd out --iso 0 --json > out"}) {
    const Outcome outcome = shell(std::string("\"$ISOSTAR\" ") + line);
    EXPECT_EQ(outcome.status, 2) << line;
    EXPECT_EQ(outcome.results, "") << line;
    EXPECT_NE(outcome.words.find("cannot share standard output"), std::string::npos) << line;
  }
  encodeBall();
  std::filesystem::create_symlink("/dev/stdout", path("out.ply"));
  EXPECT_EQ(shell("\"$ISOSTAR\" decode ball.isostar out.ply --json").status, 2);
}

TEST_F(CommandFiles, writesNamesOfAnyLength) {
  ball();
  for (const size_t length : {245, 246, 255}) {
    const std::string name(length, 'n');
    EXPECT_EQ(run({"encode", "ball.nrrd", name, "--iso", "0"}).status, 0) << length;
    expectSound(name);
  }
  expectFault(1, {"encode", "ball.nrrd", std::string(256, 'n'), "--iso", "0"});
}

TEST_F(CommandFiles, createsTheTargetOfALink) {
  ball();
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("folder/second", path("first"));
  std::filesystem::create_symlink("real.isostar", path("folder/second"));
  EXPECT_EQ(run({"encode", "ball.nrrd", "first", "--iso", "0"}).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("first")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("folder/second")));
  expectSound("folder/real.isostar");
  std::filesystem::create_symlink("loop", path("loop"));
  expectFault(1, {"encode", "ball.nrrd", "loop", "--iso", "0"});
}

TEST_F(CommandFiles, showsNoControlCharacters) {
  const std::string name = "a\x1b[31m\r\xc2\x9b\xff\n\xc3\xa9.isostar";
  const std::string shown = "a\\x1b[31m\\x0d\\u009b\\xff\\n\xc3\xa9.isostar";
  const std::string missing = expectFault(1, {"info", name});
  EXPECT_NE(missing.find(shown + ": cannot be read"), std::string::npos) << missing;
  const Outcome encoded = run({"encode", ball(), name, "--iso", "0"});
  EXPECT_EQ(encoded.status, 0);
  EXPECT_NE(encoded.words.find(shown), std::string::npos) << encoded.words;
  EXPECT_NE(run({"info", name}).results.find(shown), std::string::npos);
  const Outcome compared = run({"compare", name, name});
  EXPECT_NE(compared.results.find(shown), std::string::npos) << compared.words;
  EXPECT_EQ(run({"compare", name, name, "--json"}).status, 0);
  EXPECT_NE(expectFault(2, {"info", "--\x1b[2J"}).find("--\\x1b[2J"), std::string::npos);
}

TEST_F(CommandFiles, succeedsWhereTheSourceIsDeletedMeanwhile) {
  std::mt19937 random(1);
  std::string samples(64 * 64 * 64, '\0');
  for (char& sample : samples) sample = static_cast<char>(random());
  write("noise.raw", samples);
  // The shell waits until the output is opened, when the source has been read. The stream does not
  // fit into a pipe, so that the command then waits for the shell.
  const Outcome outcome = shell(
      "mkfifo pipe; \"$ISOSTAR\" encode noise.raw pipe --size 64,64,64 --type u8 --iso 127.5 "
      "--lossless & exec 3< pipe; rm noise.raw; cat <&3 > a.isostar; wait $!");
  EXPECT_EQ(outcome.status, 0) << outcome.words;
  EXPECT_NE(outcome.words.find("noise.raw 262 kB -> pipe"), std::string::npos) << outcome.words;
  EXPECT_GT(read("a.isostar").size(), size_t{100'000});
  expectSound("a.isostar");
}

TEST_F(CommandFiles, saysThatAFileWasCutMeanwhile) {
  // Such files claim a page and hold a few bytes.
  const std::string cut = "/sys/devices/system/cpu/online";
  struct stat about;
  if (::stat(cut.c_str(), &about) != 0 || about.st_size < 1000) GTEST_SKIP();
  EXPECT_NE(expectFault(1, {"info", cut}).find("was cut from"), std::string::npos);
  EXPECT_NE(expectFault(1, {"encode", cut, "out", "--iso", "0", "--type", "u8", "--size",
                            std::to_string(about.st_size) + ",1,1"})
                .find("was cut from"),
            std::string::npos);
}

TEST_F(CommandFiles, warnsOfAPrefixThatEndsInADamagedLayer) {
  encodeBall();
  std::string stream = read("ball.isostar");
  const auto warning = [&](const std::string& bytes) {
    const Outcome outcome = run({"decode", "ball.isostar", "a.ply", "--bytes", bytes});
    EXPECT_EQ(outcome.status, 0) << outcome.words;
    return outcome.words.find("warning: ball.isostar is damaged") != std::string::npos;
  };
  const std::string most = std::to_string(stream.size() - 3);
  EXPECT_FALSE(warning(most));
  stream[stream.size() - 5] = static_cast<char>(stream[stream.size() - 5] ^ 4);
  write("ball.isostar", stream);
  EXPECT_TRUE(warning(most));
  stream.resize(stream.size() - 1);  // what is missing cannot be checked
  write("ball.isostar", stream);
  EXPECT_FALSE(warning(most));
}

TEST_F(CommandFiles, refusesSpacingsThatDifferTooMuch) {
  ball();
  const std::string words =
      expectFault(1, {"encode", "ball.nrrd", "a.isostar", "--iso", "0", "--spacing", "1,1,1e12"});
  EXPECT_NE(words.find("has spacings from 1 to 1e+12"), std::string::npos) << words;
  EXPECT_EQ(run({"encode", "ball.nrrd", "a.isostar", "--iso", "0", "--spacing", "1,1,9999"}).status,
            0);
}

TEST_F(CommandFiles, aSignalEndsItAsASignal) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(ISOSTAR_COMMAND, ISOSTAR_COMMAND, "info", path("pipe").c_str(), nullptr);
    ::_exit(127);
  }
  // Caught signals are a mask in hexadecimal.
  constexpr unsigned long kMask = 1ul << (SIGINT - 1) | 1ul << (SIGTERM - 1) | 1ul << (SIGHUP - 1);
  unsigned long caught = 0;
  for (int i = 0; i < 500 && (caught & kMask) != kMask; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind("SigCgt:", 0) == 0) caught = std::stoul(line.substr(7), nullptr, 16);
  }
  EXPECT_EQ(caught & kMask, kMask);
  ::kill(child, SIGTERM);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
}

}  // namespace
}  // namespace isostar::native
