#include "base/whole_file.hpp"

#include <fmt/format.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <ostream>
#include <system_error>
#include <thread>

#include <gtest/gtest.h>
#include "base/errors.hpp"

#include "tests/support/files.hpp"
#include "tests/support/isolated.hpp"

namespace base {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

std::string write_error(const fs::path& path) {
  return message_of<std::system_error>([&] { save_whole(path, "bytes"); });
}

TEST(WholeFile, WritesAndReadsAnyBytes) {
  const TemporaryFolder folder;
  std::string bytes;
  for (unsigned i = 0; i < 300000; ++i) bytes += static_cast<char>(i * i >> 3);
  save_whole(folder.path / "a", "old");
  for (const auto& content : {bytes, std::string()}) {
    save_whole(folder.path / "a", content);
    EXPECT_EQ(read_text(folder.path / "a"), content);
  }
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(WholeFile, ErrorsNameThePath) {
  const TemporaryFolder folder;
  const auto missing = folder.path / "none" / "a";
  EXPECT_EQ(write_error(missing),
            missing.string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(write_error(folder.path), folder.path.string() + ": cannot be written: Is a directory");
  const auto read_error = [](const fs::path& path, std::size_t most) {
    return message_of<BadInput>([&] { read_text(path, most); });
  };
  EXPECT_EQ(read_error(missing, 9),
            missing.string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(read_error(folder.path, 9), folder.path.string() + ": cannot be read: Is a directory");
  EXPECT_TRUE(folder.names().empty());
  save_whole(folder.path / "a", "0123456789");
  EXPECT_EQ(read_error(folder.path / "a", 10), "");
  EXPECT_EQ(read_error(folder.path / "a", 9),
            (folder.path / "a").string() + ": longer than the limit of 9 bytes");
}

TEST(WholeFile, WhatCannotBeSavedIsKnownBefore) {
  const TemporaryFolder folder;
  const auto told = [](const fs::path& path) {
    return message_of<std::system_error>([&] { check_can_save(path); });
  };
  EXPECT_EQ(told(folder.path / "a"), "");
  EXPECT_EQ(told("/dev/null"), "");
  EXPECT_TRUE(told(folder.path).ends_with("cannot be written: Is a directory"));
  EXPECT_TRUE(told(folder.path / "none/a").ends_with(": No such file or directory"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(WholeFile, ReadOnlyFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(write_error(folder.path / "a").find("Permission denied"), std::string::npos);
  fs::permissions(folder.path, fs::perms::owner_all);
}

TEST(WholeFile, FullDiskLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  save_whole(folder.path / "a", "old");
  const auto found = test::isolated([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto error_of = [&](const char* name) {
      return message_of<std::system_error>(
          [&] { save_whole(folder.path / name, std::string(200000, 'x')); });
    };
    return error_of("a") + error_of("b");
  });
  const auto error = [&](const char* name) {
    return (folder.path / name).string() + ": cannot be written: File too large";
  };
  EXPECT_EQ(found, error("a") + error("b"));
  EXPECT_EQ(folder.names(), Names{"a"});
  EXPECT_EQ(read_text(folder.path / "a"), "old");
}

TEST(WholeFile, ANewFileReplacesNone) {
  const TemporaryFolder folder;
  EXPECT_TRUE(save_new(folder.path / "a", "first"));
  EXPECT_FALSE(save_new(folder.path / "a", "second"));
  EXPECT_EQ(read_text(folder.path / "a"), "first");
  EXPECT_EQ(folder.names(), Names{"a"});
}

// Installs a seccomp filter that makes system calls of this process fail from now on. Returns false
// if the kernel refuses the filter.
bool install(const std::vector<sock_filter>& filter) {
  auto copy = filter;
  const sock_fprog program{static_cast<unsigned short>(copy.size()), copy.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// Simulates, for the rest of this process, a file system such as NFS that does not support renames
// with flags. With `links_too`, it does not support hard links either. Returns false if the kernel
// refuses the filter.
bool forget_renames_with_flags(bool links_too) {
  std::vector<sock_filter> filter;
  const auto load = [&](std::size_t at) {
    filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(at)));
  };
  const auto fail_with = [&](unsigned error) {
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error));
  };
  load(offsetof(seccomp_data, nr));
  std::vector<unsigned> links{SYS_linkat};
#ifdef SYS_link
  links.push_back(SYS_link);
#endif
  if (links_too)
    for (const unsigned call : links) {
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
      fail_with(EPERM);
    }
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 3));
  load(offsetof(seccomp_data, args[4]));
  filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0));
  fail_with(EINVAL);
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  return install(filter);
}

// Some file systems report a full disk only in fsync(); others do not support fsync() at all. The
// first kind of error must be reported. The second kind must be ignored.
TEST(WholeFile, WhatIsNotStoredAtLastIsAnError) {
  const auto told = [](unsigned error) {
    return test::isolated([&]() -> std::string {
      const TemporaryFolder folder;
      if (!install({BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_fsync, 0, 1),
                    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error),
                    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)}))
        return "no filter";
      const auto message = write_error(folder.path / "a");
      const auto files = folder.names().size();
      return fmt::format("{} file(s){}", files,
                         message.substr(std::min(message.size(), message.rfind(": "))));
    });
  };
  if (told(ENOSPC) == "no filter") GTEST_SKIP() << "no filters of system calls";
  EXPECT_EQ(told(ENOSPC), "0 file(s): No space left on device");
  for (const unsigned nothing_to_do : {EINVAL, ENOTSUP})
    EXPECT_EQ(told(nothing_to_do), "1 file(s)");
}

