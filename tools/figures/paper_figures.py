"""Draws the figures of paper reproductions, each from its panels and series.

    paper_figures.py <paper.h5> <directory>

Writes <paper id>.svg, <paper id>.png and index.json.
"""

import sys

import h5py

from figure_kit import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, plt, ready, save, write_index

LINES = (BLUE, GREEN, PURPLE, ORANGE, SKY, BLACK)
APPROXIMATIONS = (ORANGE, PURPLE, GREEN, SKY)


def label_of(series):
    return series.attrs["name"] or None


def draw_series(axes, series, colours):
    """One series as its look says; colours run on for each kind of look."""
    look = series.attrs["look"]
    x, y = series["x"][()], series["y"][()]
    label = label_of(series)
    if look == "line":
        axes.plot(x, y, color=next(colours["line"]), label=label)
    elif look == "dashed":
        axes.plot(x, y, color=next(colours["dashed"]), linestyle="--", linewidth=1.3, label=label)
    elif look == "dotted":
        axes.plot(x, y, color=GREY, linestyle=":", linewidth=1.2, label=label)
    elif look == "dots":
        axes.plot(x, y, "o", color=BLACK, markersize=4.2, markerfacecolor="white", markeredgewidth=1.1, label=label,
                  zorder=3)
    elif look == "printed":
        axes.plot(x, y, "x", color=VERMILION, markersize=7, markeredgewidth=1.6, label=label, zorder=4)
    elif look == "area":
        axes.fill(x, y, color=next(colours["area"]), linewidth=0, label=label, zorder=1)
    else:
        raise ValueError(f"{series.name}: unknown look {look}")


def cycle(values):
    while True:
        yield from values


def draw_panel(axes, panel):
    colours = {"line": cycle(LINES), "dashed": cycle(APPROXIMATIONS), "area": cycle(("#1b1e23", "#d9dde3"))}
    members = [panel[name] for name in sorted(panel)]
    for series in members:
        draw_series(axes, series, colours)
    axes.set(title=panel.attrs["title"], xlabel=panel.attrs["x_label"], ylabel=panel.attrs["y_label"])
    if panel.attrs["x_log"]:
        axes.set_xscale("log")
    if panel.attrs["y_log"]:
        axes.set_yscale("log")
    if panel.attrs["equal"]:
        axes.set_aspect("equal")
    if any(label_of(series) for series in members):
        # A picture of space has no free corner: its legend stands below.
        axes.legend(**({"loc": "upper center", "bbox_to_anchor": (0.5, 0), "borderaxespad": 4.2, "ncol": 2} if panel.attrs["equal"] else {}))


def draw(group):
    panels = [group[name] for name in sorted(group)]
    figure, axes = plt.subplots(1, len(panels), figsize=(5.6 * len(panels), 4.6), squeeze=False)
    for place, panel in zip(axes[0], panels):
        draw_panel(place, panel)
    figure.suptitle(group.attrs["title"], fontsize=11)
    return figure


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    directory = ready(arguments[1])
    index = {"figures": [], "problems": []}
    with h5py.File(arguments[0], "r") as file:
        for name, group in file["figures"].items():
            save(draw(group), directory, name)
            index["figures"].append({"name": name, "title": str(group.attrs["title"]),
                                     "caption": str(group.attrs["caption"])})
    write_index(directory, index)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
