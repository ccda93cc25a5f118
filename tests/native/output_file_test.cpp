#include "files/output_file.h"

#include "files/failure.h"
#include "scratch_folder.h"

namespace isostar::native {
namespace {

using OutputFileTest = ScratchFolder;

TEST_F(OutputFileTest, appearsWholeOnCommit) {
  OutputFile file(path("out"));
  file.write("hello", 5);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  file.commit();
  EXPECT_EQ(read("out"), "hello");
  EXPECT_EQ(fileCount(), 1u);
}

TEST_F(OutputFileTest, leavesNothingWithoutCommit) {
  write("out", "before");
  { OutputFile(path("out")).write("half", 4); }
  EXPECT_EQ(read("out"), "before");
  EXPECT_EQ(fileCount(), 1u);
}

TEST_F(OutputFileTest, replacesWhatALinkPointsTo) {
  write("real", "before");
  std::filesystem::create_symlink("real", path("link"));
  OutputFile file(path("link"));
  file.write("after", 5);
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read("real"), "after");
}

TEST_F(OutputFileTest, keepsPermissions) {
  write("out", "before");
  std::filesystem::permissions(path("out"), std::filesystem::perms::owner_all);
  OutputFile file(path("out"));
  file.commit();
  EXPECT_EQ(std::filesystem::status(path("out")).permissions(), std::filesystem::perms::owner_all);
}

TEST_F(OutputFileTest, writesLongContentInOrder) {
  const std::string content(5'000'001, 'x');
  OutputFile file(path("out"));
  file.write(content.data(), content.size());
  file.write("y", 1);
  file.commit();
  EXPECT_EQ(read("out"), content + "y");
}

TEST_F(OutputFileTest, tellsAFullDisk) {
  OutputFile file("/dev/full");
  file.write("x", 1);
  EXPECT_THROW(file.commit(), Failure);
}

TEST_F(OutputFileTest, leavesDevicesWhereTheyAre) {
  OutputFile file("/dev/null");
  file.write("x", 1);
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, refusesFoldersAndMissingFolders) {
  EXPECT_THROW(OutputFile(path("")), Failure);
  EXPECT_THROW(OutputFile(path("missing/out")), Failure);
}

TEST_F(OutputFileTest, knowsTheInputUnderAnotherName) {
  write("in", "x");
  std::filesystem::create_symlink("in", path("link"));
  EXPECT_THROW(requireDifferent(path("in"), path("link")), UsageFault);
  EXPECT_NO_THROW(requireDifferent(path("in"), path("out")));
}

}  // namespace
}  // namespace isostar::native
