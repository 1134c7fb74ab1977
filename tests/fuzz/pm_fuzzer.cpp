// Progressive meshes.
#include "base/file.h"
#include "fuzz.h"
#include "mesh_laws.h"
#include "pm/pm_file.h"

namespace viewcell {
namespace {

// From the base to the input and back.
void walk(const ProgressiveRecord& record) {
  ProgressiveMesh mesh(record);
  const std::size_t n_base = mesh.n_faces(), n_splits = mesh.n_splits();
  for (std::size_t i = 0; i < n_splits; ++i) mesh.refine();
  hold(mesh.n_faces() == record.faces.size(), "the finest level has all faces");
  hold_mesh_laws(mesh.extract());
  mesh.set_level(n_splits / 2);
  hold_mesh_laws(mesh.extract());
  mesh.set_faces(1);
  hold(mesh.level() == 0 && mesh.n_faces() == n_base, "coarsening undoes refining");
  hold_mesh_laws(mesh.extract());
}

}  // namespace
}  // namespace viewcell

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto file = put_input("in.pm", view_of(data, n_bytes));
  ProgressiveRecord record;
  if (!is_taken([&] { record = read_pm(file); })) return 0;
  walk(record);
  const auto first = fuzz_folder() / "first.pm", second = fuzz_folder() / "second.pm";
  write_pm(first, record);
  write_pm(second, read_pm(first));
  hold(read_file(first) == read_file(second), "what is written reads back");
  return 0;
}
