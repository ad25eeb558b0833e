"""Draws the figure of a report card: how many rays are off by how much, by quantity and by family, and work and precision.

    card.py <card.h5> <directory>

Writes card.svg, card.png and index.json.
"""

import sys

import h5py
import numpy as np

from figure_kit import (BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SERIES, SKY, VERMILION, log_log, names_of, plt, ready, save,
                        tight_decades, write_index)

QUANTITIES = {"direction": (BLUE, "-"), "swept": (SKY, "--"), "time": (GREEN, "-"), "heading": (VERMILION, "--"),
              "affine": (ORANGE, "-."), "conserved": (PURPLE, "-"), "null": (BLACK, ":")}
LETTERS = {"A+": 1e-10, "A": 1e-8, "B": 1e-6, "C": 1e-4, "D": 1e-2}
LEAST = 1e-17  # where an exact zero is drawn


def known(values, chosen):
    values = values[chosen & np.isfinite(values)]
    return np.sort(np.maximum(values, LEAST))


def share_above(axes, values, **look):
    """Fraction of the rays with more than each value."""
    axes.plot(values, 1.0 - np.arange(values.size) / values.size, **look)


def letter_lines(axes):
    low, high = axes.get_xlim()
    for letter, limit in LETTERS.items():
        if low < limit < high:
            axes.axvline(limit, color=GREY, linewidth=0.8, linestyle=":")
            axes.annotate(letter, (limit, 1.0), xycoords=("data", "axes fraction"), xytext=(-3, -3),
                          textcoords="offset points", ha="right", va="top", fontsize=8.5, color=GREY)


def finish_shares(axes, drawn, title):
    if not drawn:
        axes.annotate("nothing was compared", (0.5, 0.5), xycoords="axes fraction", ha="center", color=GREY)
        return
    log_log(axes)
    axes.set_xlim(*tight_decades([value for values in drawn for value in (values[0], values[-1])]))
    axes.set(xlabel="scaled error [radian, or 1]", ylabel="fraction of the rays with more", title=title)
    axes.axhline(0.01, color=GREY, linewidth=0.8, linestyle=":")
    letter_lines(axes)
    axes.legend(loc="lower left", frameon=True, framealpha=0.85, edgecolor="none")


def by_quantity(axes, rays, compared):
    drawn = []
    for name, (colour, line) in QUANTITIES.items():
        values = known(rays[f"{name}_scaled"][()], compared)
        if values.size:
            share_above(axes, values, color=colour, linestyle=line, label=name)
            drawn.append(values)
    finish_shares(axes, drawn, "Scaled errors, by quantity")


def by_family(axes, rays, compared):
    families = np.array(names_of(rays["family"]))
    error = rays["direction"][()]
    drawn = []
    for k, family in enumerate(dict.fromkeys(families)):
        values = known(error, compared & (families == family))
        if values.size:
            share_above(axes, values, color=SERIES[k % len(SERIES)], label=family)
            drawn.append(values)
    finish_shares(axes, drawn, "Error in direction as it is, by family")
    if drawn:
        axes.set_xlabel("error in direction [radian]")


def against_condition(axes, rays, compared):
    condition, error = rays["direction_condition"][()], rays["direction"][()]
    good = compared & np.isfinite(error)
    if not good.any():
        axes.annotate("nothing was compared", (0.5, 0.5), xycoords="axes fraction", ha="center", color=GREY)
        return
    log_log(axes)
    families = np.array(names_of(rays["family"]))
    for k, family in enumerate(dict.fromkeys(families)):
        chosen = good & (families == family)
        axes.plot(np.maximum(condition[chosen], 0.3), np.maximum(error[chosen], LEAST), ".", markersize=3.5,
                  color=SERIES[k % len(SERIES)])
    axes.set(xlabel="condition of the ray [radian per length unit]", ylabel="error in direction [radian]",
             title="Error against condition")


def work_and_precision(axes, cards):
    """Median and p99 of the direction against work, or against tolerance where no work was handed in."""
    units = {str(card.attrs["work_unit"]) for card in cards}
    by_work = len(units) == 1 and "" not in units
    rows = []
    for card in cards:
        rays = card["ray"]
        compared = np.array(names_of(rays["outcome"])) == "compared"
        values = known(rays["direction"][()], compared)
        at = float(card.attrs["work" if by_work else "tolerance"])
        if values.size and np.isfinite(at):
            rows.append((at, np.median(values), values[min(values.size - 1, int(0.99 * values.size))]))
    if len(rows) < 2:
        return False
    at, median, p99 = np.array(sorted(rows)).T
    log_log(axes)
    axes.plot(at, median, "o-", color=BLUE, label="median")
    axes.plot(at, p99, "s--", color=VERMILION, label="p99")
    if not by_work:
        axes.plot(at, at, color=GREY, linewidth=0.9, linestyle=":", label="error = tolerance")
    if at.max() < 10.0 * at.min():
        # Less than a decade has no label of its own.
        axes.set_xticks(at, [f"{value:.3g}" for value in at])
        axes.set_xticks([], minor=True)
    axes.set(xlabel=f"{units.pop()} a ray" if by_work else "tolerance asked for", ylabel="error in direction [radian]",
             title="Work and precision" if by_work else "Error against tolerance")
    axes.legend()
    return True


def draw(file):
    cards = [file["cards"][name] for name in sorted(file["cards"], key=int)]
    main = next(card for card in cards if card.attrs["main"])
    rays = main["ray"]
    compared = np.array(names_of(rays["outcome"])) == "compared"
    several = len(cards) > 1
    figure, axes = plt.subplots(2 if several else 1, 2 if several else 3, figsize=(11.5, 8.6) if several else (15.5, 4.6))
    axes = axes.ravel()
    by_quantity(axes[0], rays, compared)
    by_family(axes[1], rays, compared)
    against_condition(axes[2], rays, compared)
    if several and not work_and_precision(axes[3], cards):
        axes[3].set_axis_off()
    figure.suptitle(f"{file.attrs['name']} on {file.attrs['set']}"
                    + (f", tolerance {main.attrs['label']}" if several else ""), fontsize=11)
    caption = ("Left: the fraction of the rays that are off by more than the abscissa; dotted, what each letter allows at "
               "the 99th percentile. The condition is what the end turns by for a length unit in the start's angular "
               "momentum. Rays that failed are not drawn.")
    return figure, caption


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    directory = ready(arguments[1])
    with h5py.File(arguments[0], "r") as file:
        figure, caption = draw(file)
        title = f"Report card: {file.attrs['name']} on {file.attrs['set']}"
    save(figure, directory, "card")
    write_index(directory, {"figures": [{"name": "card", "title": title, "caption": caption}], "problems": []})
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
