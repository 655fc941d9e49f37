#include "common/capture/regular_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class RegularFileTest : public testing::Test {
 protected:
  static FileFault FaultOf(const std::filesystem::path& file) {
    const FileContent content = ReadRegularFile(file, 3);
    EXPECT_THAT(content.bytes, IsEmpty());
    return content.fault;
  }

  deixis::test::TemporaryFolder folder_;
};

TEST_F(RegularFileTest, IsReadToItsEnd) {
  const FileContent content = ReadRegularFile(folder_.Write("a", "abc"), 3);
  EXPECT_EQ(content.fault, FileFault::kNone);
  EXPECT_THAT(content.bytes, ElementsAre('a', 'b', 'c'));
}

TEST_F(RegularFileTest, ThatIsEmptyHasNoFault) {
  EXPECT_EQ(FaultOf(folder_.Write("a", "")), FileFault::kNone);
}

TEST_F(RegularFileTest, ThatIsTooLargeIsNotRead) {
  EXPECT_EQ(FaultOf(folder_.Write("a", "abcd")), FileFault::kTooLarge);
  EXPECT_EQ(FaultOf("/proc/self/status"), FileFault::kTooLarge);  // It says that it has 0 bytes.
}

TEST_F(RegularFileTest, IsNeitherFolderNorPipeNorDeviceNorCircle) {
  const std::filesystem::path pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::filesystem::path circle = folder_.path() / "circle";
  std::filesystem::create_symlink("circle", circle);
  for (const std::filesystem::path& file :
       {folder_.path(), pipe, circle, std::filesystem::path("/dev/zero"),
        folder_.path() / "none"}) {
    EXPECT_EQ(FaultOf(file), FileFault::kNoRegularFile) << file;
  }
}

TEST_F(RegularFileTest, ThatCannotBeReadSaysWhy) {
  const FileContent content = ReadRegularFile("/proc/self/mem", 1000);  // Nothing is at address 0.
  EXPECT_EQ(content.fault, FileFault::kUnreadable);
  EXPECT_EQ(content.reason, std::strerror(EIO));
  EXPECT_THAT(content.bytes, IsEmpty());
}

}  // namespace
}  // namespace deixis::capture
