#pragma once
// Measures by which meshes of the same surface are compared, and functions that measure times.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// A triangle mesh. positions: x y z of each vertex, in units of a grid cell; indices: three per triangle.
struct Mesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

struct Shape {
  size_t vertices = 0, triangles = 0;
  double area = 0;        ///< square cells
  size_t open_edges = 0;  ///< number of directed edges without an opposite edge, except those on the meshed cube's
                          ///< outer faces
  long euler = 0;         ///< Euler characteristic: used vertices - edges + triangles
};

/// Measures a mesh. extent: edge of the cube that contains the mesh, in grid cells.
Shape measure(const Mesh& mesh, double extent);

struct Times {
  double median = 0, least = 0, most = 0;  ///< milliseconds
  int runs = 0;
  double processor = 0;  ///< processor time of all threads divided by wall time, over all runs; set by timed() only
};

/// Returns the processor time, in milliseconds, that all threads of this process have used.
double processorTime();

/// Returns the peak resident memory of this process in MB.
double peakMemory();

/// Calls work() `warm_up` times without measuring, then measures the times of `runs` further calls.
template <class Work>
Times timed(int warm_up, int runs, Work&& work);

/// Returns the time of a monotonic clock in milliseconds.
double now();

Times statistics(std::vector<double> milliseconds);

/// Restricts this process to the first `threads` of the processors that it may use, so that a measurement with
/// `threads` threads cannot use more processors than that.
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
