// Hard links and copies of files from older results.
#include "experiments/laboratory/host/link_files.hpp"

#include <sys/stat.h>

#include "tests/laboratory/support/support.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// Pictures may be large, so they get a hard link instead of a copy.
TEST(Carry, AFileGetsASecondName) {
  const TemporaryFolder folder;
  write_file(folder.path / "a", "new");
  write_file(folder.path / "b", "old");
  link_file(folder.path / "a", folder.path / "b");
  EXPECT_TRUE(fs::equivalent(folder.path / "a", folder.path / "b"));
  EXPECT_EQ(read_file(folder.path / "b"), "new");
}

TEST(Carry, ToAnotherFileSystemItIsCopied) {
  const fs::path other = "/dev/shm";
  const TemporaryFolder folder;
  struct stat here, there;
  if (stat(folder.path.c_str(), &here) != 0 || stat(other.c_str(), &there) != 0 ||
      here.st_dev == there.st_dev)
    GTEST_SKIP() << "no other file system";
  const auto to = other / folder.path.filename();
  write_file(folder.path / "a", "new");
  link_file(folder.path / "a", to);
  EXPECT_EQ(read_file(to), "new");
  fs::remove(to);
}

TEST(Carry, FilesThatAreThereAreKeptAndHiddenOnesLeft) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path / "from");
  fs::create_directories(folder.path / "to");
  for (const char* name : {"a", "b", ".c"}) write_file(folder.path / "from" / name, "new");
  write_file(folder.path / "to" / "b", "old");
  link_files(folder.path / "from", folder.path / "to");
  EXPECT_EQ(read_file(folder.path / "to" / "a"), "new");
  EXPECT_EQ(read_file(folder.path / "to" / "b"), "old");
  EXPECT_FALSE(fs::exists(folder.path / "to" / ".c"));
}

}  // namespace
}  // namespace laboratory
