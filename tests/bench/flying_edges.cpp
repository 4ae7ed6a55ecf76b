// The peer: vtkFlyingEdges3D with normals on a grid from a file. A process of its own, so that neither side's memory,
// threads or start-up enters the other's times.
//
//   sgm_bench_vtk GRID THREADS RUNS      prints one line of key=value

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <cstdio>
#include <cstdlib>

#include "grid_file.h"
#include "measure.h"

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: sgm_bench_vtk GRID THREADS RUNS\n");
    return 2;
  }
  const int threads = std::atoi(argv[2]), runs = std::atoi(argv[3]);
  bench::pin(threads);
  vtkSMPTools::Initialize(threads);
  bench::Grid grid = bench::readGrid(argv[1]);

  vtkNew<vtkFloatArray> values;
  values->SetArray(grid.values.data(), static_cast<vtkIdType>(grid.values.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.size);
  image->GetPointData()->SetScalars(values);

  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 0.0);
  filter->ComputeNormalsOn();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  const bench::Times times = bench::timed(2, runs, [&] {
    filter->Modified();
    filter->Update();
  });

  vtkPolyData* out = filter->GetOutput();
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
  const bench::Shape shape = bench::measure(mesh, grid.size[0] - 1);
  std::printf("version=%s median=%.6f least=%.6f most=%.6f vertices=%zu triangles=%zu area=%.6f open=%zu\n",
              vtkVersion::GetVTKVersion(), times.median, times.least, times.most, shape.vertices, shape.triangles,
              shape.area, shape.open_edges);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench_vtk: %s\n", e.what());
  return 1;
}
