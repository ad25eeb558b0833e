#!/usr/bin/env python3
"""xPRIMEray against GYOTO: camera rays of Kerr, errors and rates of both in one run.

The rays: Kerr a = 0.9, observer at 1000 M and 60 degrees, N x N pixel centres within +-12 M, traced back in time until
they are at 1000 M again or captured. GYOTO integrates them in KerrBL by runge_kutta_fehlberg78 with AbsTol = RelTol,
xPRIMEray by `xprimeray trace` with one thread. Progress goes to a terminal's standard error, the tables to standard
output.
"""

import argparse
import csv
import dataclasses
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError as missing:
    print(f"gyoto_kerr: numpy is not installed for {sys.executable} ({missing}); run /usr/bin/python3", file=sys.stderr)
    sys.exit(2)

from kerr_screen import Ends, Grade, Screen, contravariant, grade, rate_at, screen_rays

EXAMPLE = """example:
  /usr/bin/python3 tools/peers/gyoto_kerr.py --pixels 32 --out gyoto.md

exit codes: 0 compared; 2 bad usage, no xprimeray, gyoto or numpy; 3 xprimeray failed
"""
SCREEN = Screen()
# Where both may be asked for their rates; only those that both reach are printed.
COMMON_ERRORS = [10.0 ** (-k / 2) for k in range(6, 27)]
TRUTH = {"method": "dop853", "tol": 1e-13}


class Refused(Exception):
    """Bad usage or a thing that is not there: one line, exit code 2."""


class Failed(Exception):
    """xprimeray did not do its work: one line, exit code 3."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Refused(message)


def positive(kind):
    def convert(text):
        value = kind(text)
        if not 0 < value < float("inf"):
            raise ValueError
        return value

    convert.__name__ = f"positive {kind.__name__}"
    return convert


def arguments_of(words):
    parser = Parser(description=__doc__, epilog=EXAMPLE, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--xprimeray", metavar="PATH", default="build/release/bin/xprimeray",
                        help="default: %(default)s")
    parser.add_argument("--first-integrals", metavar="PATH",
                        help="bench_first_integrals of the same build: its rates and errors join the tables")
    parser.add_argument("--pixels", metavar="N", type=positive(int), default=64, help="on a side; default: %(default)s")
    parser.add_argument("--passes", metavar="K", type=positive(int), default=5,
                        help="a pass runs every setting of each code once, the least time counts; "
                             "default: %(default)s")
    parser.add_argument("--copies", metavar="K", type=positive(int), default=8,
                        help="each ray stands so often in our table, so that tracing outweighs start-up; "
                             "default: %(default)s")
    parser.add_argument("--method", default="dop853", help="ours; default: %(default)s")
    parser.add_argument("--tol", metavar="TOL", type=positive(float), nargs="+",
                        default=[1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11],
                        help="ours; default: 1e-3 ... 1e-11")
    parser.add_argument("--gyoto-tol", metavar="TOL", type=positive(float), nargs="+",
                        default=[1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12],
                        help="GYOTO's AbsTol and RelTol; default: 1e-5 ... 1e-12")
    parser.add_argument("--gyoto-step", metavar="M", type=positive(float), default=50.0,
                        help="GYOTO's first step; at its own default, 0.01, errors at 1e-6 are seven times larger "
                             "and rates no higher; default: %(default)s")
    parser.add_argument("--out", metavar="FILE", help="to write: .md holds all that is printed, .csv the first table")
    options = parser.parse_args(words)
    if options.out and pathlib.Path(options.out).suffix not in (".csv", ".md"):
        raise Refused(f"--out {options.out}: needs a name that ends in .csv or .md")
    if options.out and not pathlib.Path(options.out).absolute().parent.is_dir():
        raise Refused(f"--out {options.out}: no such directory")
    check_executable("--xprimeray", options.xprimeray)
    if options.first_integrals:
        check_executable("--first-integrals", options.first_integrals)
    return options


def check_executable(flag, path):
    if not os.access(path, os.X_OK) or os.path.isdir(path):
        raise Refused(f"{flag} {path}: no such executable; build it, or name another")


class Gyoto:
    """GYOTO's integration of photons, and nothing else of it: no screen, no object, no file."""

    name = "GYOTO"

    def __init__(self, screen, rays, first_step):
        try:
            import gyoto.core
            import gyoto.std
        except ImportError as error:
            raise Refused(f"gyoto is not installed for {sys.executable} ({error}); on Debian 12: "
                          "apt-get install --no-install-recommends python3-gyoto, and run /usr/bin/python3") from None
        gyoto.core.verbose(0)
        x, p = rays
        # GYOTO holds the light as it arrives, future-directed, and is told to integrate it back in time.
        self._starts = np.hstack([x, -contravariant(screen.spin, x, p)])
        self._metric = gyoto.std.KerrBL()
        self._metric.spin(screen.spin)
        self._photon = gyoto.core.Photon()
        self._photon.metric(self._metric)
        self._photon.integrator("runge_kutta_fehlberg78")
        self._photon.adaptive(True)
        self._photon.delta(first_step)
        self._error = gyoto.core.Error
        self._radius = screen.radius
        # Once past the horizon's skin (HorizonSecurity, 0.01 M) GYOTO stops; 1 M further out no light can turn back in.
        self._captured_below = 1.0 + np.sqrt(1.0 - screen.spin**2) + 2.0 * self._metric.horizonSecurity()

    def stop_at(self, truth):
        """GYOTO stops at a time, not at a radius: each ray's, 1 M after its truth is back, so that it takes no step in
        vain. Captured rays get time enough to come out again should GYOTO miss the hole."""
        self._until = np.where(truth.status == "escaped", truth.x[:, 0] - 1.0, -20.0 * self._radius)

    def trace(self, tol):
        """(Ends, CPU seconds spent integrating)."""
        photon = self._photon
        photon.absTol(tol)
        photon.relTol(tol)
        x = np.zeros((len(self._starts), 4))
        nanoseconds = 0
        for row, (start, until) in enumerate(zip(self._starts, self._until)):
            photon.setInitCoord(start, -1)
            begin = time.process_time_ns()
            try:
                photon.xFill(float(until))
            except self._error:
                pass
            nanoseconds += time.process_time_ns() - begin
            x[row] = self._end()
        status = np.where(x[:, 1] >= self._radius, "escaped",
                          np.where(x[:, 1] < self._captured_below, "captured", "unfinished"))
        return Ends(status, x), 1e-9 * nanoseconds

    def _end(self):
        """The last event: GYOTO stores a ray by rising time, so back in time it comes first."""
        columns = [np.empty(self._photon.get_nelements()) for _ in range(4)]
        self._photon.get_t(columns[0])
        self._photon.getCoord(*columns)
        return [column[0] for column in columns]


