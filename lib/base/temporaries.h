// What is on disk only while it is being made: it goes when the making fails, when a signal ends
// the process and, after a kill, with the next run that writes into its folder.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

namespace viewcell {

/// Runs step() as one: a signal that ends the process comes before it or after it, not between.
/// Steps of several threads wait for each other; a step may hold further ones.
void run_uninterrupted(const std::function<void()>& step);

/// Undoes all that is unfinished, and lets no further step begin: to be called when a signal has
/// come, and the process must then be ended.
void undo_unfinished();

/// While it lives, undo() runs when a signal ends the process.
class UndoOnSignal {
 public:
  explicit UndoOnSignal(std::function<void()> undo);
  ~UndoOnSignal();
  UndoOnSignal(const UndoOnSignal&) = delete;
  UndoOnSignal& operator=(const UndoOnSignal&) = delete;
};

/// A file or a folder that is removed again, by the destructor or when a signal ends the process,
/// unless it is kept.
class Temporary {
 public:
  Temporary() = default;
  ~Temporary() { remove(); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  /// make() brings it there, or returns false. To be called once.
  bool make(const std::filesystem::path& path, const std::function<bool()>& make);
  const std::filesystem::path& path() const { return path_; }
  /// It is at the target, in place of what was there. False: it is not; errno says why.
  bool rename_to(const std::filesystem::path& target);
  void keep();
  void remove();

 private:
  std::filesystem::path path_;  // empty: none
  std::unique_ptr<UndoOnSignal> undo_;
};

/// ".tmp-PID-RANDOM-NAME" beside the target: a name that nobody can foretell. The dot keeps it out
/// of globs.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

/// Holds the lock on an open temporary that says its process lives. False: it is being removed.
bool lock_temporary(int fd);

/// Removes files and folders of ours in the folder whose names are those of temporaries and whose
/// processes are gone. Looks once into each folder.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace viewcell
