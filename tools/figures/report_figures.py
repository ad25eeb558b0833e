#!/usr/bin/env python3
"""Draws the figures of a validation report from its report.h5, and from nothing else.

Usage: report_figures.py report.h5 DIRECTORY

Writes NAME.svg and NAME.png for each figure that the data can fill, and index.json with titles and captions. The same
report.h5 gives the same bytes. A figure that fails is named under "problems" in the index and the others are drawn.
Change this script freely: it reads the layout that reports/datasets.hpp describes.
"""

import json
import math
import pathlib
import sys
import traceback

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
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


def draw_curves(axes, curves, x, y):
    """One line a method; returns all x and y drawn. Exact zeros, which have no place on log axes, stand at ZERO."""
    xs, ys = [], []
    for curve in curves:
        abscissa, ordinate = curve[x][()], curve[y][()]
        ordinate = np.where(ordinate == 0, ZERO, ordinate)
        good = np.isfinite(abscissa) & np.isfinite(ordinate) & (abscissa > 0) & (ordinate > 0)
        if not good.any():
            continue
        order = np.argsort(abscissa[good], kind="stable")
        axes.plot(abscissa[good][order], ordinate[good][order], label=curve.attrs["method"],
                  **look_of(curve.attrs["method"]))
        xs.extend(abscissa[good])
        ys.extend(ordinate[good])
    return xs, ys


def truth_floor(axes, curves, ys):
    """The truth's own error as a line, where it comes near the data."""
    errors = [value for curve in curves for value in curve["truth_error"][()] if value > 0 and math.isfinite(value)]
    if errors and ys and max(errors) > 1e-3 * min(ys):
        axes.axhline(max(errors), color=GREY, linewidth=1.0, linestyle=":")
        axes.annotate("error of the truth", (0.99, max(errors)), xycoords=("axes fraction", "data"), ha="right",
                      va="bottom", fontsize=8, color=GREY)


def sweep_figure(report, control, x, y, x_label, y_label, decorate=None):
    panels = report.panels(control)
    if not panels:
        return None
    figure, strip, all_axes = grid_of_panels(len(panels))
    drawn = False
    several_quantities = len({quantity for quantity, _, _ in panels}) > 1
    for axes, ((quantity, metric, chart), curves) in zip(all_axes, panels.items()):
        log_log(axes)
        xs, ys = draw_curves(axes, curves, x, y)
        title = f"{metric}, {chart}" + (f"\n{quantity}" if several_quantities else "")
        axes.set_title(title)
        axes.set_xlabel(x_label)
        unit = curves[0][y].attrs["units"]
        axes.set_ylabel((y_label or f"rms error of {quantity}") + unit_suffix(unit))
        if not xs:
            axes.annotate("nothing above zero to draw", (0.5, 0.5), xycoords="axes fraction", ha="center", color=GREY)
            continue
        drawn = True
        axes.set_xlim(*tight_decades(xs))
        axes.set_ylim(*tight_decades(ys))
        if decorate:
            decorate(axes, curves, xs, ys)
    if not drawn:
        plt.close(figure)
        return None
    shared_legend(strip, all_axes)
    return figure


