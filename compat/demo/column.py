"""A column of water collapses, in OpenSeesPy's particle finite elements in space, on a floor that holds it.

Prints at every step the number of elements and the height of the column.

column.py STEPS
"""

import sys

import openseespy.opensees as ops

WIDTH, HEIGHT = 0.1, 0.2
SIZE = 0.02
ALPHA = 1.5
DENSITY, VISCOSITY, GRAVITY = 1000.0, 1e-3, -9.81
TIME_STEP, LEAST_STEP = 1e-3, 1e-6
FLOOR_MESH, WATER_MESH = 101, 200
FLOOR_ID, WATER_ID = 1, -1

# Corners: four below, four above them. Faces as edges of these, in which each edge has one mesh.
EDGES = {(1, 2): 1, (2, 3): 2, (3, 4): 3, (1, 4): 4, (5, 6): 5, (6, 7): 6, (7, 8): 7, (5, 8): 8,
         (1, 5): 9, (2, 6): 10, (3, 7): 11, (4, 8): 12}
FACES = {101: [1, 2, 3, 4], 102: [5, 6, 7, 8], 103: [1, 10, 5, 9], 104: [2, 11, 6, 10], 105: [3, 12, 7, 11],
         106: [4, 12, 8, 9]}


def build():
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 3)
    square = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, WIDTH), (0.0, WIDTH)]
    for level, z in enumerate((0.0, HEIGHT)):
        for i, (x, y) in enumerate(square):
            ops.node(4 * level + i + 1, x, y, z)
    for ends, tag in EDGES.items():
        ops.mesh("line", tag, 2, *ends, FLOOR_ID if tag <= 4 else WATER_ID, 3, SIZE)
    for tag, lines in FACES.items():
        ops.mesh("tri", tag, len(lines), *lines, FLOOR_ID if tag == FLOOR_MESH else WATER_ID, 3, SIZE)
    element = ["PFEMElementBubble", DENSITY, VISCOSITY, 0.0, 0.0, GRAVITY, -1.0]
    ops.mesh("tet", WATER_MESH, len(FACES), *FACES, WATER_ID, 3, SIZE, *element)
    for node in ops.getNodeTags("-mesh", FLOOR_MESH):
        ops.fix(node, 1, 1, 1)


def choose_analysis():
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.test("PFEM", 1e-5, 1e-5, 1e-5, 1e-5, 1e-15, 1e-15, 20, 3, 1, 2)
    ops.algorithm("Newton")
    ops.integrator("PFEM")
    ops.system("PFEM")
    ops.analysis("PFEM", TIME_STEP, LEAST_STEP, GRAVITY)


def main(n_steps):
    build()
    choose_analysis()
    nodes = ops.getNodeTags("-mesh", WATER_MESH)
    print("nodes", len(nodes))
    for step in range(1, n_steps + 1):
        if ops.analyze() < 0:
            sys.exit(f"step {step} did not converge")
        ops.remesh(ALPHA)
        height = max(ops.nodeCoord(node)[2] + ops.nodeDisp(node)[2] for node in nodes)
        print(step, len(ops.getEleTags("-mesh", WATER_MESH)), repr(height))


main(int(sys.argv[1]))
