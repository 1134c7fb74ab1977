#include "base/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

std::size_t count_entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFile, ReadsBackEveryByte) {
  const TemporaryFolder folder;
  for (const std::size_t n : {0u, 1u, 4095u, 4096u, 4097u, 100000u}) {
    SCOPED_TRACE(n);
    Random random(n);
    std::string bytes(n, '\0');
    for (char& c : bytes) c = static_cast<char>(random.below(256));
    write_file(folder.path() / "a", bytes);
    EXPECT_EQ(read_file(folder.path() / "a"), bytes);
    EXPECT_EQ(hash_file(folder.path() / "a"), hash_hex(bytes));
  }
  EXPECT_EQ(count_entries(folder.path()), 1u);  // no temporary is left
}

TEST(WriteFile, FailureLeavesTheTargetAndNoTemporary) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "taken");
  write_file(folder.path() / "taken" / "old", "old");
  EXPECT_THROW(write_file(folder.path() / "taken", "new"), MachineError);
  EXPECT_EQ(read_file(folder.path() / "taken" / "old"), "old");
  EXPECT_THROW(write_file(folder.path() / "absent" / "file", "new"), MachineError);
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

// The limit kills in the middle of writing.
void write_until_killed(const fs::path& target) {
  const rlimit limit{4096, 4096};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  write_file(target, std::string(100000, 'x'));
}

