"""Draws the frames of the dam break: draw.py FRAMES.json PICTURE.png"""

import json
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

source, target = sys.argv[1:3]
with open(source) as file:
    frames = json.load(file)
figure, axes = pyplot.subplots(len(frames) // 2, 2, figsize=(9, 2.1 * (len(frames) // 2)), layout="constrained")
for axis, frame in zip(axes.T.flat if len(frames) > 2 else axes, frames):
    x, y = zip(*frame["places"])
    drawn = axis.tripcolor(x, y, frame["elements"], frame["speed"], cmap="viridis", vmin=0, vmax=2.5, shading="gouraud")
    axis.triplot(x, y, frame["elements"], color="white", linewidth=0.15)
    axis.plot([x[i] for i in frame["walls"]], [y[i] for i in frame["walls"]], ".", color="0.6", markersize=1)
    axis.set_title(f"{frame['time']:.2f} s", fontsize=9)
    axis.set_aspect("equal")
    axis.set_xlim(-0.03, 0.615)
    axis.set_ylim(-0.03, 0.4)
    axis.set_axis_off()
figure.colorbar(drawn, ax=axes, label="speed, m/s", shrink=0.6)
figure.savefig(target, dpi=90, pil_kwargs={"optimize": True})