class Xprimeray:
    """`xprimeray trace` on a table of the rays. Its CPU time holds start-up and CSV; the same command that stops every
    ray after its first step is taken off to leave the tracing."""

    name = "xPRIMEray"

    def __init__(self, screen, rays, executable, copies, folder):
        self._screen, self._executable, self._folder = screen, os.path.abspath(executable), folder
        self._tables = {k: os.path.join(folder, f"rays_{k}.csv") for k in {1, copies}}
        self._copies = copies
        for k, path in self._tables.items():
            write_rays(path, *rays, k)

    def trace(self, method, tol, copies=None, settings=()):
        """(Ends of the first copy, CPU seconds of the whole command)."""
        out = os.path.join(self._folder, "ends.csv")
        command = [self._executable, "trace", "--metric", "kerr", "--set", f"a={self._screen.spin!r}", "--set", "M=1",
                   "--chart", "boyer-lindquist", "--method", method, "--tol", repr(tol), "--threads", "1",
                   "--r-max", repr(self._screen.radius), "--rays", self._tables[copies or self._copies],
                   "--out", out, "--quiet", *settings]
        before = cpu_of_children()
        succeed(command)
        seconds = cpu_of_children() - before
        return read_ends(out, self._screen.pixels**2), seconds

    def idle(self, method, tol):
        """CPU seconds of the command when each ray stops within its first step."""
        return self.trace(method, tol, settings=("--lambda-max", "1e-9"))[1]

    def against_closed_form(self, method, tol):
        """The grade that `xprimeray errormap` gives such rays."""
        screen = self._screen
        command = [self._executable, "errormap", "--metric", "kerr", "--set", f"a={screen.spin!r}",
                   "--observer", f"r={screen.radius!r},inclination={screen.inclination!r}rad",
                   "--screen", repr(screen.half_width), "--pixels", f"{screen.pixels}x{screen.pixels}",
                   "--method", method, "--tol", repr(tol), "--threads", "1", "--json",
                   "--out", os.path.join(self._folder, "map")]
        lines = [json.loads(line) for line in succeed(command, allowed=(0, 1)).splitlines()]
        result = next(line for line in lines if line.get("event") == "result")
        return Grade(*(float(result[key]) for key in ("median", "p99", "max")), result["wrong_status"])


