"""Opens files with the reader of ParaView (`pip install vtk`): python tests/paraview.py [FOLDER]

By default those that `cargo test --all-features --test running paraview` leaves behind.
"""

import math
import pathlib
import sys
import xml.etree.ElementTree as tree

import vtk

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "target/tmp/paraview")
lists = sorted(folder.glob("*.pvd"))
assert lists, f"no .pvd in {folder}"
for path in lists:
    files = tree.parse(path).getroot().iter("DataSet")
    times = []
    for entry in files:
        times.append(float(entry.get("timestep")))
        reader = vtk.vtkXMLUnstructuredGridReader()
        failed = []
        reader.AddObserver("ErrorEvent", lambda *_: failed.append(True))
        reader.SetFileName(str(folder / entry.get("file")))
        reader.Update()
        grid = reader.GetOutput()
        assert not failed and grid.GetNumberOfCells() > 0, entry.get("file")
        for data, count in (
            (grid.GetPointData(), grid.GetNumberOfPoints()),
            (grid.GetCellData(), grid.GetNumberOfCells()),
        ):
            for index in range(data.GetNumberOfArrays()):
                assert data.GetArray(index).GetNumberOfTuples() == count
        moved, now = grid.GetPointData().GetArray("displacement"), grid.GetPoints()
        for point in range(grid.GetNumberOfPoints()):
            assert all(map(math.isfinite, moved.GetTuple(point) + now.GetPoint(point)))
        # The cells have a size, so that their nodes are in the order of the format.
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputData(grid)
        sizes.Update()
        cells = sizes.GetOutput().GetCellData()
        for cell in range(grid.GetNumberOfCells()):
            if grid.GetCellType(cell) == vtk.VTK_VERTEX:
                continue
            size = [cells.GetArray(name).GetValue(cell) for name in ("Length", "Area", "Volume")]
            assert max(size) > 0 and min(size) >= 0, (entry.get("file"), cell, size)
    assert times == sorted(times)
    names = [data.GetArray(i).GetName() for i in range(data.GetNumberOfArrays())]
    print(f"{path.name}: {len(times)} times, {grid.GetNumberOfCells()} cells, {', '.join(names)}")
