// How long meshes take to read, and grippers to close on them; in time, since most of it is spent
// in libraries.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>

#include "gripper/gripper.hpp"
#include "meshes.hpp"

namespace {

using namespace poise;

/// 100,000 triangles, 20 cm wide.
Mesh fine_torus() { return test::torus_mesh(0.08, 0.02, 500, 100); }

/// As a binary STL file, in which nothing says which vertices are the same.
std::string stl_file() {
  const std::string name =
      (std::filesystem::temp_directory_path() / "poise_bench_torus.stl").string();
  const Mesh mesh = fine_torus();
  std::ofstream out(name, std::ios::binary);
  const auto put = [&](auto number) {
    out.write(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  out << std::string(80, ' ');
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const int i : triangle)
      for (const double x : mesh.vertices[static_cast<std::size_t>(i)]) put(static_cast<float>(x));
    put(std::uint16_t{0});
  }
  return name;
}

void mesh_read(benchmark::State& state) {
  const std::string file = stl_file();
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file));
  std::filesystem::remove(file);
}

void mesh_mended(benchmark::State& state) {
  const Mesh mesh = test::soup(fine_torus());
  for (auto _ : state) benchmark::DoNotOptimize(mended(mesh));
}

void mesh_prepared(benchmark::State& state) {
  const Solid solid = MeshShape{.mesh = std::make_shared<const Mesh>(fine_torus())};
  for (auto _ : state) benchmark::DoNotOptimize(Surface(solid));
}

/// Two pads round the tube, each of so many rays; items are rays.
void jaw_closed(benchmark::State& state) {
  const Surface surface(MeshShape{.mesh = std::make_shared<const Mesh>(fine_torus())});
  std::mt19937 random(1);
  std::uniform_real_distribution<> angle(0, 6.28);
  std::vector<ParallelJaw> jaws(1000);
  for (ParallelJaw& jaw : jaws) {
    jaw.pose.orientation = Eigen::AngleAxisd(angle(random), Vector<3>::UnitZ());
    jaw.pose.position = jaw.pose.orientation * Vector<3>(0.08, 0, 0);
    jaw.opening = 0.06;
    jaw.width = 0.02;
    jaw.height = 0.02;
    jaw.friction = 0.5;
    jaw.samples = static_cast<int>(state.range(0));
  }
  std::size_t next = 0, touched = 0;
  for (auto _ : state) {
    const std::vector<Contact<3>> all = contacts(jaws[next], surface);
    touched += all.size();
    next = (next + 1) % jaws.size();
  }
  state.SetItemsProcessed(state.iterations() * 2 * state.range(0));
  state.counters["contacts"] =
      benchmark::Counter(static_cast<double>(touched), benchmark::Counter::kIsRate);
}

BENCHMARK(mesh_read)->Unit(benchmark::kMillisecond);
BENCHMARK(mesh_mended)->Unit(benchmark::kMillisecond);
BENCHMARK(mesh_prepared)->Unit(benchmark::kMillisecond);
BENCHMARK(jaw_closed)->Arg(1)->Arg(16)->Arg(100);

}  // namespace