class FirstIntegrals:
    """bench_first_integrals: Kerr light by its first integrals, in lanes, on a screen of its own pixels; graded by the
    closed form. Google Benchmark counts CPU time of the tracing alone."""

    name = "first integrals"

    def __init__(self, executable):
        self._command = [os.path.abspath(executable), "--benchmark_filter=^screen/[0-9]+/[0-9]+/0$",
                         "--benchmark_format=json", "--benchmark_min_time=0.2"]

    def run(self, settings):
        """Adds a pass to the settings, by tolerance: the fastest width counts."""
        for row in json.loads(succeed(self._command))["benchmarks"]:
            tol = 10.0 ** -int(row["name"].split("/")[2])
            setting = settings.setdefault(tol, Setting(self.name, tol, 1))
            setting.seconds = min(setting.seconds, 1.0 / row["items_per_second"])
            setting.grade = Grade(row["median"], row["p99"], row["max"], int(row["wrong_class"]))


def succeed(command, allowed=(0,)):
    """The standard output of a command that must do its work."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        reason = (done.stderr.strip().splitlines() or ["no message"])[-1]
        kind = Refused if done.returncode == 2 else Failed
        raise kind(f"{' '.join(command)}: exit code {done.returncode}: {reason}")
    return done.stdout


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def write_rays(path, x, p, copies):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["id", *(f"x{k}" for k in range(4)), *(f"p{k}" for k in range(4))])
        rows = np.tile(np.hstack([x, p]), (copies, 1)).tolist()
        writer.writerows([number, *map(repr, row)] for number, row in enumerate(rows))


def read_ends(path, count):
    """The first rows of a table of traced rays."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row, _ in zip(csv.DictReader(file), range(count))]
    columns = [[float(row[f"{letter}{k}"]) for k in range(4)] for letter in "xp" for row in rows]
    return Ends(np.array([row["status"] for row in rows]), np.array(columns[:count]), np.array(columns[count:]))


@dataclasses.dataclass
class Setting:
    """One tolerance of one code: its grade, and the least CPU time of the passes."""

    code: str
    tol: float
    rays: int
    grade: object = None
    seconds: float = float("inf")
    command_seconds: float = float("inf")

    @property
    def rate(self):
        return self.rays / self.seconds

    @property
    def command_rate(self):
        return self.rays / self.command_seconds


def measure(options, gyoto, ours, truth):
    """Settings of each code, run in turn, pass by pass: GYOTO's, xprimeray trace's, those by first integrals."""
    theirs = [Setting(gyoto.name, tol, options.pixels**2) for tol in options.gyoto_tol]
    mine = [Setting(ours.name, tol, options.pixels**2 * options.copies) for tol in options.tol]
    integrals = {}
    idle = float("inf")
    for number in range(options.passes):
        for k in range(max(len(theirs), len(mine))):
            progress(f"pass {number + 1} of {options.passes}, setting {k + 1}")
            if k < len(theirs):
                ends, seconds = gyoto.trace(theirs[k].tol)
                theirs[k].seconds = min(theirs[k].seconds, seconds)
                theirs[k].grade = grade(SCREEN.spin, ends, truth)
            if k < len(mine):
                idle = min(idle, ours.idle(options.method, mine[k].tol))
                ends, seconds = ours.trace(options.method, mine[k].tol)
                mine[k].command_seconds = min(mine[k].command_seconds, seconds)
                mine[k].grade = grade(SCREEN.spin, ends, truth)
        if options.first_integrals:
            FirstIntegrals(options.first_integrals).run(integrals)
    for setting in mine:
        setting.seconds = setting.command_seconds - idle
        if setting.seconds < idle:
            say(f"gyoto_kerr: at {setting.tol:g} tracing takes less time than the tables; raise --copies or --pixels")
    return theirs, mine, list(integrals.values())


def say(text):
    print(text, file=sys.stderr, flush=True)


def progress(text):
    if sys.stderr.isatty():
        say(text)


def settings_table(*codes):
    header = ["code", "tolerance", "rays/s", "rays/s, whole command", "median error", "p99", "max", "wrong class"]
    rows = [[s.code, f"{s.tol:.0e}", f"{s.rate:.0f}", f"{s.command_rate:.0f}" if s.command_rate > 0 else "na",
             *(f"{value:.2e}" for value in (s.grade.median, s.grade.p99, s.grade.largest)), str(s.grade.wrong_class)]
            for settings in codes for s in settings]
    return header, rows