def line_of_slope_one(axes, curves, xs, ys):
    """Error proportional to tolerance, above the data."""
    truth_floor(axes, curves, ys)
    x = np.array([min(xs), max(xs)])
    scale = 6.0 * max(value / tolerance for tolerance, value in zip(xs, ys) if tolerance > 30 * min(xs) or len(xs) < 4)
    axes.plot(x, scale * x, color=GREY, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    axes.annotate("error ∝ tolerance", (x[1], scale * x[1]), xytext=(-8, 0), textcoords="offset points", fontsize=8.5,
                  color="#5d646d", ha="right", va="center")
    axes.set_ylim(*tight_decades(ys, high=scale * x[1]))


def order_guides(axes, curves, xs, ys):
    """Beside each curve a short dashed line of the whole order that is nearest to what the curve shows."""
    truth_floor(axes, curves, ys)
    for curve in curves:
        kinds = text(curve["convergence"])
        observed, step, error = (curve[name][()] for name in ("observed_order", "setting", "error_norm"))
        clean = [k for k in range(1, len(step)) if kinds[k] == "monotone" and math.isfinite(observed[k])]
        if not clean:
            continue
        order = round(float(np.median(observed[clean])))
        first = np.argmax(step[clean])
        start = clean[first] - 1
        x = step[start] / np.array([1.0, 3.0])
        y = 5.0 * error[start] * np.array([1.0, 3.0**-order])
        axes.plot(x, y, color=look_of(curve.attrs["method"])["color"], linewidth=1.0, linestyle=(0, (3, 2)), zorder=2)
        axes.annotate(f"order {order}", (x[1], y[1]), xytext=(-3, 2), textcoords="offset points", fontsize=8.5,
                      ha="right", va="center", color=look_of(curve.attrs["method"])["color"])
        ys.append(y[0])
    axes.set_ylim(*tight_decades(ys))


def work_precision(report):
    figure = sweep_figure(report, None, "evaluations_per_ray", "error_norm", "evaluations per ray", None,
                          lambda axes, curves, xs, ys: truth_floor(axes, curves, ys))
    return figure, "Work and precision", (
        "Root mean square error over a bundle of rays against the evaluations of the right-hand side that it cost. Lower "
        "and further left is better; a curve that turns flat has reached round-off.")


def convergence(report):
    figure = sweep_figure(report, "step", "setting", "error_norm", "step in affine parameter", None,
                          order_guides)
    return figure, "Convergence with the step", (
        "Error against step size for the fixed-step methods. Dashed beside each curve: the whole order nearest to "
        "its observed one.")


def tolerance_proportionality(report):
    figure = sweep_figure(report, "tolerance", "setting", "error_norm", "tolerance asked for", None,
                          line_of_slope_one)
    return figure, "Error against tolerance", (
        "Tolerance is not error: what the adaptive methods reached against what they were asked for. A method that keeps "
        "its promise runs parallel to the dashed line.")


def null_drift(report):
    figure = sweep_figure(report, None, "evaluations_per_ray", "null_drift_max", "evaluations per ray",
                          "largest null residual")
    return figure, "Drift off the light cone", (
        "Largest null residual along any ray of the bundle. Open markers and dashed lines: with constraint projection. "
        "Exact zeros stand at 1e-17.")


def error_over_tolerance(report):
    rows = {}
    for case in report.cases:
        error, tolerance = case["error"][()], case["tolerance"][()]
        for e, t, verdict in zip(error, tolerance, names_of(case["verdict"])):
            if math.isfinite(e) and math.isfinite(t) and t > 0 and verdict in VERDICT_COLOURS:
                rows.setdefault(family_of(case), []).append((e / t, verdict))
    if not rows:
        return None, "", ""
    ratios = [ratio for family in rows.values() for ratio, _ in family]
    floor = max(min([ratio for ratio in ratios if ratio > 0], default=1e-3), 1e-9)
    families = list(rows)
    figure, axes = plt.subplots(figsize=(7.6, 1.5 + 0.52 * len(families)))
    axes.set_xscale("log")
    left, right = tight_decades([max(ratio, floor) for ratio in ratios], high=2.0)
    axes.axvspan(left, 1.0, color="#eaf3ee", zorder=0, linewidth=0)
    axes.axvline(1.0, color=BLACK, linewidth=1.2)
    generator = np.random.default_rng(1)  # spreads the points so that they do not hide one another
    for position, family in enumerate(families):
        values = np.array([max(ratio, floor) for ratio, _ in rows[family]])
        spread = generator.uniform(-0.26, 0.26, len(values)) if len(values) > 4 else np.zeros(len(values))
        for verdict, colour in VERDICT_COLOURS.items():
            chosen = np.array([seen == verdict for _, seen in rows[family]])
            axes.scatter(values[chosen], position + spread[chosen], s=16 if verdict == "pass" else 34, color=colour,
                         alpha=0.55 if verdict == "pass" else 0.95, linewidths=0, zorder=3 if verdict == "pass" else 4,
                         marker={"pass": "o", "fail": "X", "inconclusive": "D"}[verdict])
        axes.plot([np.median(values)] * 2, [position - 0.36, position + 0.36], color=BLACK, linewidth=2.2, zorder=5)
    axes.set_yticks(range(len(families)), [f"{family}  ({len(rows[family])})" for family in families])
    axes.set_ylim(len(families) - 0.4, -0.6)
    axes.set_xlim(left, right)
    axes.grid(axis="y", visible=False)
    decades(axes.xaxis)
    axes.set_xlabel("error / tolerance")
    axes.annotate("pass", (1.0, 1.0), xycoords=("data", "axes fraction"), xytext=(-6, 3), textcoords="offset points",
                  ha="right", va="bottom", fontsize=9, color="#3d6b52")
    axes.annotate("fail", (1.0, 1.0), xycoords=("data", "axes fraction"), xytext=(6, 3), textcoords="offset points",
                  ha="left", va="bottom", fontsize=9, color=VERMILION)
    caption = ("Every graded row, by family, with the number of rows; black bars are medians. "
               "Rows whose error is exactly zero stand at the left edge. Crosses failed, diamonds are inconclusive.")
    return figure, "Error over tolerance", caption


def runs_of(case, good):
    """Masks of the rows of each (method, setting), keyed by it; where there are many, the tightest of each method."""
    methods, settings = text(case["method"]), case["setting"][()]
    runs = {}
    for k in np.flatnonzero(good):
        setting = float(settings[k]) if math.isfinite(settings[k]) else 0.0
        runs.setdefault((methods[k], setting), np.zeros(len(good), dtype=bool))[k] = True
    if len(runs) > 4:
        tightest = {method: min(setting for known, setting in runs if known == method) for method, _ in runs}
        runs = {run: mask for run, mask in runs.items() if run[1] == tightest[run[0]]}
    return dict(sorted(runs.items(), key=lambda item: (method_rank(item[0][0]), -item[0][1])))


def worst_at(x, y):
    """The largest y at each x, in the order of x."""
    places = np.unique(x)
    return places, np.array([y[x == place].max() for place in places])


def deflection_figure(case, excess, critical, limits):
    """Deflection against the distance from the critical impact parameter, and its errors below."""
    value, reference, error, tolerance = (case[name][()] for name in ("value", "reference", "error", "tolerance"))
    good = np.isfinite(excess) & (excess > 0) & np.isfinite(value) & np.isfinite(error)
    if not good.any():
        return None
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 6.8), sharex=True, height_ratios=(1, 1))
    log_log(above)
    log_log(below)
    for label, dashes, x, y in limits(excess[good].min(), excess[good].max()):
        above.plot(x, y, color=GREY, linewidth=1.1, linestyle=dashes, label=label, zorder=1)
    above.plot(*worst_at(excess[good], reference[good]), color=BLACK, linewidth=1.2, label="exact", zorder=2)
    above.plot(*worst_at(excess[good], value[good]), linestyle="none", marker="o", color=BLUE, label="traced", zorder=3)
    runs = runs_of(case, good)
    for (method, setting), mask in runs.items():
        look = look_of(method)
        shade = 1.0 if setting == min(other for known, other in runs if known == method) else 0.6
        name = method + (f" at {setting:.0e}".replace("e-0", "e-") if setting > 0 else "")
        below.plot(*worst_at(excess[mask], np.maximum(error[mask], ROUND_OFF)), label=name or "no stepping",
                   alpha=shade, zorder=3, **look)
        below.plot(*worst_at(excess[mask], tolerance[mask]), color=look["color"], linewidth=1.0,
                   linestyle=(0, (1, 1.5)), zorder=2)
    units = unit_suffix(case["value"].attrs["units"])
    above.set_ylabel("deflection α" + units)
    below.set_ylabel("largest error of α" + units)
    below.set_xlabel(f"$b/b_c-1$,   {critical}")
    seen = np.concatenate([np.maximum(error[good], ROUND_OFF), tolerance[good]])
    below.set_ylim(*tight_decades(seen))
    above.legend()
    below.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


