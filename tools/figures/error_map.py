"""Draws the figure of an error map: error, condition and cost over the screen, and the errors by class of ray.

    error_map.py <map.h5> <directory>

Writes error-map.svg, error-map.png and index.json.
"""

import sys

import h5py
import numpy as np
from matplotlib.colors import LogNorm

from figure_kit import BLUE, GREEN, GREY, VERMILION, names_of, plt, ready, save, write_index

CLASSES = {"escaped": BLUE, "captured": GREEN, "near_critical": VERMILION}
NAMES = {"escaped": "escaped", "captured": "captured", "near_critical": "near-critical"}


def positive(values):
    """Values on a logarithmic scale: zeros at the least positive one."""
    known = values[np.isfinite(values) & (values > 0)]
    least = known.min() if known.size else 1e-17
    return np.where(np.isfinite(values), np.maximum(values, least), np.nan)


def screen(axes, figure, image, extent, title, label, cmap, logarithmic=True):
    kind = {}
    if logarithmic:
        known = image[np.isfinite(image)]
        kind["norm"] = LogNorm(np.percentile(known, 0.5), np.percentile(known, 99.8)) if known.size else LogNorm()
    axes.grid(False)
    axes.set_facecolor("#c9ced6")
    shown = axes.imshow(image, origin="lower", extent=extent, cmap=cmap, interpolation="nearest", **kind)
    axes.set(title=title, xlabel=r"$\alpha$ [unit of M]", ylabel=r"$\beta$ [unit of M]")
    figure.colorbar(shown, ax=axes, label=label, shrink=0.86)


def draw(file):
    table = file["map"]
    shape = (int(table.attrs["rows"]), int(table.attrs["columns"]))
    column = {name: table[name][()].astype(float).reshape(shape) for name in
              ("alpha", "beta", "direction_error", "condition", "evaluations", "status_agrees")}
    kinds = np.array(names_of(table["class"])).reshape(shape)
    half = [(column[c].max() + (column[c].max() - column[c].min()) / (2 * max(1, n - 1)))
            for c, n in (("alpha", shape[1]), ("beta", shape[0]))]
    extent = (-half[0], half[0], -half[1], half[1])

    figure, axes = plt.subplots(2, 2, figsize=(11.5, 9.2))
    error = positive(column["direction_error"])
    screen(axes[0, 0], figure, error, extent, "Error of the final direction", "radian", "viridis")
    wrong = (column["status_agrees"] == 0) & (kinds != "no_light")
    if wrong.any():
        axes[0, 0].plot(column["alpha"][wrong], column["beta"][wrong], "x", color=VERMILION, label="wrong class")
        axes[0, 0].legend(loc="upper right")
    screen(axes[0, 1], figure, positive(column["condition"]), extent, "Condition: turn of the end for M on the screen",
           "radian", "magma")
    screen(axes[1, 0], figure, column["evaluations"], extent, "Cost", "evaluations of the flow", "cividis", False)

    below = axes[1, 1]
    numbers = []
    for name, colour in CLASSES.items():
        values = error[kinds == name]
        values = np.sort(values[np.isfinite(values)])
        if values.size == 0:
            continue
        below.plot(values, 1.0 - np.arange(values.size) / values.size, color=colour, label=NAMES[name])
        numbers.append(f"{NAMES[name]} {np.median(values):.1e} / {values[values.size * 99 // 100]:.1e} / {values[-1]:.1e}")
    below.set(xscale="log", yscale="log", xlabel="error of the final direction [radian]",
              ylabel="fraction of the rays with more", title="How many rays are off by how much")
    below.axhline(0.01, color=GREY, linewidth=0.8, linestyle=":")
    below.legend()
    figure.suptitle(file.attrs["title"], fontsize=11)
    caption = ("Angles between the directions of traced and exact ends; median / p99 / max: " + "; ".join(numbers) +
               ". Grey: no light, or nothing to compare.")
    return figure, caption


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    directory = ready(arguments[1])
    with h5py.File(arguments[0], "r") as file:
        figure, caption = draw(file)
        title = str(file.attrs["title"])
    save(figure, directory, "error-map")
    write_index(directory, {"figures": [{"name": "error-map", "title": title, "caption": caption}], "problems": []})
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
