"""Which atoms of a molecule a probe cannot touch: balls that lie within others, told by weights, while the molecule moves.

An atom is a ball of its radius and that of the probe, and its weight is the square of the sum. Where an atom is hidden by
weight, each place in its ball is at less power distance from another atom, so that the others cover it. One triangulation
serves all probes and all times: weights and positions change, and the simplices follow.
"""

import sys

import numpy as np

import deldrift

RADII = np.array([1.70, 1.55, 1.52, 1.20])
"""Those of carbon, nitrogen, oxygen and hydrogen, in angstrom."""


def globule(rng, count):
    """Atoms of a molecule that has been folded at random: their places, and their radii."""
    steps = rng.standard_normal((count, 3))
    places = np.cumsum(1.5 * steps / np.linalg.norm(steps, axis=1)[:, None], axis=0)
    return 0.5 * (places - places.mean(axis=0)), rng.choice(RADII, count)


def buried(tri):
    """The atoms that the others cover, with those at the place of a larger one."""
    return np.union1d(tri.hidden_by_weight.vertices, tri.coplanar[:, 0])


def main(count=2000, n_steps=10, seed=1):
    rng = np.random.default_rng(seed)
    places, radii = globule(rng, count)
    tri = deldrift.Regular(places, radii**2)
    print(f"{count} atoms, {len(buried(tri))} of them within others")
    for probe in 0.5, 1.0, 1.4:
        report = tri.move(weights=(radii + probe) ** 2)
        told = f"{report.newly_hidden} more and {report.newly_shown} fewer"
        print(f"a probe of {probe} angstrom: {len(buried(tri))} are out of reach, {told}")
    for _ in range(n_steps):
        places += 0.02 * rng.standard_normal(places.shape)
        tri.move(places)
    print(f"after {n_steps} steps: {len(buried(tri))} are out of reach")
    return tri


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
