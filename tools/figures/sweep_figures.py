"""Figures of sweeps, and the one of all graded rows: error against work, step, tolerance."""

import math

import matplotlib.pyplot as plt
import numpy as np

from figure_kit import (BLACK, GREY, VERDICT_COLOURS, VERMILION, ZERO, decades, family_of, grid_of_panels, log_log,
                        look_of, names_of, shared_legend, text, tight_decades, unit_suffix)


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