TEST(WriteFile, AKillLeavesTheTarget) {
  const TemporaryFolder folder;
  const fs::path target = folder.add("a", "old");
  EXPECT_EXIT(write_until_killed(target), testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EQ(read_file(target), "old");
}

TEST(OutsideWriteFile, AKillLeavesNoTemporaryWhereFilesNeedNoName) {
  const TemporaryFolder folder;
  const int fd = ::open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (fd < 0) GTEST_SKIP() << "no files without a name here";
  ::close(fd);
  EXPECT_EXIT(write_until_killed(folder.add("a", "old")), testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(PendingFile, WithoutCommitNothingIsLeft) {
  const TemporaryFolder folder;
  const fs::path target = folder.add("a", "old");
  {
    const PendingFile pending(target, "half of i");
    EXPECT_EQ(read_file(target), "old");
  }
  EXPECT_EQ(read_file(target), "old");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(PendingFile, CommitReplacesTheTarget) {
  const TemporaryFolder folder;
  const fs::path target = folder.add("a", "old");
  {
    PendingFile one(target, "new"), other(target, "newer");
    bool was_there = false;
    one.commit([&] { was_there = read_file(target) == "new"; });
    EXPECT_TRUE(was_there);
    other.commit();
  }
  EXPECT_EQ(read_file(target), "newer");  // the destructor removes nothing after commit
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(PendingFile, CommitOntoAFolderIsTheMachinesFault) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  PendingFile pending(folder / "a", "new");
  EXPECT_THROW(pending.commit([] { ADD_FAILURE(); }), MachineError);
}

TEST(PendingFolder, WhatIsNotTakenOutGoes) {
  const TemporaryFolder folder;
  folder.add("a.obj", "old");
  {
    PendingFolder pending(folder / "a.obj");
    EXPECT_EQ(pending.path().parent_path(), folder.path());
    for (const char* name : {"a.obj", "a.mtl"}) write_file(pending.path() / name, "new");
    pending.commit("a.obj", folder / "a.obj");
  }
  EXPECT_EQ(read_file(folder / "a.obj"), "new");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(ReadFile, RefusesWhatIsNoReadableFile) {
  const TemporaryFolder folder;
  EXPECT_INPUT_ERROR(read_file(folder.path() / "absent"), "absent: cannot open");
  EXPECT_INPUT_ERROR(read_file(folder.path()), "is a folder");
  const fs::path file = folder.add("a", "12345");
  EXPECT_EQ(read_file(file, 5), "12345");
  EXPECT_INPUT_ERROR(read_file(file, 4), "5 bytes, more than 4");
}

TEST(ReadFile, ReadsAFileWithoutASize) {
  EXPECT_NE(read_file("/proc/self/status").find("Name:"), std::string::npos);
  EXPECT_INPUT_ERROR(read_file("/proc/self/status", 10), "more than 10 bytes");
}

TEST(MakeFolder, MakesParentsAndAcceptsWhatIsThere) {
  const TemporaryFolder folder;
  make_folder(folder.path() / "a" / "b");
  make_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  folder.add("file", "");
  EXPECT_INPUT_ERROR(make_folder(folder.path() / "file"), "is a file, not a folder");
  EXPECT_THROW(make_folder(folder.path() / "file" / "below"), MachineError);
  EXPECT_THROW(make_folder(folder.path() / std::string(300, 'x')), MachineError);
}

TEST(ResolveInside, AcceptsWhatStaysInside) {
  const TemporaryFolder folder;
  make_folder(folder.path() / "sub");
  const fs::path scene = folder.add("scene.json", "");
  const fs::path mesh = folder.add("sub/mesh.ply", "x");
  for (const char* path :
       {"sub/mesh.ply", "./sub/mesh.ply", "sub/../sub/mesh.ply", "sub//mesh.ply"})
    EXPECT_TRUE(fs::equivalent(resolve_inside(scene, "", path), mesh)) << path;
  EXPECT_EQ(resolve_inside(scene, "", "absent.ply"), folder.path() / "absent.ply");
  EXPECT_NO_THROW(resolve_inside(scene, "", "..mesh"));
  fs::create_symlink("sub/mesh.ply", folder.path() / "link.ply");
  EXPECT_NO_THROW(resolve_inside(scene, "", "link.ply"));
}

TEST(ResolveInside, RefusesWhatLeaves) {
  const TemporaryFolder folder;
  make_folder(folder.path() / "park");
  make_folder(folder.path() / "park-2");
  const fs::path scene = folder.add("park/scene.json", "");
  folder.add("secret", "x");
  fs::create_symlink("../secret", folder.path() / "park" / "link");
  fs::create_symlink("..", folder.path() / "park" / "up");
  const std::string absolute = (folder.path() / "park" / "scene.json").string();
  for (const std::string path : {"..", "../secret", "../park-2/x", "a/../../secret", "./../secret",
                                 "link", "up/secret", "up/park/../secret", "/etc/passwd"})
    EXPECT_INPUT_ERROR(resolve_inside(scene, "meshes[2].file", path),
                       "scene.json: meshes[2].file: path '" + path + "'");
  EXPECT_INPUT_ERROR(resolve_inside(scene, "", absolute), "is absolute");
  EXPECT_INPUT_ERROR(resolve_inside(scene, "", ""), "is empty");
  EXPECT_INPUT_ERROR(resolve_inside(scene, "", std::string("a\0b", 3)), "zero byte");
}

// Reading one might never end.
TEST(ResolveInside, RefusesPipesAndDevices) {
  const TemporaryFolder folder;
  const fs::path scene = folder.add("scene.json", "");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder / "link");
  for (const char* name : {"pipe", "link"}) {
    EXPECT_INPUT_ERROR(resolve_inside(scene, "meshes[2].file", name),
                       "scene.json: meshes[2].file: path '" + std::string(name) + "' is a pipe");
    EXPECT_INPUT_ERROR(refuse_special(folder / name), "is a pipe");
  }
  EXPECT_INPUT_ERROR(refuse_special("/dev/zero"), "/dev/zero: is a pipe or a device");
  EXPECT_NO_THROW(refuse_special(scene));
  EXPECT_NO_THROW(refuse_special(folder / "absent"));
}

TEST(ResolveInside, RefusesWhatTheSystemCannotFollow) {
  const TemporaryFolder folder;
  const fs::path scene = folder.add("scene.json", "");
  fs::create_symlink("loop", folder.path() / "loop");
  EXPECT_INPUT_ERROR(resolve_inside(scene, "", "loop"), "path 'loop'");
  EXPECT_INPUT_ERROR(resolve_inside(scene, "", std::string(300, 'x')), "path 'xxx");
}

// A message is one line whatever the file says.
TEST(ResolveInside, MessageIsOneLine) {
  const TemporaryFolder folder;
  EXPECT_INPUT_ERROR(resolve_inside(folder.add("scene.json", ""), "", "../a\nb"), "leaves");
}

TEST(Hash, IsXxh3) {
  EXPECT_EQ(hash_hex(""), "2d06800538d394c2");  // XXH3_64bits of nothing, seed 0
  EXPECT_EQ(hash_hex("a").size(), 16u);
  EXPECT_NE(hash_hex("a"), hash_hex("b"));
}

}  // namespace
}  // namespace viewcell
