#!/usr/bin/env python3
"""Traces a challenge set with GYOTO's bindings: one table of rays for each tolerance.

KerrBL for Boyer-Lindquist and areal charts, KerrKS for Kerr-Schild, Minkowski for flat space. GYOTO holds light as it
arrives, future-directed, and integrates it forwards or back in time; it is asked for more time until a ray is outside
r_max or has stopped at the horizon. Handed in is a step of GYOTO's own: the first beyond r_max, or the last before the
horizon. Conventions undone here: phi comes modulo 2 pi and is made continuous along the stored path; momenta come as
dx/dlambda and are lowered with GYOTO's own metric; what runs back in time is turned round.
"""

import argparse
import pathlib
import sys
import time

try:
    import numpy as np
except ImportError as missing:
    print(f"gyoto_rays: numpy is not installed for {sys.executable} ({missing}); run /usr/bin/python3", file=sys.stderr)
    sys.exit(4)

from challenge_rays import End, NotInstalled, Refused, guarded, read_challenge, report, swept, write_ends

INTEGRATORS = ("runge_kutta_fehlberg78", "runge_kutta_cash_karp54", "runge_kutta_dopri5",
               "runge_kutta_cash_karp54_classic", "Legacy")
CHARTS = {("kerr", "boyer-lindquist"): "KerrBL", ("schwarzschild", "areal"): "KerrBL", ("kerr", "kerr-schild"): "KerrKS",
          ("schwarzschild", "kerr-schild"): "KerrKS", ("minkowski", "spherical"): "Minkowski",
          ("minkowski", "cartesian"): "Minkowski"}


def import_gyoto():
    try:
        import gyoto.core
        import gyoto.std
    except ImportError as error:
        raise NotInstalled(f"GYOTO is not installed for {sys.executable} ({error}); on Debian 12: apt-get install "
                           "--no-install-recommends python3-gyoto, and run /usr/bin/python3") from None
    gyoto.core.verbose(0)
    return gyoto


class Gyoto:
    def __init__(self, challenge, integrator, first_step, most_steps):
        self._gyoto = import_gyoto()
        self._challenge = challenge
        name = CHARTS.get((challenge.metric, challenge.chart))
        if name is None:
            raise Refused(f"GYOTO has no metric for {challenge.metric} in chart {challenge.chart}; it takes "
                          + ", ".join(f"{metric} in {chart}" for metric, chart in CHARTS))
        self._metric = getattr(self._gyoto.std, name)()
        self._spherical = challenge.chart not in ("kerr-schild", "cartesian")
        self._has_hole = name != "Minkowski"
        if self._has_hole:
            self._metric.spin(challenge.spin)
        elif self._spherical:
            self._metric.setParameter("Spherical", "", "")
        self._photon = self._gyoto.core.Photon()
        self._photon.metric(self._metric)
        self._photon.integrator(integrator)
        self._photon.adaptive(True)
        self._photon.delta(first_step)
        self._photon.maxiter(most_steps)
        self.name = f"GYOTO {name} {integrator}"

    def metric(self, x):
        # Asked of the base class, whose binding takes NumPy's arrays for every metric.
        g = np.zeros((4, 4))
        self._gyoto.core.Metric(self._metric).gmunu(g, np.asarray(x, float))
        return g

    def radius(self, x):
        """r of events, one row each."""
        if self._spherical:
            return x[:, 1]
        squares = np.sum(x[:, 1:] ** 2, axis=1)
        a = self._challenge.spin
        b = squares - a * a
        return np.sqrt(0.5 * (b + np.sqrt(b * b + 4.0 * (a * x[:, 3]) ** 2)))

    def trace(self, number, tol):
        """The end of a ray at a tolerance."""
        photon = self._photon
        photon.absTol(tol)
        photon.relTol(tol)
        x, p = self._challenge.x[number], self._challenge.p[number]
        velocity = np.linalg.solve(self.metric(x), p)
        sense = 1 if velocity[0] > 0.0 else -1
        photon.setInitCoord(np.concatenate([x, sense * velocity]), sense)
        begin = time.process_time()
        stopped = False
        reach = 1.2 * (self._challenge.r_max + self.radius(x[None])[0]) + 20.0
        try:
            for _ in range(12):
                photon.xFill(x[0] + sense * reach)
                path = self._path(sense)
                r = self.radius(path[0])
                stopped = abs(path[0][-1, 0] - x[0]) < 0.999 * reach
                if r[-1] >= self._challenge.r_max or stopped:
                    break
                reach *= 2.0
        except self._gyoto.core.Error:
            return End("step_underflow", seconds=time.process_time() - begin)
        return self._end(path, stopped, sense, x, p, time.process_time() - begin)

    def _path(self, sense):
        """(x, dx/dlambda, lambda) along the ray: GYOTO stores it by rising time."""
        count = self._photon.get_nelements()
        x, v = np.empty((4, count)), np.empty((4, count))
        self._photon.get_t(x[0])
        self._photon.getCoord(*x)
        self._photon.get_dot(*v)
        tau = self._gyoto.core.array_double(count)
        self._photon.get_tau(tau)
        affine = np.array([tau[k] for k in range(count)])
        return x.T[::sense], v.T[::sense], affine[::sense]

    def _end(self, path, stopped, sense, start, p, seconds):
        x, v, affine = path
        r = self.radius(x)
        outside = np.flatnonzero((r >= self._challenge.r_max) & (np.arange(len(r)) > 0))
        last = outside[0] if outside.size else len(r) - 1
        status = "escaped" if outside.size else "max_steps"
        # GYOTO stops by itself next to the horizon and keeps no step that comes too close: KerrKS's last one may be
        # well outside.
        if self._has_hole and stopped and not outside.size and r[last] < 2.0 * self._challenge.horizon:
            status = "captured"
        end = x[last].copy()
        if self._spherical:
            end[3] = start[3] + swept(x[: last + 1, 3], p[3])
        momentum = sense * (self.metric(x[last]) @ v[last])
        return End(status, end, momentum, abs(affine[last] - affine[0]), int(last), seconds)

    def run(self, tol):
        ends = []
        for number in range(len(self._challenge.ids)):
            ends.append(self.trace(number, tol))
            report(number + 1, len(self._challenge.ids), f"{self.name} {tol:g}")
        return ends


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Refused(message)


def run(words):
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("challenge", help="from `xprimeray grade export`, .csv")
    parser.add_argument("folder", help="to write rays-TOL.csv into")
    parser.add_argument("--tol", type=float, nargs="+", default=[1e-6, 1e-8, 1e-10, 1e-12], help="AbsTol and RelTol")
    parser.add_argument("--integrator", choices=INTEGRATORS, default=INTEGRATORS[0])
    parser.add_argument("--first-step", type=float, default=1.0, help="GYOTO's Delta; default: %(default)s")
    parser.add_argument("--max-steps", type=int, default=20000, help="GYOTO's MaxIter; default: %(default)s")
    options = parser.parse_args(words)
    challenge = read_challenge(options.challenge)
    gyoto = Gyoto(challenge, options.integrator, options.first_step, options.max_steps)
    for tol in options.tol:
        write_ends(pathlib.Path(options.folder) / f"rays-{tol:g}.csv", challenge, gyoto.run(tol))


if __name__ == "__main__":
    sys.exit(guarded("gyoto_rays", lambda: run(sys.argv[1:])))
