#!/usr/bin/env python3
"""scikit-image's marching_cubes on a grid from a file: skimage_side.py GRID RUNS. Prints one line of key=value.

It has one thread and computes normals always. Samples are given as it keeps them, in C order with x last.
"""
import resource
import sys
import time

import numpy
import skimage
from skimage import measure


def main():
    path, runs = sys.argv[1], int(sys.argv[2])
    with open(path, "rb") as file:
        size = numpy.fromfile(file, numpy.int32, 4)[:3]
        values = numpy.fromfile(file, numpy.float32).reshape(size[2], size[1], size[0])
    times = []
    begin_cpu = None
    for i in range(runs + 1):
        if i == 1:
            begin, begin_cpu = time.perf_counter(), time.process_time()
        start = time.perf_counter()
        points, triangles, _, _ = measure.marching_cubes(values, 0.0)
        times.append(1e3 * (time.perf_counter() - start))
    processor = (time.process_time() - begin_cpu) / (time.perf_counter() - begin)
    times = sorted(times[1:])
    a, b, c = (points[triangles[:, k]].astype(numpy.float64) for k in range(3))
    area = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum()
    t = triangles.astype(numpy.int64)
    directed = numpy.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    forward = directed[:, 0] << 32 | directed[:, 1]
    backward = directed[:, 1] << 32 | directed[:, 0]
    alone = ~numpy.isin(forward, backward)
    ends = points[directed[alone]]
    extent = size[::-1] - 1
    outer = numpy.zeros(len(ends), bool)
    for axis in range(3):
        p, q = ends[:, 0, axis], ends[:, 1, axis]
        outer |= (abs(p - q) < 1e-3) & ((abs(p) < 1e-3) | (abs(p - extent[axis]) < 1e-3))
    edges = len(numpy.unique(numpy.minimum(forward, backward)))
    euler = len(numpy.unique(triangles)) - edges + len(triangles)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"stage=skimage median={times[len(times) // 2]:.6f} least={times[0]:.6f} most={times[-1]:.6f} runs={runs} "
          f"processor={processor:.3f} peak_mb={peak:.1f} vertices={len(points)} triangles={len(triangles)} "
          f"area={area:.6f} open={int((~outer).sum())} euler={euler} version={skimage.__version__}")


main()
