#include "common/files/whole_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "test/support/temporary_folder.h"

namespace deixis::files {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string FaultOf(const fs::path& file) {
  try {
    WriteWhole(file, "x");
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

std::string LineOf(const fs::path& file) {
  std::string text;
  std::ifstream in(file);
  std::getline(in, text);
  return text;
}

TEST(WholeFile, FollowsLinks) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.Write("file", "first"), link = folder.path() / "link";
  fs::create_symlink("file", link);
  WriteWhole(link, "second");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(LineOf(file), "second");
}

TEST(WholeFile, LeavesPipesInTheirPlace) {
  const test::TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(FaultOf(pipe), HasSubstr("pipe: cannot be written: it is no regular file"));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WholeFile, LeavesTheOldOneWhenItCannotBeWritten) {
  const test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directories(folder / "taken");
  WriteWhole(folder / "file", "first");
  WriteWhole(folder / "file", "second");
  EXPECT_EQ(LineOf(folder / "file"), "second");
  EXPECT_THAT(FaultOf(folder / "taken"), HasSubstr("it is a folder"));
  EXPECT_THAT(FaultOf(folder / "none" / "file"), HasSubstr("none/file: cannot be written"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);  // No part is left.
}

TEST(WholeFile, LeavesNoPartWhenItIsEnded) {
  const test::TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const std::string bytes(std::size_t{1} << 24, 'x');
    for (;;) WriteWhole(folder.path() / "file", bytes);
  }
  while (!fs::exists(folder.path() / "file")) usleep(1000);
  usleep(20000);
  kill(child, SIGTERM);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace deixis::files