def ratio_table(theirs, mine, integrals):
    """Rates at equal median error, where GYOTO and xprimeray trace both reach it."""
    header = ["median error", "GYOTO, rays/s", "xPRIMEray, rays/s", "ratio", "ratio, whole command"]
    if integrals:
        header += ["first integrals, rays/s", "ratio"]

    def at(error, settings, rate="rate"):
        return rate_at(error, [s.grade.median for s in settings], [getattr(s, rate) for s in settings])

    rows = []
    for error in COMMON_ERRORS:
        slow, fast = at(error, theirs), at(error, mine)
        if not (np.isfinite(slow) and np.isfinite(fast)):
            continue
        row = [f"{error:.1e}", f"{slow:.0f}", f"{fast:.0f}", f"{fast / slow:.1f}",
               f"{at(error, mine, 'command_rate') / slow:.1f}"]
        if integrals:
            rate = at(error, integrals)
            row += [f"{rate:.0f}", f"{rate / slow:.0f}"] if np.isfinite(rate) else ["na", "na"]
        rows.append(row)
    return header, rows


def markdown(header, rows):
    widths = [max(len(row[k]) for row in (header, *rows)) for k in range(len(header))]
    lines = [[cell.rjust(width) for cell, width in zip(row, widths)] for row in (header, *rows)]
    lines.insert(1, ["-" * (width - 1) + ":" for width in widths])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def notes(options, truth, truth_grade):
    counts = ", ".join(f"{np.count_nonzero(truth.status == name)} {name}" for name in np.unique(truth.status))
    load = ", ".join(f"{value:.1f}" for value in os.getloadavg())
    lines = [
        f"Kerr a = {SCREEN.spin:g}, observer at {SCREEN.radius:g} M and 60 degrees, "
        f"{options.pixels} x {options.pixels} rays within +-{SCREEN.half_width:g} M: {counts}.",
        f"Rates: CPU time of one thread, least of {options.passes} passes in which the codes take turns; the machine's "
        f"load at the end, over 1, 5 and 15 minutes: {load}.",
        "GYOTO: runge_kutta_fehlberg78 in KerrBL, AbsTol = RelTol = tolerance, first step "
        f"{options.gyoto_step:g} M; its integration alone (Worldline::xFill).",
        f"xPRIMEray: {options.method}; the CPU time of `xprimeray trace` less that of the same command with every ray "
        "stopped in its first step. 'Whole command' takes nothing off: start-up, reading and writing CSV are in it.",
        "Error: the angle between final directions (theta, phi), over rays that escape, at the code's own end radius; "
        "the truth is carried there from 1000 M by its first integrals.",
        f"Truth: xprimeray, {TRUTH['method']} at {TRUTH['tol']:.0e}, itself off the closed form by "
        f"{truth_grade.median:.1e} (median), {truth_grade.p99:.1e} (p99), {truth_grade.largest:.1e} (max), "
        f"{truth_grade.wrong_class} rays of a wrong class.",
    ]
    if options.first_integrals:
        lines.append("First integrals: bench_first_integrals, the fastest width at each tolerance, tracing alone; its "
                     "own pixels of the same screen, graded by the closed form.")
    return "\n".join(lines)


def write_out(path, note, tables):
    """Written aside and renamed, so that it is complete or absent."""
    path = pathlib.Path(path)
    aside = path.with_name(path.name + ".part")
    with open(aside, "w", newline="", encoding="utf-8") as file:
        if path.suffix == ".md":
            file.write("\n\n".join([note.replace("\n", "\n\n"), *(markdown(*table) for table in tables)]) + "\n")
        else:
            writer = csv.writer(file)
            header, rows = tables[0]
            writer.writerow(header)
            writer.writerows(rows)
    aside.replace(path)


def run(words):
    options = arguments_of(words)
    screen = dataclasses.replace(SCREEN, pixels=options.pixels)
    rays = screen_rays(screen)
    gyoto = Gyoto(screen, rays, options.gyoto_step)
    with tempfile.TemporaryDirectory(prefix="xprimeray-gyoto-") as folder:
        ours = Xprimeray(screen, rays, options.xprimeray, options.copies, folder)
        truth = ours.trace(**TRUTH, copies=1)[0]
        truth_grade = ours.against_closed_form(**TRUTH)
        gyoto.stop_at(truth)
        codes = measure(options, gyoto, ours, truth)
    tables = [settings_table(*codes), ratio_table(*codes)]
    note = notes(options, truth, truth_grade)
    if not tables[1][1]:
        say("gyoto_kerr: the tolerances of the two codes reach no common error: there is no ratio")
    print(note, *(markdown(*table) for table in tables), sep="\n\n")
    if options.out:
        write_out(options.out, note, tables)


def main():
    try:
        run(sys.argv[1:])
    except Refused as error:
        say(f"gyoto_kerr: {error}")
        return 2
    except Failed as error:
        say(f"gyoto_kerr: {error}")
        return 3
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