DEFLECTION_CAPTION = ("Above: deflection against impact parameter, traced and exact, with its limits. Below: the largest "
                      "difference over charts for each method and setting, and as dotted lines in the same colour the "
                      "tolerances that it is held to. Differences below round-off stand at 1.1e-16.")


def schwarzschild_deflection(report):
    case = report.case("schwarzschild/deflection")
    ratio = None if case is None else parameter(case, "b_over_b_c")
    b = None if case is None else parameter(case, "b")
    if ratio is None and b is None:
        return None, "", ""
    excess = ratio - 1 if ratio is not None else b / math.sqrt(27) - 1

    def limits(nearest, furthest):
        far = np.geomspace(0.5, max(furthest, 1.0), 60)
        yield "4M/b", (0, (5, 3)), far, 4 / (math.sqrt(27) * (1 + far))
        if nearest < 0.1:
            near = np.geomspace(nearest, 0.3, 60)
            constant = math.log(216 * (7 - 4 * math.sqrt(3))) - math.pi
            yield "strong-field logarithm", (0, (1, 1.5)), near, constant - np.log(near)

    figure = deflection_figure(case, excess, "$b_c=\\sqrt{27}\\,M$", limits)
    return figure, "Deflection by a Schwarzschild hole", DEFLECTION_CAPTION


