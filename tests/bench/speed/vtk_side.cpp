// Benchmarks VTK's filters on a grid from a file. It is a separate process, so that memory, threads and start-up of VTK
// and of our library do not influence each other's times.
//
//   sgm_bench_vtk flying-edges|flying-edges-plain|marching-cubes|contour GRID THREADS RUNS
//
// flying-edges computes normals; the others do not. marching-cubes and contour use one thread, whatever THREADS is.

#include <vtkCellArray.h>
#include <vtkContourFilter.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "answer.h"
#include "grid_file.h"

namespace {

bench::Mesh meshOf(vtkPolyData* out) {
  bench::Mesh mesh;
  for (vtkIdType i = 0; i < out->GetNumberOfPoints(); ++i) {
    double p[3];
    out->GetPoint(i, p);
    for (const double x : p) mesh.positions.push_back(static_cast<float>(x));
  }
  vtkIdType count;
  const vtkIdType* ids;
  vtkCellArray* polys = out->GetPolys();
  for (polys->InitTraversal(); polys->GetNextCell(count, ids);)
    for (vtkIdType i = 0; i < count; ++i) mesh.indices.push_back(static_cast<uint32_t>(ids[i]));
  return mesh;
}

template <class Filter>
void run(Filter* filter, const char* name, vtkImageData* image, int runs) {
  filter->SetInputData(image);
  filter->SetValue(0, 0.0);
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  const bench::Times times = bench::timed(2, runs, [&] {
    filter->Modified();
    filter->Update();
  });
  bench::printTimes(name, times);
  bench::printShape(bench::measure(meshOf(filter->GetOutput()), image->GetDimensions()[0] - 1));
  std::printf(" version=%s\n", vtkVersion::GetVTKVersion());
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string name = argc == 5 ? argv[1] : "";
  if (name != "flying-edges" && name != "flying-edges-plain" && name != "marching-cubes" && name != "contour") {
    std::fprintf(stderr,
                 "usage: sgm_bench_vtk flying-edges|flying-edges-plain|marching-cubes|contour GRID THREADS RUNS\n");
    return 2;
  }
  const int threads = std::atoi(argv[3]), runs = std::atoi(argv[4]);
  bench::pin(threads);
  vtkSMPTools::Initialize(threads);
  bench::Grid grid = bench::readGrid(argv[2]);
  vtkNew<vtkFloatArray> values;
  values->SetArray(grid.values.data(), static_cast<vtkIdType>(grid.values.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.size);
  image->GetPointData()->SetScalars(values);
  if (name == "marching-cubes") {
    vtkNew<vtkMarchingCubes> filter;
    filter->ComputeNormalsOff();
    run(filter.Get(), "marching-cubes", image, runs);
  } else if (name == "contour") {
    vtkNew<vtkContourFilter> filter;
    filter->ComputeNormalsOff();
    run(filter.Get(), "contour", image, runs);
  } else {
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetComputeNormals(name == "flying-edges");
    run(filter.Get(), name.c_str(), image, runs);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_vtk: %s\n", e.what());
  return 1;
}
