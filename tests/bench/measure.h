#pragma once
// Measures by which meshes of the same surface are compared, and the times in a row of the table.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// A mesh with float positions in units of a grid cell: x y z for each vertex, three indices for each triangle.
struct Mesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

struct Shape {
  size_t vertices = 0, triangles = 0;
  double area = 0;        ///< square cells
  size_t open_edges = 0;  ///< directed edges without an opposite edge, except those on the cube's outer faces
  long euler = 0;         ///< Euler characteristic: used vertices - edges + triangles
};

/// extent: edge of the cube that contains the mesh, in grid cells.
Shape measure(const Mesh& mesh, double extent);

struct Times {
  double median = 0, least = 0, most = 0;  ///< milliseconds
  int runs = 0;
  double processor = 0;  ///< set by timed() alone: processor time of all threads divided by wall time, over all runs
};

/// Milliseconds of processor time that all threads of this process have used.
double processorTime();

/// Peak resident memory of this process, MB.
double peakMemory();

/// Calls work `warm_up` times without and then `runs` times with time measurement.
template <class Work>
Times timed(int warm_up, int runs, Work&& work);

/// Milliseconds of a monotonic clock.
double now();

Times statistics(std::vector<double> milliseconds);

/// Restricts this process to the first `threads` processors that it may use, so that a row really measures that number.
void pin(int threads);

template <class Work>
Times timed(int warm_up, int runs, Work&& work) {
  for (int i = 0; i < warm_up; ++i) work();
  std::vector<double> all;
  const double begin = now(), processor = processorTime();
  for (int i = 0; i < runs; ++i) {
    const double start = now();
    work();
    all.push_back(now() - start);
  }
  const double took = now() - begin, busy = processorTime() - processor;
  Times times = statistics(std::move(all));
  times.processor = busy / took;
  return times;
}

}  // namespace bench