def ellis_deflection(report):
    case = report.case("ellis/deflection")
    ratio = None if case is None else parameter(case, "b")
    if ratio is None:
        return None, "", ""

    def limits(nearest, furthest):
        far = np.geomspace(max(nearest, 0.3), max(furthest, 1.0), 60)
        yield "$(\\pi/4)\\,(b_0/b)^2$", (0, (5, 3)), far, math.pi / 4 / (1 + far) ** 2

    figure = deflection_figure(case, ratio - 1, "$b_c=b_0$, the throat", limits)
    return figure, "Deflection by an Ellis wormhole", DEFLECTION_CAPTION


def bardeen_edge(spin, inclination):
    """Edge of the shadow for a distant observer, in units of M: photon orbits of radius r, seen at (alpha, beta)."""
    if abs(spin) < 1e-9:
        angle = np.linspace(0, 2 * np.pi, 241)
        return math.sqrt(27) * np.cos(angle), math.sqrt(27) * np.sin(angle)
    prograde = 2 * (1 + math.cos(2 / 3 * math.acos(-min(spin, 1.0))))
    retrograde = 2 * (1 + math.cos(2 / 3 * math.acos(min(spin, 1.0))))
    # What is seen of the orbits lies between two of them. Dense towards both, where beta goes as a square root.
    for _ in range(2):
        r = prograde + (retrograde - prograde) * 0.5 * (1 - np.cos(np.linspace(1e-6, np.pi, 4000)))
        with np.errstate(all="ignore"):
            xi = (r**2 * (3 - r) - spin**2 * (r + 1)) / (spin * (r - 1))
            eta = r**3 * (4 * spin**2 - r * (r - 3) ** 2) / (spin**2 * (r - 1) ** 2)
            beta_squared = eta + (spin * np.cos(inclination)) ** 2 - (xi / np.tan(inclination)) ** 2
        seen = np.isfinite(beta_squared) & (beta_squared >= 0)
        prograde, retrograde = r[seen].min(), r[seen].max()
    alpha, beta = -xi[seen] / math.sin(inclination), np.sqrt(beta_squared[seen])
    return np.concatenate([alpha, alpha[::-1], alpha[:1]]), np.concatenate([beta, -beta[::-1], beta[:1]])


def shadow_edges(case):
    """Traced edge points of a shadow case as {spin: {inclination: (alpha, beta)}}, lengths in M, angles in radians.

    Rows give the screen coordinates alpha, beta (one may be the value), or the angle on the screen with the radius as
    the value."""
    spin, inclination = parameter(case, "a", "spin"), parameter(case, "inclination", "i")
    alpha, beta = parameter(case, "alpha"), parameter(case, "beta")
    angle = parameter(case, "angle", "screen_angle", "position_angle", "psi")
    value = case["value"][()]
    if spin is None or inclination is None:
        return {}
    if alpha is not None or beta is not None:
        points = np.array([value if alpha is None else alpha, value if beta is None else beta])
    elif angle is not None:
        points = np.array([value * np.cos(angle), value * np.sin(angle)])
    else:
        return {}
    edges = {}
    for k in range(len(value)):
        if np.isfinite(points[:, k]).all() and math.isfinite(inclination[k]) and math.isfinite(spin[k]):
            of_spin = edges.setdefault(float(spin[k]), {})
            of_spin.setdefault(float(inclination[k]), []).append(points[:, k])
    return edges


def kerr_shadow(report):
    case = report.case("kerr/shadow_edge")
    edges = {} if case is None else shadow_edges(case)
    if not edges:
        return None, "", ""
    figure, strip, panels = grid_of_panels(len(edges), width=4.6, height=4.4)
    inclinations = sorted({i for of_spin in edges.values() for i in of_spin})
    for axes, (spin, of_spin) in zip(panels, sorted(edges.items())):
        for inclination, points in sorted(of_spin.items()):
            colour = SERIES[inclinations.index(inclination) % len(SERIES)]
            axes.plot(*bardeen_edge(spin, inclination), color=colour, linewidth=1.2, alpha=0.8, zorder=2)
            axes.plot(*np.array(points).T, linestyle="none", marker="o", markersize=4.5, color=colour,
                      label=f"i = {math.degrees(inclination):.4g}°", zorder=3)
        axes.set_title(f"a = {spin:g} M")
        axes.set_aspect("equal")
        axes.set_xlabel("α / M")
        axes.set_ylabel("β / M")
    entries = {label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels())}
    strip.legend(entries.values(), entries.keys(), loc="center", ncol=min(len(entries), 6), borderaxespad=0.0)
    return figure, "Edge of the Kerr shadow", (
        "Edge found on traced rays (dots) and Bardeen's curve (lines), on the screen of a distant observer, for several "
        "inclinations i. Differences are far below the width of a line: see the rows of kerr/shadow_edge.")


