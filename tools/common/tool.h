// What every tool's main shares: the common options, progress on a terminal, one-line errors and
// exit codes (0 ok, 1 input, 2 usage, 3 machine, 4 bug, 5 over the threshold asked for).
#pragma once

#include <functional>
#include <string>

#include "base/json.h"
#include "base/parallel.h"
#include "base/remarks.h"
#include "common/command.h"

namespace viewcell {

/// The exit code of "compared, and over the threshold asked for".
inline constexpr int kOverThreshold = 5;

/// The options that every tool has.
struct CommonOptions {
  std::string output;             ///< -o
  bool quiet = false;             ///< -q: no progress, no summary on stderr
  int n_threads = 0;              ///< -j: 0 = all cores
  std::string json_file;          ///< --json: a report, "-" = standard output
  std::size_t max_triangles = 0;  ///< --max-triangles, of tools that read meshes; 0: as read_mesh
};

/// A tool: its command line, declared in the constructor's caller, and its common options.
class Tool : public Command {
 public:
  /// example: one or more command lines, shown under --help.
  Tool(const std::string& name, const std::string& description, const std::string& example);

  const CommonOptions& common() const { return common_; }
  /// Declares -o, required unless said otherwise: a file, a folder in which such files are written
  /// (files.h), or, with add_output_stem, the beginning of names that `prepare` makes and
  /// registers.
  void add_output(const std::string& description, bool required = true);
  void add_output_folder(const std::string& description, const std::vector<std::string>& inside,
                         bool required = true);
  void add_output_stem(const std::string& description);
  /// Declares --max-triangles, of the tool or of one of its commands (read_mesh_input).
  void add_mesh_limit(Command& command);

  /// Parses; prepares: what the command line alone shows to be wrong, and files that it names
  /// indirectly; checks all files; runs. Turns exceptions into one line on stderr and an exit code.
  /// `run` returns the exit code (0 or 5).
  int main(int argc, char** argv, const std::function<void()>& prepare,
           const std::function<int()>& run);
  int main(int argc, char** argv, const std::function<int()>& run);

  /// Registers files that no option names as they are. While the tool runs they are checked at
  /// once: to be called before the work. Throw what check_files and check_places throw.
  void reads(const std::vector<NamedFile>& files);
  void writes(const std::vector<NamedFile>& files);

  /// A bar on stderr when that is a terminal and -q is absent; otherwise empty.
  Progress progress(const std::string& what) const;
  /// A line for people on stderr, unless -q.
  void say(const std::string& line) const;
  /// The same of what is not as it should be: with -q, too.
  void warn(const std::string& line) const;
  /// What was passed over in a file: a line each on stderr, unless -q, and "remarks" of the report.
  void remark(const std::filesystem::path& file, const Remarks& remarks) const;
  /// Writes the report where --json asks for it, if it does.
  void report(const Json& json) const;

 private:
  Option& declare_output(const std::string& description, bool required);
  void check_all_files() const;

  CommonOptions common_;
  std::string example_;
  std::vector<NamedFile> inputs_, outputs_;
  bool is_running_ = false;
  mutable Json remarks_ = Json::array();  // of the report: file, what, count
};

}  // namespace viewcell
