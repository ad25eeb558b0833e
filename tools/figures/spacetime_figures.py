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
