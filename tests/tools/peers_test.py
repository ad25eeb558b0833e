"""tools/peers, as far as it goes without the peers: the rays, the comparison of directions, the statistics, bad input.

Usage: peers_test.py SOURCE_DIR [unittest arguments]
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
PEERS = SOURCE / "tools/peers"
sys.path.insert(0, str(PEERS))

from kerr_screen import (Ends, Screen, angle_between, carried, contravariant, grade, radial_potential,  # noqa: E402
                         rate_at, screen_rays)

SPIN = 0.9


def covariant_metric(spin, x):
    """Kerr in Boyer-Lindquist coordinates, from its line element; contravariant() is written from the inverse."""
    r, theta = x[:, 1], x[:, 2]
    sigma = r**2 + (spin * np.cos(theta)) ** 2
    g = np.zeros((len(x), 4, 4))
    g[:, 0, 0] = -1.0 + 2.0 * r / sigma
    g[:, 1, 1] = sigma / (r**2 - 2.0 * r + spin**2)
    g[:, 2, 2] = sigma
    g[:, 3, 3] = (r**2 + spin**2 + 2.0 * r * (spin * np.sin(theta)) ** 2 / sigma) * np.sin(theta) ** 2
    g[:, 0, 3] = g[:, 3, 0] = -2.0 * spin * r * np.sin(theta) ** 2 / sigma
    return g


class Rays(unittest.TestCase):
    def setUp(self):
        self.x, self.p = screen_rays(Screen(pixels=16))

    def test_are_null_to_round_off(self):
        tangent = contravariant(SPIN, self.x, self.p)
        # Terms of order 1 cancel; p_r carries the round-off of R(r), a difference of numbers of its own size.
        self.assertLess(np.abs(np.sum(tangent * self.p, axis=1)).max(), 1e-14)
        g = covariant_metric(SPIN, self.x)
        self.assertLess(np.abs(np.einsum("ni,nij,nj->n", tangent, g, tangent)).max(), 1e-14)

    def test_go_back_in_time_and_inward(self):
        tangent = contravariant(SPIN, self.x, self.p)
        self.assertTrue((tangent[:, 0] < 0.0).all())
        self.assertTrue((tangent[:, 1] < 0.0).all())

    def test_prograde_light_comes_from_the_left(self):
        # alpha < 0: the light has lambda > 0, so its past-directed tangent has p_phi < 0; alpha runs fastest.
        self.assertLess(self.p[0, 3], 0.0)
        self.assertEqual(self.p[0, 3], -self.p[15, 3])
        self.assertAlmostEqual(self.p[0, 3], -11.25 * np.sin(np.pi / 3), delta=1e-14)

    def test_hold_carters_constant_of_the_screen(self):
        cosine_sq, sine_sq = 0.25, 0.75
        carter = self.p[:, 2] ** 2 + cosine_sq * (self.p[:, 3] ** 2 / sine_sq - SPIN**2)
        alpha, beta = -11.25, -11.25
        self.assertAlmostEqual(carter[0], (alpha**2 - SPIN**2) * cosine_sq + beta**2, delta=1e-12)


class Carrying(unittest.TestCase):
    """Rays at 1000 M that go out again: those of the screen with p_r turned round."""

    def setUp(self):
        self.x, self.p = screen_rays(Screen(pixels=12))
        self.p[:, 1] = -self.p[:, 1]

    def outward(self, steps=64):
        return carried(SPIN, self.x, self.p, np.full(len(self.x), 2000.0), steps)

    def test_more_steps_change_nothing(self):
        # Truncation at 64 steps is below 1e-16 rad; what is left is round-off of phi of order 1.
        for few, many in zip(self.outward(), self.outward(256)):
            self.assertLess(np.abs(few - many).max(), 1e-14)

    def test_starts_along_the_tangent(self):
        tangent = contravariant(SPIN, self.x, self.p)
        step = 0.1
        theta, phi = carried(SPIN, self.x, self.p, self.x[:, 1] + step)
        back_theta, back_phi = carried(SPIN, self.x, self.p, self.x[:, 1] - step)
        # Central difference: its own error step^2 b/r^4 = 2e-13 at b = 17, round-off 64 x 1e-16 / (2 step) = 3e-14. The
        # slopes are 1e-5, and what the spin adds to them 2 a/r^3 = 2e-9.
        for ahead, behind, k in ((theta, back_theta, 2), (phi, back_phi, 3)):
            slope = (ahead - behind) / (2.0 * step)
            self.assertLess(np.abs(slope - tangent[:, k] / tangent[:, 1]).max(), 5e-13)

    def test_is_a_straight_line_far_out(self):
        # At 1e9 M the hole bends by 4/b * (b/r)^2 / 4 ~ 1e-17 rad: x + s n in flat space is exact.
        far = 1e9
        x = np.array([[0.0, far, 1.0, 0.5]])
        p_theta, p_phi = 3e8, 2e8
        p = np.array([[1.0, 0.0, p_theta, p_phi]])
        carter = p_theta**2 + np.cos(1.0) ** 2 * (p_phi**2 / np.sin(1.0) ** 2 - SPIN**2)
        p[0, 1] = np.sqrt(radial_potential(SPIN, -p_phi, carter, far)) / (far**2 - 2.0 * far + SPIN**2)
        e_r = np.array([np.sin(1.0) * np.cos(0.5), np.sin(1.0) * np.sin(0.5), np.cos(1.0)])
        e_theta = np.array([np.cos(1.0) * np.cos(0.5), np.cos(1.0) * np.sin(0.5), -np.sin(1.0)])
        e_phi = np.array([-np.sin(0.5), np.cos(0.5), 0.0])
        across = (p_theta * e_theta + p_phi / np.sin(1.0) * e_phi) / far
        direction = np.sqrt(1.0 - across @ across) * e_r + across
        inward = far * (e_r @ direction)
        end = far * e_r + (np.sqrt(inward**2 + 3.0 * far**2) - inward) * direction
        theta, phi = carried(SPIN, x, p, np.array([2.0 * far]), steps=2000)
        # The hole delays and bends at the order M/r = 1e-9 here, where b is of the order of r.
        apart = angle_between(theta, phi, np.arccos(end[2:] / (2.0 * far)), np.arctan2(end[1:2], end[:1]))
        self.assertLess(apart[0], 3e-9)


class Directions(unittest.TestCase):
    def test_turns_and_the_axis_do_not_count(self):
        self.assertLess(angle_between(1.0, 0.3, 1.0, 0.3 + 4.0 * np.pi), 1e-15)
        self.assertLess(angle_between(-0.2, 0.3, 0.2, 0.3 + np.pi), 1e-15)
        self.assertLess(angle_between(0.0, 0.3, 0.0, 2.0), 1e-15)

    def test_small_and_large_angles_are_angles(self):
        # The components of unit vectors hold 1e-16 each.
        self.assertAlmostEqual(angle_between(1.0, 0.0, 1.0 + 1e-9, 0.0), 1e-9, delta=5e-16)
        self.assertAlmostEqual(angle_between(0.5, 1.0, 0.5, 1.0 + 1e-6), 1e-6 * np.sin(0.5), delta=1e-15)
        self.assertAlmostEqual(angle_between(0.0, 0.0, np.pi, 0.0), np.pi, delta=1e-15)
        self.assertAlmostEqual(angle_between(np.pi / 2, 0.0, np.pi / 2, 2.0), 2.0, delta=1e-15)


class Statistics(unittest.TestCase):
    def test_errors_are_over_rays_that_escape_twice_and_classes_over_all(self):
        x, p = screen_rays(Screen(pixels=11))
        p[:, 1] = -p[:, 1]
        count = len(x)
        truth = Ends(np.array(["escaped"] * (count - 20) + ["captured"] * 20), x, p)
        moved = x.copy()
        moved[:, 2] += 1e-6 * np.arange(1, count + 1)
        status = truth.status.copy()
        status[-1], status[0], status[1] = "escaped", "unfinished", "captured"
        found = grade(SPIN, Ends(status, moved), truth)
        self.assertEqual(found.wrong_class, 3)
        errors = 1e-6 * np.arange(3, count - 19)
        for value, expected in ((found.median, np.median(errors)), (found.p99, np.quantile(errors, 0.99)),
                                (found.largest, errors[-1])):
            # Unit vectors hold 1e-16, and the carrying over no distance nothing.
            self.assertAlmostEqual(value, expected, delta=1e-15)

    def test_nothing_escaped_has_no_error(self):
        x, p = screen_rays(Screen(pixels=2))
        found = grade(SPIN, Ends(np.full(4, "captured"), x), Ends(np.full(4, "escaped"), x, p))
        self.assertTrue(np.isnan(found.median))
        self.assertEqual(found.wrong_class, 4)

    def test_rates_between_settings_follow_a_power_law(self):
        errors = np.array([1e-10, 1e-6, 1e-8])
        rates = 100.0 * errors**0.125
        self.assertAlmostEqual(rate_at(1e-9, errors, rates) / (100.0 * 1e-9**0.125), 1.0, delta=1e-14)
        self.assertAlmostEqual(rate_at(1e-7, errors, rates) / (100.0 * 1e-7**0.125), 1.0, delta=1e-14)

    def test_a_rate_is_not_extrapolated(self):
        self.assertTrue(np.isnan(rate_at(1e-5, [1e-6, 1e-8], [2.0, 1.0])))
        self.assertTrue(np.isnan(rate_at(1e-9, [1e-6, 1e-8], [2.0, 1.0])))

    def test_a_setting_that_is_slower_and_worse_is_left_out(self):
        self.assertAlmostEqual(rate_at(1e-7, [1e-6, 1e-7, 1e-8], [4.0, 0.5, 1.0]), 2.0, delta=1e-14)


class BadInput(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xprimeray-peers-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refuse(self, *arguments, says, without="gyoto"):
        """One clear line and exit code 2. A module that cannot be imported stands before any that is installed."""
        (self.folder / without).mkdir()
        (self.folder / without / "__init__.py").write_text("raise ImportError('a stub')\n", encoding="utf-8")
        environment = {**os.environ, "PYTHONPATH": str(self.folder)}
        done = subprocess.run([sys.executable, "-B", str(PEERS / "gyoto_kerr.py"), *arguments], capture_output=True,
                              text=True, check=False, timeout=60, env=environment, cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(says, done.stderr)

    def test_an_unknown_executable_is_named(self):
        self.refuse("--xprimeray", "no/such/xprimeray", says="--xprimeray no/such/xprimeray: no such executable")

    def test_a_directory_is_no_executable(self):
        self.refuse("--xprimeray", "/", says="--xprimeray /: no such executable")

    def test_without_gyoto_it_says_what_to_install(self):
        self.refuse("--xprimeray", sys.executable, says="apt-get install --no-install-recommends python3-gyoto")

    def test_without_numpy_it_says_which_python_has_it(self):
        self.refuse("--xprimeray", sys.executable, says="numpy is not installed", without="numpy")

    def test_numbers_need_to_be_positive(self):
        self.refuse("--pixels", "0", says="--pixels: invalid positive int value: '0'")

    def test_a_table_needs_a_known_ending(self):
        self.refuse("--out", "table.txt", says="--out table.txt: needs a name that ends in .csv or .md")

    def test_help_has_an_example(self):
        done = subprocess.run([sys.executable, "-B", str(PEERS / "gyoto_kerr.py"), "--help"], capture_output=True,
                              text=True, check=True, timeout=60)
        self.assertIn("example:\n  /usr/bin/python3 tools/peers/gyoto_kerr.py", done.stdout)


if __name__ == "__main__":
    unittest.main()
