#!/usr/bin/env python3
"""Traces a challenge set with EinsteinPy's geodesic integrator (FANTASY, fixed steps): one table for each step.

EinsteinPy's `Nulllike` takes a number of steps and drops what goes wrong; here its integrator, metric functions and
momenta are used as they are, step by step, until a ray is outside r_max, next to the horizon, or at its budget of
steps. Boyer-Lindquist and areal charts, M = 1. EinsteinPy knows light that runs forwards in time: a ray traced back is
the same light with the step negative.
"""

import argparse
import pathlib
import sys
import time
import warnings

try:
    import numpy as np
except ImportError as missing:
    print(f"einsteinpy_rays: numpy is not installed for {sys.executable} ({missing})", file=sys.stderr)
    sys.exit(4)

from challenge_rays import End, NotInstalled, Refused, guarded, read_challenge, report, write_ends

CHARTS = {("kerr", "boyer-lindquist"): "_kerr", ("schwarzschild", "areal"): "_sch"}


class EinsteinPy:
    def __init__(self, challenge, order, omega, budget):
        try:
            from einsteinpy.geodesic import utils
            from einsteinpy.integrators import GeodesicIntegrator
        except ImportError as error:
            raise NotInstalled(f"EinsteinPy is not installed for {sys.executable} ({error}); on Debian 12: apt-get "
                               "install --no-install-recommends python3-einsteinpy, and run /usr/bin/python3") from None
        name = CHARTS.get((challenge.metric, challenge.chart))
        if name is None:
            raise Refused(f"EinsteinPy has no metric for {challenge.metric} in chart {challenge.chart}; it takes "
                          + ", ".join(f"{metric} in {chart}" for metric, chart in CHARTS))
        self._challenge, self._order, self._omega, self._budget = challenge, order, omega, budget
        self._metric = getattr(utils, name)
        self._integrator = GeodesicIntegrator
        self.name = f"EinsteinPy order {order}"

    def trace(self, number, step):
        challenge = self._challenge
        x, p = challenge.x[number], challenge.p[number]
        sense = 1.0 if p[0] < 0.0 else -1.0
        begin = time.process_time()
        integrator = self._integrator(metric=self._metric, metric_params=(challenge.spin,), q0=x.copy(), p0=sense * p,
                                      time_like=False, steps=self._budget, delta=sense * step, order=self._order,
                                      omega=self._omega, suppress_warnings=True)
        status, taken = "max_steps", 0
        state = (x, sense * p)
        for taken in range(1, self._budget + 1):
            integrator.step()
            state = tuple(np.asarray(part, float) for part in integrator.res_list[:2])
            r = state[0][1]
            if not (np.isfinite(state[0]).all() and np.isfinite(state[1]).all()):
                status = "not_finite"
            elif r >= challenge.r_max:
                status = "escaped"
            elif r < 1.05 * challenge.horizon:
                # A fixed step may well jump over the horizon: what is inside is captured all the same.
                status = "captured"
            else:
                continue
            break
        return End(status, state[0], sense * state[1], taken * step, taken, time.process_time() - begin)

    def run(self, step):
        ends = []
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for number in range(len(self._challenge.ids)):
                ends.append(self.trace(number, step))
                report(number + 1, len(self._challenge.ids), f"{self.name} step {step:g}")
        return ends


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Refused(message)


def run(words):
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("challenge", help="from `xprimeray grade export`, .csv")
    parser.add_argument("folder", help="to write rays-STEP.csv into")
    parser.add_argument("--tol", type=float, nargs="+", default=[1.0, 0.25], help="fixed steps in lambda, for E = 1")
    parser.add_argument("--integrator", choices=("2", "4", "6", "8"), default="4", help="order")
    parser.add_argument("--omega", type=float, default=1.0, help="coupling of the two copies of phase space")
    parser.add_argument("--budget", type=int, default=2000, help="steps a ray; default: %(default)s")
    options = parser.parse_args(words)
    challenge = read_challenge(options.challenge)
    einsteinpy = EinsteinPy(challenge, int(options.integrator), options.omega, options.budget)
    for step in options.tol:
        write_ends(pathlib.Path(options.folder) / f"rays-{step:g}.csv", challenge, einsteinpy.run(step))


if __name__ == "__main__":
    sys.exit(guarded("einsteinpy_rays", lambda: run(sys.argv[1:])))
