#pragma once
// What two meshes of one surface are compared by, and what a row of the table holds.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// A mesh in floats in cells of the grid: x y z a vertex, three indices a triangle.
struct Mesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

struct Shape {
  size_t vertices = 0, triangles = 0;
  double area = 0;        ///< square cells
  size_t open_edges = 0;  ///< directed edges without their opposite, but for those in the cube's outer faces
  long euler = 0;         ///< vertices that triangles use, less edges, plus triangles
};

/// extent: cells on an edge of the cube that the mesh lies in.
Shape measure(const Mesh& mesh, double extent);

struct Times {
  double median = 0, least = 0, most = 0;  ///< milliseconds
  int runs = 0;
  double processor = 0;  ///< time of all threads by the clock's, over all runs; of timed() alone
};

/// Milliseconds of processor time that this process's threads have taken.
double processorTime();

/// Most memory that this process has had resident, MB.
double peakMemory();

/// `runs` timed calls of work after `warm_up` untimed ones.
template <class Work>
Times timed(int warm_up, int runs, Work&& work);

/// Milliseconds of a clock that never steps back.
double now();

Times statistics(std::vector<double> milliseconds);

/// Keeps this process on the first `threads` processors that it may use, so that a row says what it claims.
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
