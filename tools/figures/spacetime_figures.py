"""Figures of single cases: what light does near a hole or a wormhole, traced and exact."""

import math

import matplotlib.pyplot as plt
import numpy as np

from figure_kit import (BLACK, BLUE, GREY, ROUND_OFF, SERIES, VERMILION, decades, grid_of_panels, log_log, look_of,
                        method_rank, parameter, text, tight_decades, unit_suffix)


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


def kerr_deflection(report):
    """Equatorial light on either side of a spinning hole: one curve for each spin and side."""
    case = report.case("kerr/deflection")
    ratio, spin, b = (None if case is None else parameter(case, name) for name in ("b_over_b_c", "a", "b"))
    if ratio is None or spin is None or b is None:
        return None, "", ""
    value, reference, error, tolerance = (case[name][()] for name in ("value", "reference", "error", "tolerance"))
    good = np.isfinite(value) & np.isfinite(error) & (ratio > 1)
    if not good.any():
        return None, "", ""
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.2, 6.8), sharex=True, height_ratios=(1, 1))
    log_log(above)
    log_log(below)
    spins = sorted(set(spin[good]))
    tightest = {place: tolerance[good & (ratio == place[0]) & (spin == place[1]) & (b == place[2])].min()
                for place in zip(ratio[good], spin[good], b[good])}
    held = np.array([good[k] and tolerance[k] <= tightest[ratio[k], spin[k], b[k]] for k in range(len(b))])
    for a in spins:
        for side, dashes, marker in ((1, "-", "o"), (-1, "--", "s")):
            chosen = held & (spin == a) & (np.sign(b) == side)
            if not chosen.any():
                continue
            colour = SERIES[spins.index(a) % len(SERIES)]
            excess = ratio[chosen] - 1
            label = f"a = {a:g} M, {'with' if side > 0 else 'against'} the spin" if a else "a = 0"
            above.plot(*worst_at(excess, np.abs(reference[chosen])), color=colour, linestyle=dashes, linewidth=1.1)
            above.plot(*worst_at(excess, np.abs(value[chosen])), color=colour, marker=marker, linestyle="none",
                       markersize=5, markerfacecolor=colour if side > 0 else "white", label=label)
            below.plot(*worst_at(excess, np.maximum(error[chosen], ROUND_OFF)), color=colour, marker=marker,
                       markersize=5, markerfacecolor=colour if side > 0 else "white", linestyle=dashes, linewidth=1.0)
    places, limits = worst_at(ratio[held] - 1, tolerance[held])
    below.plot(places, limits, color=BLACK, linewidth=1.1, linestyle=(0, (1, 1.5)), label="largest tolerance")
    units = unit_suffix(case["value"].attrs["units"])
    above.set_ylabel("deflection |α|" + units)
    below.set_ylabel("error of α" + units)
    below.set_xlabel("$b/b_c-1$,   $b_c$ of each spin and side")
    below.set_ylim(*tight_decades(np.concatenate([np.maximum(error[held], ROUND_OFF), limits])))
    above.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    below.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure, "Deflection in the equator of a Kerr hole", (
        "Above: traced (markers) and exact (lines). Below: the largest error at the tightest tolerance that is graded at "
        "each point. Differences below round-off stand at 1.1e-16.")


def kerr_critical(report):
    case = report.case("kerr/critical")
    spin = None if case is None else parameter(case, "a")
    if spin is None:
        return None, "", ""
    labels, gap = text(case["label"]), parameter(case, "gap")
    value, reference, error, tolerance = (case[name][()] for name in ("value", "reference", "error", "tolerance"))
    # Rows with a gap are measured outside the orbit, and say so.
    good = np.isfinite(value) & np.isfinite(error) & (np.isnan(gap) if gap is not None else True)
    if not good.any():
        return None, "", ""
    spins = sorted(set(spin[good]))
    place = np.array([spins.index(a) if a in spins else -1 for a in spin], dtype=float)
    retrograde = np.array(["retrograde" in label for label in labels])
    radius = np.array(["r_ph" in label for label in labels])
    figure, (above, below) = plt.subplots(2, 1, figsize=(7.6, 6.0), sharex=True, height_ratios=(3, 2))
    below.set_yscale("log")
    bar = {"marker": "_", "markersize": 17, "color": BLACK, "linestyle": "none", "zorder": 2}
    for side, colour, marker, shift in ((False, BLUE, "o", -0.1), (True, VERMILION, "s", 0.1)):
        for is_radius, face in ((False, colour), (True, "white")):
            chosen = good & (retrograde == side) & (radius == is_radius)
            if not chosen.any():
                continue
            look = {"marker": marker, "color": colour, "markerfacecolor": face, "linestyle": "none", "zorder": 3}
            label = ("photon orbit" if is_radius else "critical b") + (", retrograde" if side else ", prograde")
            above.plot(place[chosen] + shift, np.abs(reference[chosen]), **bar)
            above.plot(place[chosen] + shift, np.abs(value[chosen]), label=label, **look)
            below.plot(place[chosen] + shift, np.maximum(error[chosen], ROUND_OFF), **look)
            below.plot(place[chosen] + shift, tolerance[chosen], **bar)
    units = unit_suffix(case["value"].attrs["units"])
    above.set_ylabel("radius or |b|" + units)
    below.set_ylabel("error" + units)
    below.set_xlabel("spin a / M")
    below.set_xticks(range(len(spins)), [f"{a:g}" for a in spins])
    below.set_xlim(-0.5, len(spins) - 0.5)
    below.set_ylim(*tight_decades(np.maximum(error[good], ROUND_OFF), high=max(tolerance[good])))
    decades(below.yaxis)
    above.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure, "Critical light around a Kerr hole", (
        "Radii of the circular photon orbits and critical impact parameters, measured (markers) and exact (bars) at each "
        "spin; below, the errors with their tolerances (bars). Differences below round-off stand at 1.1e-16.")


def projection(report):
    """Null residual with and without projection, from the rows of the case that claims it."""
    case = report.case("numerical/projection-residual")
    without = None if case is None else parameter(case, "residual_without_projection")
    if without is None:
        return None, "", ""
    value, tolerance, methods = case["value"][()], case["tolerance"][()], text(case["method"])
    rows = [k for k in np.flatnonzero(np.isfinite(without) & np.isfinite(value))]
    if not rows:
        return None, "", ""
    figure, axes = plt.subplots(figsize=(7.2, 1.3 + 0.36 * len(rows)))
    axes.set_xscale("log")
    for position, k in enumerate(rows):
        shown = max(value[k], 1e-17)
        colour = look_of(methods[k])["color"]
        axes.plot([shown, without[k]], [position, position], color=colour, linewidth=1.2, alpha=0.5, zorder=2)
        axes.plot([without[k]], [position], marker="o", color=colour, markerfacecolor="white", linestyle="none")
        axes.plot([shown], [position], marker="o", color=colour, linestyle="none", zorder=3)
        axes.plot([tolerance[k]] * 2, [position - 0.4, position + 0.4], color=BLACK, linewidth=1.4)
    axes.set_yticks(range(len(rows)), [methods[k] for k in rows])
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("largest null residual")
    decades(axes.xaxis)
    return figure, "Null drift with and without projection", (
        "Largest null residual over a bundle of rays: open circles without projection, filled ones with it, black bars "
        "the largest that passes. Exact zeros stand at 1e-17.")
