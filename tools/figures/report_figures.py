#!/usr/bin/env python3
"""Draws the figures of a validation report from its report.h5, and from nothing else.

Usage: report_figures.py report.h5 DIRECTORY

Writes NAME.svg and NAME.png for each figure that the data can fill, and index.json with titles and captions. The same
report.h5 gives the same bytes. A figure that fails is named under "problems" in the index and the others are drawn.
Change these scripts freely: they read the layout that reports/datasets.hpp describes.
"""

import sys
import traceback

import h5py

from figure_kit import Report, ready, save, write_index
from spacetime_figures import (ellis_deflection, kerr_critical, kerr_deflection, kerr_shadow, projection,
                               schwarzschild_deflection)
from sweep_figures import convergence, error_over_tolerance, null_drift, tolerance_proportionality, work_precision

FIGURES = {
    "error-over-tolerance": error_over_tolerance,
    "schwarzschild-deflection": schwarzschild_deflection,
    "ellis-deflection": ellis_deflection,
    "kerr-deflection": kerr_deflection,
    "kerr-shadow-edge": kerr_shadow,
    "kerr-critical": kerr_critical,
    "work-precision": work_precision,
    "convergence": convergence,
    "tolerance": tolerance_proportionality,
    "null-drift": null_drift,
    "projection": projection,
}


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    directory = ready(arguments[1])
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
    write_index(directory, index)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
