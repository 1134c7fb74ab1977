// Who may write into a folder, and who reads there.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/descriptor.h"

namespace viewcell {

/// While it lives, writers of other content are refused in the folder; writers of the same content
/// (slices of one bake) may share it. The lock is a file ".viewcell-lock", which goes with its last
/// holder and, after a kill, binds nobody. Where the file system knows no locks there is none.
class FolderLock {
 public:
  /// The folder must be there. writer: the tool's name, for errors; content: what tells its runs
  /// apart, one line. Throws InputError when another process writes other content there.
  FolderLock(const std::filesystem::path& folder, const std::string& writer,
             const std::string& content);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  struct Holder;
  std::unique_ptr<Holder> holder_;  // null: no locks here
};

/// A reader's hold on a folder, against remove_unheld(). None where the folder cannot be opened or
/// the file system knows no locks.
class FolderHold {
 public:
  explicit FolderHold(const std::filesystem::path& folder);

 private:
  Descriptor fd_;
};

/// Removes the folder with all that is in it, unless a reader holds it. Whether it is gone.
bool remove_unheld(const std::filesystem::path& folder);

}  // namespace viewcell