def kerr_critical(report):
    names = ("kerr/critical_impact", "kerr/critical_impact_parameters", "kerr/critical_parameters", "kerr/photon_orbits")
    case = next((one for one in map(report.case, names) if one is not None and parameter(one, "a", "spin") is not None),
                None)
    if case is None:
        return None, "", ""
    spin, labels = parameter(case, "a", "spin"), text(case["label"])
    value, reference, error, tolerance = (case[name][()] for name in ("value", "reference", "error", "tolerance"))
    good = np.isfinite(spin) & np.isfinite(value) & np.isfinite(error)
    if not good.any():
        return None, "", ""
    spins = sorted(set(spin[good]))
    place = np.array([spins.index(a) if a in spins else -1 for a in spin], dtype=float)
    backward = np.array(["retro" in label for label in labels]) | (reference < 0)
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 5.8), sharex=True, height_ratios=(3, 2))
    below.set_yscale("log")
    for name, colour, marker, shift, chosen in (("prograde", BLUE, "o", -0.08, good & ~backward),
                                                ("retrograde", VERMILION, "s", 0.08, good & backward)):
        if not chosen.any():
            continue
        x = place[chosen] + shift
        above.plot(x, np.abs(reference[chosen]), marker="_", markersize=17, color=BLACK, linestyle="none", zorder=2)
        above.plot(x, np.abs(value[chosen]), marker=marker, color=colour, linestyle="none", label=name, zorder=3)
        below.plot(x, np.maximum(error[chosen], ROUND_OFF), marker=marker, color=colour, linestyle="none", zorder=3)
        below.plot(x, tolerance[chosen], marker="_", markersize=17, color=BLACK, linestyle="none", zorder=2)
    units = case["value"].attrs["units"]
    above.set_ylabel("critical impact parameter" + (unit_suffix(units) or " / M"))
    below.set_ylabel("error")
    below.set_xlabel("spin a / M")
    below.set_xticks(range(len(spins)), [f"{a:g}" for a in spins])
    below.set_xlim(-0.5, len(spins) - 0.5)
    below.set_ylim(*tight_decades(np.maximum(error[good], ROUND_OFF), high=max(tolerance[good])))
    decades(below.yaxis)
    above.legend()
    return figure, "Critical rays of a Kerr hole", (
        "Measured (markers) and exact (bars) at each spin, magnitudes; below, the errors with their tolerances (bars).")


FIGURES = {
    "error-over-tolerance": error_over_tolerance,
    "schwarzschild-deflection": schwarzschild_deflection,
    "ellis-deflection": ellis_deflection,
    "kerr-shadow-edge": kerr_shadow,
    "kerr-critical": kerr_critical,
    "work-precision": work_precision,
    "convergence": convergence,
    "tolerance": tolerance_proportionality,
    "null-drift": null_drift,
}


def save(figure, directory, name):
    figure.savefig(directory / f"{name}.svg", metadata={"Date": None, "Creator": None})
    figure.savefig(directory / f"{name}.png", metadata={"Software": None})
    plt.close(figure)


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    directory = pathlib.Path(arguments[1])
    directory.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE)
    index = {"figures": [], "problems": []}
    with h5py.File(arguments[0], "r") as file:
        report = Report(file)
        for name, draw in FIGURES.items():
            try:
                figure, title, caption = draw(report)
                if figure is not None:
                    save(figure, directory, name)
                    index["figures"].append({"name": name, "title": title, "caption": caption})
            except OSError:
                raise  # a full disk is not a matter of one figure
            except Exception as error:  # one figure that fails must not take the others with it
                traceback.print_exc()
                index["problems"].append(f"{name}: {type(error).__name__}: {error}")
    (directory / "index.json").write_text(json.dumps(index, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
