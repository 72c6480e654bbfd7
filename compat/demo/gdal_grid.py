"""gdal_grid interpolates heights at scattered points to a raster, linearly in Delaunay triangles.

Prints the values of the raster, one a line after a zero.

gdal_grid.py POINTS SIDE: the raster has SIDE rows of SIDE values
"""

import array
import math
import pathlib
import random
import subprocess
import sys

n_points, side = map(int, sys.argv[1:])
numbers = random.Random(1)
folder = pathlib.Path("gdal")
folder.mkdir(exist_ok=True)
table, raster = folder / "points.csv", folder / "raster.bin"
with table.open("w", encoding="ascii") as file:
    file.write("x,y,z\n")
    for _ in range(n_points):
        x, y = numbers.random(), numbers.random()
        file.write(f"{x!r},{y!r},{math.sin(5 * x) * y!r}\n")
source = folder / "points.vrt"
source.write_text(f"""<OGRVRTDataSource><OGRVRTLayer name="points"><SrcDataSource>{table}</SrcDataSource>
<GeometryType>wkbPoint</GeometryType><GeometryField encoding="PointFromColumns" x="x" y="y" z="z"/>
</OGRVRTLayer></OGRVRTDataSource>""", encoding="ascii")
subprocess.run(
    ["gdal_grid", "-q", "-l", "points", "-a", "linear:radius=0", "-txe", "0.1", "0.9", "-tye", "0.1", "0.9", "-outsize",
     str(side), str(side), "-of", "ENVI", "-ot", "Float64", source, raster], check=True)
values = array.array("d", raster.read_bytes())
assert len(values) == side * side
for value in values:
    print(0, repr(value))
