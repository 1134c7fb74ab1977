// Collapses a second of every metric, stages of a build, and other simplifiers in the same run.
//   bench_pm --benchmark_filter=/100000 ; the argument is the number of faces, which go to 1 in 100
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "bench/peers.h"
#include "bench/torus.h"
#include "pm/build.h"
#include "pm/recorder.h"
#include "pm/wedge_mesh.h"

namespace viewcell {
namespace {

// The last one asked for is kept.
const TriMesh& torus(std::int64_t n_faces) {
  static std::int64_t n_kept = 0;
  static TriMesh kept;
  if (n_faces == n_kept) return kept;
  n_kept = n_faces;
  kept = {};
  const double n = std::sqrt(static_cast<double>(n_faces) / 4);
  return kept = make_bumpy_torus(static_cast<std::uint32_t>(std::lround(n)));
}

std::size_t target_of(const TriMesh& mesh) {
  return mesh.triangles.size() / 100;
}

// The most memory that the process had since the last call, in bytes (Linux; else 0). A call sets
// the mark back.
double take_peak_bytes() {
  malloc_trim(0);
  double peak_kb = 0;
  if (std::FILE* status = std::fopen("/proc/self/status", "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, status)) std::sscanf(line, "VmHWM: %lf", &peak_kb);
    std::fclose(status);
  }
  if (std::FILE* reset = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", reset);
    std::fclose(reset);
  }
  return 1024 * peak_kb;
}

class Stopwatch {
 public:
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const double s = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return s;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void count(benchmark::State& state, double n_collapses, double time_s) {
  state.SetIterationTime(time_s);
  state.counters["collapses/s"] = n_collapses / time_s;
}

// A whole build, the record with it.
void build(benchmark::State& state, MetricKind metric, Placement placement) {
  const TriMesh& mesh = torus(state.range(0));
  BuildOptions options;
  options.metric = metric;
  options.placement = placement;
  options.qem.mean = false;
  options.target_faces = target_of(mesh);
  for (auto _ : state) {
    take_peak_bytes();
    Stopwatch watch;
    const BuildResult result = build_progressive_mesh(mesh, options);
    count(state, static_cast<double>(result.counts.n_collapses), watch.lap_s());
    state.counters["costs/collapse"] =
        static_cast<double>(result.counts.n_costs) / static_cast<double>(result.counts.n_collapses);
    state.counters["peak_bytes/face"] =
        take_peak_bytes() / static_cast<double>(mesh.triangles.size());
  }
}

// qem3 without textures, stage by stage, in milliseconds.
void stages(benchmark::State& state) {
  TriMesh mesh = torus(state.range(0));
  mesh.texcoords.clear();
  for (auto _ : state) {
    Stopwatch watch;
    const auto lap = [&](const char* name) {
      const double s = watch.lap_s();
      state.counters[name] = 1000 * s;
      return s;
    };
    WedgeOptions wedge_options;
    wedge_options.along_curve = true;
    const WedgeMesh wedges = make_wedges(mesh, wedge_options);
    double sum = lap("wedges_ms");
    const std::vector<Triangle> triangles = wedges.vertex_triangles();
    CollapseMesh work(wedges.positions, triangles);
    sum += lap("mesh_ms");
    QemMetric metric(wedges.positions, triangles, {.mean = false});
    sum += lap("quadrics_ms");
    CollapseLoop loop(work, metric);
    const double first_s = lap("first_costs_ms");
    const CollapseCounts counts = loop.run({.target_triangles = target_of(mesh), .lazy = true});
    const double loop_s = lap("loop_ms");
    count(state, static_cast<double>(counts.n_collapses), sum + first_s + loop_s);
    state.counters["loop_collapses/s"] =
        static_cast<double>(counts.n_collapses) / (first_s + loop_s);
  }
}

void peer(benchmark::State& state, PeerResult (*run)(const TriMesh&, std::size_t)) {
  const TriMesh& mesh = torus(state.range(0));
  for (auto _ : state) {
    const PeerResult result = run(mesh, target_of(mesh));
    count(state, static_cast<double>(result.n_removed), result.time_s);
    state.counters["faces_left"] = static_cast<double>(result.n_faces);
  }
}

constexpr std::int64_t kSmoke = 1600, kUsual = 100'000, kLarge = 1'111'000;
void sizes(benchmark::internal::Benchmark* b) {
  b->Arg(kSmoke)->Arg(kUsual)->Arg(kLarge)->UseManualTime()->Iterations(1)->Unit(
      benchmark::kMillisecond);
}
void sizes_of_slow(benchmark::internal::Benchmark* b) {
  b->Arg(kSmoke)->Arg(kUsual)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(build, qem3, MetricKind::qem3, Placement::half)->Apply(sizes);
BENCHMARK_CAPTURE(build, qem3_full, MetricKind::qem3, Placement::full)->Apply(sizes);
BENCHMARK_CAPTURE(build, lt, MetricKind::lt, Placement::full)->Apply(sizes);
BENCHMARK_CAPTURE(build, qem5, MetricKind::qem5, Placement::half)->Apply(sizes);
BENCHMARK_CAPTURE(build, aps, MetricKind::aps, Placement::half)->Apply(sizes_of_slow);
BENCHMARK_CAPTURE(build, mapping, MetricKind::mapping, Placement::half)->Apply(sizes_of_slow);
BENCHMARK(stages)->Apply(sizes);
BENCHMARK_CAPTURE(peer, meshoptimizer, run_meshoptimizer)->Apply(sizes);
BENCHMARK_CAPTURE(peer, openmesh, run_openmesh)->Apply(sizes);

}  // namespace
}  // namespace viewcell

BENCHMARK_MAIN();
