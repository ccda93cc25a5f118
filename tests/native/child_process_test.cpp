#include "files/child_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>

#include "byte_string.h"
#include "files/failure.h"
#include "files/sanitizers.h"
#include "scratch_folder.h"
#include "volume_checks.h"

namespace isostar::native {
namespace {

constexpr ChildLimits kLimits{.memory = uint64_t{1} << 30, .seconds = 1};

/// What runInChild() complains of; empty where it does not.
std::string complaintOf(const std::function<void(ChildOutput&)>& work) {
  try {
    ChildOutput output("file");
    runInChild(output, kLimits, work);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return {};
}

TEST(ChildProcess, saysThatMemoryIsNotEnough) {
  if (kReservesAddresses) GTEST_SKIP() << "the limit of memory is not set";
  static std::vector<char> kept;  // an allocation that is not used may be optimized away
  const auto allocate = [](ChildOutput&) { kept.reserve(size_t{1200} << 20); };
  const std::string expected =
      "file: reading takes more than 1.07 GB of memory: the file is damaged or asks for too much";
  EXPECT_EQ(complaintOf(allocate), expected);
  EXPECT_EQ(complaintOf([&](ChildOutput& output) {
              try {
                allocate(output);
              } catch (const std::bad_alloc&) {
                throw Failure("file", "some words of a library");
              }
            }),
            expected);
  EXPECT_EQ(complaintOf([](ChildOutput&) { kept.reserve(size_t{900} << 20); }), "");
}

TEST(ChildProcess, saysThatTimeIsNotEnough) {
  EXPECT_EQ(complaintOf([](ChildOutput&) {
              for (std::atomic<unsigned> i = 0;; ++i) {
              }
            }),
            "file: reading takes more than 1 s: the file is damaged or asks for too much");
}

TEST(ChildProcess, permitsMoreForLongerFiles) {
  EXPECT_GE(limitsFor(0).memory, uint64_t{1} << 30);
  EXPECT_LE(limitsFor(10'000).memory, uint64_t{2'000'000'000});
  EXPECT_LE(limitsFor(10'000).seconds, 9u);
  EXPECT_GE(limitsFor(1'000'000'000).seconds, 1000u);
  EXPECT_GE(limitsFor(UINT64_MAX).memory, uint64_t{1} << 30);
}

TEST(ChildProcess, endsWithItsParent) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::close(ends[0]);
    complaintOf([&](ChildOutput&) {
      (void)!::write(ends[1], "x", 1);
      for (;;) ::pause();
    });
    ::_exit(0);
  }
  ::close(ends[1]);
  char letter;
  EXPECT_EQ(::read(ends[0], &letter, 1), 1);
  ::kill(parent, SIGTERM);
  ::alarm(10);  // ends the test where the child does not end
  EXPECT_EQ(::read(ends[0], &letter, 1), 0) << "only the child could write";
  ::alarm(0);
  ::close(ends[0]);
  ::waitpid(parent, nullptr, 0);
}

using HostileFile = ScratchFolder;

TEST_F(HostileFile, dicomElementOfFourGigabytes) {
  const std::string element{"\x02\x00\x01\x00OB\x00\x00", 8};
  const std::string words =
      complaint(write("a.dcm", std::string(128, '\0') + "DICM" + element + bytesOf(0xf0000000u)));
  EXPECT_NE(words, "");
  if (kReservesAddresses) return;
  EXPECT_NE(words.find("a.dcm: reading takes more than 1.0"), std::string::npos) << words;
}

TEST_F(HostileFile, metaImageOfManyDimensions) {
  for (const char* count : {"4294967296", "0", "-1", "11", "many"}) {
    const std::string words = complaint(
        write("a.mha",
              std::string("ObjectType = Image\nNDims=") + count +
                  "\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678"));
    EXPECT_NE(words.find(" dimensions; at most four are read"), std::string::npos) << words;
  }
}

TEST_F(HostileFile, headersThatNameDevices) {
  const std::string words = complaint(write(
      "a.nhdr",
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 9 9 9\nencoding: raw\ndata file: /dev/zero\n"));
  EXPECT_NE(words.find("a.nhdr: names /dev/zero, which is not a regular file"), std::string::npos)
      << words;
}

}  // namespace
}  // namespace isostar::native
