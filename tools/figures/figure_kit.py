"""What the figures share: reading a report.h5, looks of methods, axes and legends."""

import json
import math
import pathlib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

# Okabe and Ito's colours, which people with any of the usual colour blindnesses tell apart; markers tell them apart
# in black and white too. A method looks the same in every figure.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222")
GREY = "#8A8F98"
METHODS = {
    "euler": (GREY, "v"), "midpoint": (GREY, "s"), "heun2": (GREY, "^"), "rk4": (BLUE, "o"),
    "rkf45": (SKY, "D"), "dopri54": (VERMILION, "s"), "dop853": (GREEN, "^"),
    "verlet": (ORANGE, "v"), "implicit-midpoint": (ORANGE, "<"), "gl4": (PURPLE, "P"), "gl6": (PURPLE, "X"),
    "tao2": (SKY, "<"), "tao4": (SKY, ">"),
    "odeint:dopri5": (BLACK, "x"), "odeint:rkf78": (BLACK, "+"), "odeint:bulirsch-stoer": (BLACK, "1"),
}
SERIES = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
VERDICT_COLOURS = {"pass": BLUE, "fail": VERMILION, "inconclusive": ORANGE}
ROUND_OFF = 2.0**-53
ZERO = 1e-17  # where an exact zero is drawn on a logarithmic axis

STYLE = {
    "figure.dpi": 100, "savefig.dpi": 160, "figure.constrained_layout.use": True, "figure.facecolor": "white",
    "font.size": 10, "axes.titlesize": 10.5, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.labelsize": 10, "axes.edgecolor": "#555b63", "axes.linewidth": 0.8, "axes.spines.top": False,
    "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "grid.color": "#dfe3e8",
    "grid.linewidth": 0.7, "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.fontsize": 9, "legend.frameon": False,
    "lines.linewidth": 1.6, "lines.markersize": 5.5, "svg.hashsalt": "xprimeray", "svg.fonttype": "path",
}


def text(dataset):
    """Strings of a dataset as a list."""
    return [value.decode() if isinstance(value, bytes) else str(value) for value in dataset[()]]


def names_of(dataset):
    """An enum dataset as a list of its names."""
    names = {code: name for name, code in h5py.check_enum_dtype(dataset.dtype).items()}
    return [names[code] for code in dataset[()].tolist()]


def unit_suffix(unit):
    return "" if unit in ("1", "") else f" [{unit}]"


def groups_with(root, member):
    """All groups below `root` that hold a dataset of that name, by path."""
    found = []
    root.visititems(lambda path, item: found.append(item) if isinstance(item, h5py.Group) and member in item else None)
    return sorted(found, key=lambda group: group.name)


def family_of(case):
    return case.name.split("/")[2]


def parameter(case, *names):
    """The first parameter of a case that has one of these names, or None."""
    group = case.get("parameter", {})
    for name in names:
        for candidate in (name, name + "_over_M", name + "_over_b0"):
            if candidate in group:
                return group[candidate][()]
    return None


def look_of(method):
    """Colour, marker and line style: projected variants are dashed in the colour of their method."""
    base, _, projection = method.partition("+")
    colour, marker = METHODS.get(base, (SERIES[sum(map(ord, base)) % len(SERIES)], "d"))
    return {"color": colour, "marker": marker, "linestyle": "--" if projection else "-",
            "markerfacecolor": "white" if projection else colour, "markeredgecolor": colour}


def method_rank(method):
    base = method.partition("+")[0]
    known = list(METHODS)
    return (known.index(base) if base in known else len(known), method)


def decades(axis):
    """Powers of ten at readable distances, whatever the range."""
    axis.set_major_locator(LogLocator(base=10, numticks=8))
    axis.set_minor_formatter(NullFormatter())


def log_log(axes):
    axes.set_xscale("log")
    axes.set_yscale("log")
    decades(axes.xaxis)
    decades(axes.yaxis)


def tight_decades(values, low=None, high=None):
    """Limits that hold positive values with a little room."""
    values = [value for value in values if value > 0 and math.isfinite(value)]
    if not values:
        return None
    smallest, largest = min(values), max(values)
    if low is not None:
        smallest = min(smallest, low)
    if high is not None:
        largest = max(largest, high)
    room = 10 ** (0.06 * max(math.log10(largest / smallest), 1.0))
    return smallest / room, largest * room


def grid_of_panels(count, width=4.1, height=3.4):
    """A figure with `count` panels, and an empty strip above them that holds the legend of them all."""
    columns = min(count, 3)
    rows = math.ceil(count / columns)
    figure = plt.figure(figsize=(max(width * columns, 6.4), height * rows + 0.6))
    grid = figure.add_gridspec(rows + 1, columns, height_ratios=[0.5] + [height] * rows)
    strip = figure.add_subplot(grid[0, :])
    strip.axis("off")
    return figure, strip, [figure.add_subplot(grid[1 + k // columns, k % columns]) for k in range(count)]


def shared_legend(strip, panels):
    entries = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    labels = sorted(entries, key=method_rank)
    strip.legend([entries[label] for label in labels], labels, loc="center", ncol=min(len(labels), 6),
                 borderaxespad=0.0, columnspacing=1.6, handlelength=2.4)


class Report:
    """What the figures need of a report.h5."""

    def __init__(self, file):
        self.file = file
        self.cases = groups_with(file["cases"], "verdict") if "cases" in file else []
        self.curves = groups_with(file["sweeps"], "error_norm") if "sweeps" in file else []

    def case(self, identifier):
        return self.file.get(f"cases/{identifier}")

    def panels(self, control=None):
        """Sweep curves by (quantity, metric, chart), those with a certain control only."""
        panels = {}
        for curve in self.curves:
            attributes = curve.attrs
            if control in (None, attributes["control"]):
                key = (attributes["quantity"], attributes["metric"], attributes["chart"])
                panels.setdefault(key, []).append(curve)
        for curves in panels.values():
            curves.sort(key=lambda curve: method_rank(curve.attrs["method"]))
        return dict(sorted(panels.items()))


def ready(path):
    """The directory for figures, made if need be, with matplotlib set to look as figures here do."""
    directory = pathlib.Path(path)
    directory.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE)
    return directory


def save(figure, directory, name):
    """As SVG and PNG, without a date: equal figures are equal files."""
    figure.savefig(directory / f"{name}.svg", metadata={"Date": None, "Creator": None})
    figure.savefig(directory / f"{name}.png", metadata={"Software": None})
    plt.close(figure)


def write_index(directory, index):
    """What was drawn, for the report that shows it: {"figures": [{"name", "title", "caption"}], "problems": [...]}."""
    (directory / "index.json").write_text(json.dumps(index, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
