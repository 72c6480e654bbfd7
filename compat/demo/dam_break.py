"""A dam breaks, in OpenSeesPy's particle finite elements: a column of water collapses into a dry tank.

Every step is an implicit solve and a new triangulation of all nodes, from which the elements within the water are
chosen by their circumradius (remesh). Prints a digest of every step, that of the bits of all displacements and
velocities and of all elements; two runs that print the same have computed the same.

dam_break.py STEPS [FRAMES.json]
"""

import array
import hashlib
import json
import sys

import openseespy.opensees as ops

WIDTH, HEIGHT = 0.146, 0.292  # of the water
TANK, RIM = 4 * WIDTH, 0.3
SIZE = 0.0075  # of the elements
WALL = 3 * SIZE
ALPHA = 1.4  # greatest circumradius, in units of the mean size
DENSITY, VISCOSITY, GRAVITY, THICKNESS = 1000.0, 1e-4, -9.81, 0.012
TIME_STEP, LEAST_STEP = 1e-3, 1e-6
WALL_MESH, WATER_MESH = 3, 4
WALL_ID, WATER_ID = 1, -1


def line(tag, nodes, identity):
    ops.mesh("line", tag, len(nodes), *nodes, identity, 2, SIZE)


def build():
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    corners = [
        (0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT), (0, RIM), (TANK, 0), (TANK, RIM),
        (-WALL, RIM), (-WALL, -WALL), (TANK + WALL, -WALL), (TANK + WALL, RIM),
    ]
    for tag, place in enumerate(corners, start=1):
        ops.node(tag, *map(float, place))
    line(1, [4, 5, 8, 9, 10, 11, 7, 6, 2], WALL_ID)
    line(2, [2, 1, 4], WALL_ID)
    line(5, [2, 3, 4], WATER_ID)
    ops.mesh("tri", WALL_MESH, 2, 1, 2, WALL_ID, 2, SIZE)
    element = ["PFEMElementBubble", DENSITY, VISCOSITY, 0.0, GRAVITY, THICKNESS, -1.0]
    ops.mesh("tri", WATER_MESH, 2, 2, 5, WATER_ID, 2, SIZE, *element)
    for node in ops.getNodeTags("-mesh", WALL_MESH):
        ops.fix(node, 1, 1)


def choose_analysis():
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.test("PFEM", 1e-5, 1e-5, 1e-5, 1e-5, 1e-15, 1e-15, 20, 3, 1, 2)
    ops.algorithm("Newton")
    ops.integrator("PFEM")
    ops.system("PFEM")
    ops.analysis("PFEM", TIME_STEP, LEAST_STEP, GRAVITY)


def moving_nodes():
    return sorted(set(ops.getNodeTags("-mesh", WALL_MESH)) | set(ops.getNodeTags("-mesh", WATER_MESH)))


def elements():
    return [ops.eleNodes(tag) for tag in ops.getEleTags("-mesh", WATER_MESH)]


def digest(nodes):
    numbers = array.array("d")
    for node in nodes:
        numbers.extend(ops.nodeDisp(node))
        numbers.extend(ops.nodeVel(node))
    corners = array.array("q")
    for element in elements():
        corners.extend(element)
    return hashlib.sha256(numbers.tobytes() + corners.tobytes()).hexdigest()[:16]


def frame(nodes):
    places = {node: [c + d for c, d in zip(ops.nodeCoord(node), ops.nodeDisp(node))] for node in nodes}
    speed = {node: sum(v * v for v in ops.nodeVel(node)[:2]) ** 0.5 for node in nodes}
    index = {node: i for i, node in enumerate(nodes)}
    return {
        "time": ops.getTime(),
        "places": [places[node] for node in nodes],
        "speed": [speed[node] for node in nodes],
        "elements": [[index[node] for node in element if node in index] for element in elements()],
        "walls": [index[node] for node in ops.getNodeTags("-mesh", WALL_MESH)],
    }


def main(n_steps, frames_file=None):
    build()
    choose_analysis()
    nodes = moving_nodes()
    print("nodes", len(nodes))
    frames = [frame(nodes)]
    for step in range(1, n_steps + 1):
        if ops.analyze() < 0:
            sys.exit(f"step {step} did not converge")
        ops.remesh(ALPHA)
        print(step, len(ops.getEleTags("-mesh", WATER_MESH)), digest(nodes))
        if step % (n_steps // 5) == 0:
            frames.append(frame(nodes))
    if frames_file:
        with open(frames_file, "w") as file:
            json.dump(frames, file)


main(int(sys.argv[1]), *sys.argv[2:3])
