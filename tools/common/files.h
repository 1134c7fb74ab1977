// What a command line may say of files: no output over an input or over another output, endings
// that tell what is written, one input from a pipe. Tool (tool.h) checks all that are registered.
#pragma once

#include <string>
#include <vector>

namespace viewcell {

struct NamedFile {
  std::string name;  ///< for errors: of an output its option, of an input "the mesh that is read"
  std::string path;  ///< empty: not given; "-": standard input or output
  /// Of a folder: the files in it that are read or written, "view-*.png". A star stands for any
  /// part of a name, two for names of any depth. Empty: a file.
  std::vector<std::string> inside = {};
};

/// Throws UsageError when an output is an input (symbolic and hard links count) or would be written
/// over one, when two outputs meet likewise, when two of either are standard input or output, and
/// for a folder that is standard output. Devices and pipes are no such files. A folder of outputs
/// may hold inputs, or the other way round, as long as none is written over; it may not be a folder
/// of inputs.
void check_files(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws MachineError when an output cannot be made where it is to go: its folder is neither there
/// nor made for another output, or it is a folder itself. To say so before the work, not after it.
void check_places(const std::vector<NamedFile>& outputs);

/// Throws UsageError unless the output ends in one of the endings (".ply"; case does not count), is
/// "-", or is a device or a pipe. what: what is written, with its article: "a PLY".
void check_ending(const NamedFile& output, const std::vector<std::string>& endings,
                  const std::string& what);

}  // namespace viewcell
