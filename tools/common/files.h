// What a command line may say of files: no output over an input or over another output, endings
// that tell what is written, one input from a pipe.
#pragma once

#include <string>
#include <vector>

namespace viewcell {

struct NamedFile {
  std::string name;  ///< for errors: of an output its option, of an input "the mesh that is read"
  std::string path;  ///< empty: not given; "-": standard input or output
};

/// Throws UsageError when an output is an input (symbolic and hard links count), when two outputs
/// are one file, or when two of either are standard input or output. Devices are no such files.
void check_files(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws MachineError when an output cannot be made where it is to go: its folder is not there, or
/// it is a folder itself. To say so before the work, not after it.
void check_places(const std::vector<NamedFile>& outputs);

/// Throws UsageError unless the output ends in one of the endings (".ply"; case does not count), is
/// "-", or is a device or a pipe. what: what is written, with its article: "a PLY".
void check_ending(const NamedFile& output, const std::vector<std::string>& endings,
                  const std::string& what);

}  // namespace viewcell
