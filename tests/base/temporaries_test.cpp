#include "base/temporaries.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <set>
#include <thread>

#include "base/folder_lock.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {
namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

// A file that holds a lock as a living process' temporary does, or none.
Descriptor make_temporary(const fs::path& path, bool locked) {
  Descriptor fd(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  EXPECT_TRUE(fd.is_open() && (!locked || lock_temporary(fd.get())));
  return fd;
}

TEST(Temporary, NamesCannotBeForetold) {
  std::set<fs::path> names;
  for (int i = 0; i < 1000; ++i) names.insert(temporary_beside("folder/a.exr"));
  EXPECT_EQ(names.size(), 1000u);
  EXPECT_EQ(names.begin()->parent_path(), "folder");
  EXPECT_EQ(names.begin()->filename().string().substr(0, 5), ".tmp-");
  EXPECT_EQ(names.begin()->extension(), ".exr");
  EXPECT_LE(temporary_beside(std::string(255, 'x')).string().size(), 255u);
}

TEST(Temporary, GoesUnlessItIsKept) {
  const TemporaryFolder folder;
  const auto touch = [&](const std::string& name) {
    return [&folder, name] { return std::ofstream(folder / name).good(); };
  };
  {
    Temporary gone, kept, renamed, none;
    EXPECT_TRUE(gone.make(folder / "gone", touch("gone")));
    EXPECT_TRUE(kept.make(folder / "kept", touch("kept")));
    EXPECT_TRUE(renamed.make(folder / "renamed", touch("renamed")));
    EXPECT_FALSE(none.make(folder / "none", [] { return false; }));
    kept.keep();
    EXPECT_TRUE(renamed.rename_to(folder / "target"));
  }
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"kept", "target"}));
}

// Of processes that are gone, files and folders; not what a living one holds, what is no temporary
// by its name, and what is of another kind. Names without a lock are those of earlier versions.
TEST(Leftovers, GoOnlyWhenTheirProcessIsGone) {
  const TemporaryFolder folder;
  const std::string random = "0123456789abcdef";
  const pid_t gone = ::fork();  // a number that no process has
  if (gone == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(gone, nullptr, 0), gone);
  const std::string dead = std::to_string(gone), living = std::to_string(::getppid());
  for (const std::string& name : {".tmp-" + living + "-" + random + "-gone",
                                  ".tmp-" + dead + "-0-gone", ".tmp-" + dead + "-12-centre.exr"})
    make_temporary(folder / name, false);
  fs::create_directories(folder / (".tmp-" + dead + "-" + random + "-folder") / "inside");
  const std::set<std::string> kept = {".tmp-" + dead + "-" + random + "-held",
                                      ".tmp-" + living + "-0-kept",
                                      ".tmp-" + dead + "-0",
                                      ".tmp-" + dead + "-x-kept",
                                      ".tmp-x-0-kept",
                                      ".tmp-" + dead + "-" + random + "-pipe",
                                      "tmp-" + dead + "-0-kept",
                                      ".tmp-" + dead + "-3-folder"};
  std::vector<Descriptor> held;
  for (const std::string& name : kept)
    if (name.ends_with("pipe"))
      ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    else if (name.ends_with("folder"))
      fs::create_directory(folder / name);
    else
      held.push_back(make_temporary(folder / name, name.ends_with("held")));
  remove_leftovers(folder.path());
  EXPECT_EQ(names_in(folder.path()), kept);
}

TEST(Leftovers, AreLookedForWhereSomethingIsWritten) {
  const TemporaryFolder folder;
  make_temporary(folder / ".tmp-1-0123456789abcdef-x", false);
  write_file(folder / "a", "a");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a"});
}

// A link at a temporary's name is never written through: its target stays.
TEST(Leftovers, LinksStayAndLeadNowhere) {
  const TemporaryFolder folder;
  folder.add("victim", "precious");
  fs::create_symlink("victim", folder / ".tmp-1-0123456789abcdef-a");
  const TemporaryFolder other;
  fs::create_symlink(folder / "victim", other / ".tmp-1-0123456789abcdef-a");
  write_file(other / "a", "a");
  EXPECT_EQ(read_file(folder / "victim"), "precious");
  EXPECT_TRUE(fs::is_symlink(other / ".tmp-1-0123456789abcdef-a"));
}

