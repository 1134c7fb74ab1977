// Wavefront OBJ.
#include "fuzz.h"
#include "mesh_laws.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  viewcell::fuzz_mesh_reader("in.obj", viewcell::view_of(data, n_bytes));
  return 0;
}
