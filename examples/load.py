#!/usr/bin/env python3
"""A patient's results in pandas, numpy, VTK and nibabel.

    python3 examples/load.py results/042

Debian: python3-pandas python3-vtk9 python3-nibabel (the last for `segment.nifti = true` only).
"""

import gzip
import json
import pathlib
import re
import sys

import numpy as np
import pandas as pd
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def lesion_table(folder):
    """One row a lesion and view; lesions.csv.md says what the columns mean."""
    return pd.read_csv(folder / "lesions.csv", dtype={"patient": str, "lesion": str, "clock": str})


def quality(folder, product):
    """Status, reasons and figures of a stage, from the sidecar beside its product."""
    sidecar = json.loads((folder / (product + ".json")).read_text())
    return sidecar["status"], sidecar["reasons"], sidecar["quality"]


def nrrd(path):
    """Values by z, y, x, and the voxels' spacing and origin [mm, LPS], of an NRRD file as written here."""
    header, _, data = path.read_bytes().partition(b"\n\n")
    lines = (line.split(": ", 1) for line in header.decode().splitlines() if ": " in line and line[0] != "#")
    keys = {key: value for key, value in lines if "=" not in key}
    types = {"unsigned char": "u1", "uint8": "u1", "float": "<f4"}
    sizes = [int(size) for size in keys["sizes"].split()]
    values = np.frombuffer(gzip.decompress(data), types[keys["type"]]).reshape(sizes[::-1])
    axes = re.findall(r"\(([^)]*)\)", keys["space directions"])
    spacing = np.linalg.norm([[float(x) for x in axis.split(",")] for axis in axes], axis=1)
    origin = np.array([float(x) for x in keys["space origin"].strip("()").split(",")])
    return values, spacing, origin


def mesh(path):
    """A mesh file's points [mm, LPS] and its fields by name."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetPointData()
    fields = {data.GetArrayName(n): vtk_to_numpy(data.GetArray(n))
              for n in range(data.GetNumberOfArrays()) if data.GetArray(n)}
    return vtk_to_numpy(grid.GetPoints().GetData()), fields


def main(folder):
    table = lesion_table(folder)
    views = table[table["view"] != "mri"]
    print(views[["lesion", "view", "behind_nipple_mm", "ellipse_major_mm", "ellipse_minor_mm"]].to_string(index=False))

    status, reasons, figures = quality(folder, "cc.vtu")
    print(f"\nCC: {status} {reasons}, {figures['force_N']:.0f} N at {figures['thickness_mm']:.1f} mm")

    labels, spacing, origin = nrrd(folder / "segmentation.seg.nrrd")
    millilitres = spacing.prod() / 1000
    for value in np.unique(labels)[1:]:
        print(f"label {value}: {np.count_nonzero(labels == value) * millilitres:.1f} ml")

    points, fields = mesh(folder / "cc.vtu")
    print(f"\ncc.vtu: {len(points)} points, {', '.join(sorted(fields))}")

    nifti = folder / "labels.nii.gz"
    if nifti.exists():
        import nibabel
        image = nibabel.load(nifti)
        print(f"labels.nii.gz: {image.shape}, affine (RAS)\n{image.affine}")
        assert np.array_equal(np.asarray(image.dataobj), labels.transpose(2, 1, 0))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
