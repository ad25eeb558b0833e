"""A challenge set in, rays out: what the adapters of other codes share. Needs NumPy and nothing else.

A challenge is a CSV ray table (`xprimeray grade export`) with CHALLENGE.meta.json beside it; what an adapter writes is
a table that `xprimeray grade score` reads.
"""

import csv
import dataclasses
import json
import pathlib
import sys

import numpy as np


class Refused(Exception):
    """Bad usage or a thing that is not there: one line, exit code 2."""


class NotInstalled(Exception):
    """The code to be graded is not there: one line, exit code 4 of an adapter, which its caller turns into a skip."""


@dataclasses.dataclass(frozen=True)
class Challenge:
    """Rays and what they mean: events x, covariant momenta p, one row a ray."""

    set: str
    metric: str
    parameters: dict
    chart: str
    r_max: float
    ids: np.ndarray
    x: np.ndarray
    p: np.ndarray

    @property
    def spin(self):
        return float(self.parameters.get("a", 0.0))

    @property
    def horizon(self):
        return 1.0 + np.sqrt(1.0 - self.spin**2)


@dataclasses.dataclass
class End:
    """Where a ray ended; nan where a code gave up."""

    status: str
    x: np.ndarray = dataclasses.field(default_factory=lambda: np.full(4, np.nan))
    p: np.ndarray = dataclasses.field(default_factory=lambda: np.full(4, np.nan))
    lam: float = float("nan")
    steps: int = 0
    seconds: float = 0.0


def read_challenge(path):
    path = pathlib.Path(path)
    try:
        about = json.loads(path.with_name(path.name + ".meta.json").read_text(encoding="utf-8"))
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        events = [np.array([[float(row[f"{letter}{k}"]) for k in range(4)] for row in rows]) for letter in "xp"]
        if float(about["parameters"].get("M", 1.0)) != 1.0:
            raise Refused(f"{path}: M is {about['parameters']['M']}; these codes hold lengths in units of M = 1")
        return Challenge(about["set"], about["metric"], about["parameters"], about["chart"], float(about["r_max"]),
                         np.array([int(row["id"]) for row in rows]), *events)
    except (OSError, KeyError, ValueError) as error:
        raise Refused(f"{path}: cannot be read as a challenge ({error}); `xprimeray grade export` writes one") from None


def write_ends(path, challenge, ends):
    """Written aside and renamed, so that it is complete or absent."""
    path = pathlib.Path(path)
    aside = path.with_name(path.name + ".part")
    with open(aside, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["id", "status", *(f"x{k}" for k in range(4)), *(f"p{k}" for k in range(4)), "lambda", "steps",
                         "seconds"])
        for number, end in zip(challenge.ids, ends):
            numbers = [repr(float(value)) for value in (*end.x, *end.p, end.lam)]
            writer.writerow([int(number), end.status, *numbers, end.steps, repr(end.seconds)])
    aside.replace(path)


def swept(phi, p_phi):
    """The azimuth swept along a path, with its turns, from azimuths modulo 2 pi. A step is taken to turn by less than
    half a turn; past an axis, where it turns by about that, the sense is that of p_phi."""
    steps = np.remainder(np.diff(phi) + np.pi, 2.0 * np.pi) - np.pi
    wrong = (np.abs(steps) > 0.75 * np.pi) & (steps * p_phi < 0.0)
    steps[wrong] += np.copysign(2.0 * np.pi, p_phi)
    return steps.sum()


def report(done, count, name):
    if sys.stderr.isatty():
        print(f"\r\033[K{name}: {done} of {count}", end="" if done < count else "\r\033[K", file=sys.stderr, flush=True)


def guarded(name, action):
    """The exit code of an adapter: 0 traced, 2 bad usage, 3 the code failed, 4 it is not installed."""
    try:
        action()
    except Refused as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 2
    except NotInstalled as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 4
    except KeyboardInterrupt:
        return 130
    except Exception as error:  # pylint: disable=broad-except
        print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr)
        return 3
    return 0
