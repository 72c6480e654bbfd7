"""Quantities of two tests of sectionproperties that depend on the mesh, on finer and finer ones.

Examples B.3 and 6.7 of Pilkey's Analysis and Design of Elastic Beams: the tests ask for the textbook's digits, on a
mesh on which the quantities have not converged.
"""

from sectionproperties.analysis import Section
from sectionproperties.pre import Geometry, Material
from shapely import Polygon


def solve(corners, poisson, size):
    geometry = Geometry(Polygon(corners), material=Material("a", 1, poisson, 1, 1, "w"))
    geometry.create_mesh(mesh_sizes=[size])
    section = Section(geometry)
    section.calculate_geometric_properties()
    section.calculate_warping_properties()
    return section


THIN = [(-0.375, -0.375), (5.625, -0.375), (5.625, 0.375), (0.375, 0.375), (0.375, 7.625), (-0.375, 7.625)]
EQUAL = [(0, 0), (10.5, 0), (10.5, 1), (1, 1), (1, 10.5), (0, 10.5)]

for divisor in (1, 4, 16, 64):
    thin, equal = solve(THIN, 0.33333, 0.05 / divisor), solve(EQUAL, 0.0, 0.1 / divisor)
    shear = equal.get_area() / equal.section_props.a_sxy
    print(f"area / {divisor}: B.3 {len(thin.elements)} elements, x_sc {thin.get_sc()[0]:.5f} (textbook 0.00313); "
          f"6.7 {len(equal.elements)} elements, a_xy {shear:.6f} (textbook 0.014969)")