TEST(WholeFile, ANewFileReplacesNoneWhereRenamesHaveNoFlags) {
  for (const bool links_too : {false, true}) {
    const TemporaryFolder folder;
    const auto told = test::isolated([&]() -> std::string {
      if (!forget_renames_with_flags(links_too)) return "no filter";
      const bool first = save_new(folder.path / "a", "first");
      const bool second = save_new(folder.path / "a", "second");
      return std::string(first ? "saved" : "not") + (second ? " twice" : " once");
    });
    if (told == "no filter") GTEST_SKIP() << "no filters of system calls";
    EXPECT_EQ(told, "saved once");
    EXPECT_EQ(read_text(folder.path / "a"), "first");
    EXPECT_EQ(folder.names(), Names{"a"});
  }
}

TEST(WholeFile, ANameMayBeAsLongAsTheDiskAllows) {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  save_whole(folder.path / longest, "bytes");
  EXPECT_EQ(folder.names(), Names{longest});
}

TEST(WholeFile, WhatFailsHalfWayLeavesTheOldFile) {
  const TemporaryFolder folder;
  save_whole(folder.path / "a", [](std::ostream& out) { out << "one " << 2; });
  EXPECT_EQ(read_text(folder.path / "a"), "one 2");
  const auto stop = [](std::ostream& out) {
    out << "three";
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(save_whole(folder.path / "a", stop), std::runtime_error);
  EXPECT_EQ(read_text(folder.path / "a"), "one 2");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(WholeFile, DevicesAreWrittenToAndNotReplaced) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(write_error("/dev/full"), "/dev/full: cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(WholeFile, LinksAreFollowed) {
  const TemporaryFolder folder;
  save_whole(folder.path / "a", "old");
  fs::create_symlink("a", folder.path / "link");
  save_whole(folder.path / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_EQ(read_text(folder.path / "a"), "new");
}

// A file that was read must not be overwritten under any of its names. A new file that has taken
// its place may be overwritten.
TEST(WholeFile, InputsAreNotReplaced) {
  const TemporaryFolder folder;
  const auto a = folder.path / "a", hard = folder.path / "hard", soft = folder.path / "soft";
  save_whole(a, "old");
  fs::create_hard_link(a, hard);
  fs::create_symlink("a", soft);
  const InputGuard guard;
  read_own_text(a);
  EXPECT_NO_THROW(check_can_save(a));
  read_text(soft);
  for (const auto& path : {a, hard, soft}) {
    EXPECT_THROW(save_whole(path, "new"), BadInput) << path;
    EXPECT_THROW(check_can_save(path), BadInput) << path;
    EXPECT_EQ(read_own_text(path), "old");
  }
  fs::remove(a);
  for (int i = 0; i < 100; ++i) {  // repeat, because the file system may reuse inodes
    EXPECT_NO_THROW(save_whole(folder.path / "b", std::to_string(i)));
    EXPECT_EQ(read_own_text(folder.path / "b"), std::to_string(i));
  }
}

TEST(WholeFile, DevicesAndSilentPipesAreNotRead) {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto refusal = [](const fs::path& path) {
    return message_of<BadInput>([&] { read_text(path); });
  };
  EXPECT_EQ(refusal("/dev/zero"),
            "/dev/zero: cannot be read: found a device, expected a file or a pipe");
  EXPECT_EQ(refusal(pipe), pipe.string() +
                               ": cannot be read: found an empty pipe, expected a file, or a pipe "
                               "with a writer");
}

// A sparse file is refused because of its stated size, before it is read into memory.
TEST(WholeFile, LongFilesAreNotRead) {
  const TemporaryFolder folder;
  const auto path = folder.path / "sparse";
  std::ofstream(path) << "x";
  fs::resize_file(path, std::uintmax_t{1} << 42);
  for (const auto& read : {std::function([&] { read_text(path); }), {[&] { read_own_text(path); }}})
    try {
      read();
      ADD_FAILURE();
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find("longer than the limit of"), std::string::npos);
    }
}

TEST(WholeFile, PipesAreWrittenToAndRead) {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { save_whole(pipe, "through"); });
  EXPECT_EQ(read_text(pipe), "through");
  writer.join();
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WholeFile, PipesThatNobodyReadsAreRefused) {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto refusal =
      pipe.string() +
      ": cannot be written: found a pipe that nobody reads, expected a file, or a pipe with a "
      "reader";
  EXPECT_EQ(message_of<BadInput>([&] { check_can_save(pipe); }), refusal);
  EXPECT_EQ(message_of<BadInput>([&] { save_whole(pipe, "lost"); }), refusal);
}

// A reader ends when no writer has the pipe open. The pipe must therefore stay open between the
// check and the output.
TEST(WholeFile, PipesStayOpenAfterTheyWereChecked) {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] {
    check_can_save(pipe);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    save_whole(pipe, "through");
  });
  std::ifstream in(pipe);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "through");
  writer.join();
}

}  // namespace
}  // namespace base