// In a process of its own: what is unfinished goes, and no step begins after it.
void undo_with_unfinished(const fs::path& folder) {
  Temporary file, kept;
  file.make(folder / "file", [&] { return std::ofstream(folder / "file").good(); });
  kept.make(folder / "kept", [&] { return std::ofstream(folder / "kept").good(); });
  kept.keep();
  PendingFolder pending(folder / "x");
  write_file(pending.path() / "inside", "inside");
  const PendingFile unnamed(folder / "y", "bytes");
  const FolderLock lock(folder, "test", "content");
  undo_unfinished();
  std::thread late([&] { write_file(folder / "late", "late"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::_exit(7);
}

TEST(Signals, NothingUnfinishedStays) {
  const TemporaryFolder folder;
  EXPECT_EXIT(undo_with_unfinished(folder.path()), testing::ExitedWithCode(7), "");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"kept"});
}

TEST(FolderLock, OneContentAtATime) {
  const TemporaryFolder folder;
  const auto is_refused = [&](const std::string& content) {
    try {
      FolderLock(folder.path(), "other", content);
      return false;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("depthcap is writing there"), std::string::npos);
      return true;
    }
  };
  {
    const FolderLock first(folder.path(), "depthcap", "a");
    EXPECT_TRUE(is_refused("b"));
    EXPECT_TRUE(is_refused("a"));  // of another tool
    {
      const FolderLock second(folder.path(), "depthcap", "a");
      EXPECT_TRUE(is_refused("b"));
    }
    EXPECT_TRUE(is_refused("b"));
    EXPECT_EQ(names_in(folder.path()).size(), 1u);
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_FALSE(is_refused("b"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, AKilledHolderBindsNobody) {
  const TemporaryFolder folder;
  folder.add(".viewcell-lock", "depthcap a");
  { const FolderLock lock(folder.path(), "svmesh", "b"); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, NothingIsWrittenIntoWhatSomebodyPutThere) {
  const TemporaryFolder folder;
  folder.add("victim", "precious");
  fs::create_hard_link(folder / "victim", folder / ".viewcell-lock");
  { const FolderLock lock(folder.path(), "test", "a"); }
  fs::create_symlink("victim", folder / ".viewcell-lock");
  EXPECT_THROW(FolderLock(folder.path(), "test", "a"), MachineError);
  fs::remove(folder / ".viewcell-lock");
  put_bytes(folder / ".viewcell-lock", std::string(1000, 'x'));
  { const FolderLock lock(folder.path(), "test", "a"); }
  EXPECT_EQ(read_file(folder / "victim"), "precious");
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"victim"});
}

// Never more than one content, whatever the order.
TEST(FolderLock, ManyAtOnce) {
  const TemporaryFolder folder;
  std::atomic<int> n_of[2] = {0, 0}, n_held = 0;
  std::atomic<bool> met = false;
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 200; ++i) try {
          const FolderLock lock(folder.path(), "test", std::to_string(t % 2));
          ++n_of[t % 2], ++n_held;
          met = met || n_of[1 - t % 2] > 0;
          std::this_thread::yield();
          --n_of[t % 2];
        } catch (const InputError&) {
        }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_FALSE(met);
  EXPECT_GT(n_held, 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderHold, AFolderThatIsHeldStays) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bake" / "cells");
  {
    const FolderHold one(folder / "bake"), other(folder / "bake");
    EXPECT_FALSE(remove_unheld(folder / "bake"));
  }
  EXPECT_TRUE(remove_unheld(folder / "bake"));
  EXPECT_TRUE(remove_unheld(folder / "bake"));  // it is gone
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const FolderHold none(folder / "absent");
}

}  // namespace
}  // namespace viewcell
