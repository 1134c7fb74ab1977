// A test's own folder, and files put into it.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "mesh/temporary_folder.h"

namespace viewcell {

/// The bytes in a file, without the sync of write_file: for inputs by the hundred.
inline void put_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  ASSERT_TRUE(stream.flush()) << file;
}

}  // namespace viewcell
