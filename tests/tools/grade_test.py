#!/usr/bin/env python3
"""xprimeray grade as a user meets it: a challenge out, rays back, a card.

Usage: grade_test.py PATH_OF_XPRIMERAY SOURCE_DIR [unittest arguments]
"""

import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

from command_case import XPRIMERAY, CommandCase

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tools/peers"))

from challenge_rays import End, read_challenge, swept, write_ends  # noqa: E402

COLUMNS = ["id", "status", "x0", "x1", "x2", "x3", "p0", "p1", "p2", "p3", "lambda"]


class GradeTest(CommandCase):
    # A figure takes matplotlib seconds: only where it is looked at.
    figures = False

    def run_command(self, *arguments, **environment):
        if not self.figures:
            environment["XPRIMERAY_FIGURE_SCRIPT"] = os.devnull
        with unittest.mock.patch.dict(os.environ, environment):
            return super().run_command(*arguments)

    def refused(self, *arguments, code=2):
        return super().refused("grade", *arguments, code=code)

    def trace(self, challenge, out, chart="boyer-lindquist", tol="1e-12", metric=("kerr", "a=0.9")):
        self.succeed("trace", "--metric", metric[0], *(["--set", metric[1]] if metric[1] else []), "--chart", chart,
                     "--method", "dop853", "--tol", tol, "--r-max", "100", "--rays", challenge, "--out", out, "--quiet")

    def rows(self, name):
        with open(self.path(name), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def write(self, name, rows, columns=None):
        with open(self.path(name), "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, columns or COLUMNS, extrasaction="ignore", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)

    def traced(self, count=60):
        """A challenge of kerr-core and this program's own rays."""
        self.succeed("grade", "export", "--set", "kerr-core", "--count", str(count), "--out", "challenge.csv")
        self.trace("challenge.csv", "mine.csv")
        return self.rows("mine.csv")

    def score(self, *arguments, code=0, count=60):
        run = self.run_command("grade", "score", "--set", "kerr-core", "--count", str(count), "--out", "card", "--json",
                               *arguments)
        self.assertEqual(run.returncode, code, run.stderr)
        return json.loads(run.stdout)

    def test_own_rays_need_no_conversion_and_get_the_best_grade(self):
        self.figures = True
        self.traced()
        for name in ("challenge.csv", "challenge.csv.sheet.md", "challenge.csv.meta.json"):
            self.assertTrue(os.path.exists(self.path(name)), name)
        card = self.score("--rays", "mine.csv", "--name", "mine")
        self.assertEqual(card["grade"], "A+")
        self.assertEqual(card["cards"][0]["mistakes"], [])
        self.assertEqual(card["cards"][0]["undone"]["failed"], 0)
        self.assertEqual(sorted(os.listdir(self.path("card"))),
                         ["badge.svg", "card.h5", "card.html", "card.json", "card.md", "figures"])
        with open(self.path("card/card.md"), encoding="utf-8") as file:
            page = file.read()
        for text in ("Grade: A+", "What the grade means", "figures/card.png", "near", "xprimeray grade score --set"):
            self.assertIn(text, page)
        with open(self.path("card/badge.svg"), encoding="utf-8") as file:
            self.assertIn("kerr-core: A+", file.read())
        with h5py.File(self.path("card/card.h5")) as file:
            rays = file["cards/0/ray"]
            self.assertEqual(rays["direction"].shape, (60,))
            self.assertLess(np.nanmax(rays["direction_scaled"][()]), 1e-10)

    def test_every_chart_and_format_comes_and_goes(self):
        for chart, ending in (("kerr-schild", "csv"), ("kerr-schild-outgoing", "h5"), ("boyer-lindquist", "h5")):
            self.succeed("grade", "export", "--set", "kerr-core", "--chart", chart, "--count", "30", "--out",
                         f"c.{ending}", "--quiet")
            self.trace(f"c.{ending}", f"m.{ending}", chart)
            card = self.score("--rays", f"m.{ending}", "--chart", chart, count=30)
            self.assertEqual(card["grade"], "A+", chart)

    def test_more_rays_begin_with_the_same_ones(self):
        for count in ("20", "40"):
            self.succeed("grade", "export", "--set", "ellis-core", "--count", count, "--out", f"{count}.csv")
        self.assertEqual(self.rows("20.csv"), self.rows("40.csv")[:20])

    def test_several_tolerances_make_work_against_precision(self):
        self.traced()
        self.trace("challenge.csv", "loose.csv", tol="1e-5")
        card = self.score("--rays", "1e-5=loose.csv", "--rays", "1e-12=mine.csv")
        self.assertEqual(card["grade"], "A+")
        loose, tight = card["cards"]
        self.assertEqual((loose["tolerance"], tight["tolerance"]), (1e-5, 1e-12))
        self.assertLess(loose["work"], tight["work"])
        self.assertGreater(loose["undone"]["quantities"]["direction"]["median"],
                           1e3 * tight["undone"]["quantities"]["direction"]["median"])
        with open(self.path("card/card.md"), encoding="utf-8") as file:
            self.assertIn("Work and precision", file.read())

    def test_events_alone_are_enough(self):
        self.write("events.csv", self.traced(), ["id", "x0", "x1", "x2", "x3"])
        card = self.score("--rays", "events.csv")
        self.assertEqual(card["grade"], "A+")
        self.assertEqual(card["cards"][0]["undone"]["quantities"]["heading"]["letter"], "na")

    def test_degrees_and_nan_are_named_on_the_card(self):
        rows = self.traced()
        for row in rows:
            row["x2"], row["x3"] = (repr(math.degrees(float(row[name]))) for name in ("x2", "x3"))
        rows[7].update(x0="nan", x1="nan", x2="nan", x3="nan")
        self.write("degrees.csv", rows)
        card = self.score("--rays", "degrees.csv", code=1)
        self.assertEqual((card["grade"], card["grade_undone"]), ("F", "D"))  # one of 60 failed: 1.7 %
        self.assertEqual([found["id"] for found in card["cards"][0]["mistakes"]], ["degrees"])
        self.assertEqual(card["cards"][0]["undone"]["outcomes"]["not_finite"], 1)
        with open(self.path("card/card.md"), encoding="utf-8") as file:
            page = file.read()
        self.assertIn("degrees", page)
        self.assertIn("3000007 (captured, not_finite)" if rows[7]["status"] == "captured" else "3000007", page)

    def test_refuses_what_is_no_answer_to_the_set(self):
        rows = self.traced()
        score = ("score", "--set", "kerr-core", "--count", "60", "--out", "card", "--rays", "bad.csv")

        self.write("bad.csv", rows[:50])
        self.assertIn("10 of the 60 rays of 'kerr-core' are missing: 3000050", self.refused(*score))
        self.write("bad.csv", rows + rows[4:5])
        self.assertIn("lines 6 and 62 have the same id 3000004", self.refused(*score))
        self.write("bad.csv", rows[:-1] + [{**rows[-1], "id": "99"}])
        self.assertIn("id 99 belongs to no set", self.refused(*score))
        self.write("bad.csv", rows[:-1] + [{**rows[-1], "id": "4000001"}])
        self.assertIn("belongs to set 'kerr-hard'", self.refused(*score))
        self.write("bad.csv", [{**row, "phi": row["x3"]} for row in rows], ["id", "x0", "x1", "x2", "phi"])
        self.assertIn("columns are id, status", self.refused(*score))
        self.write("bad.csv", rows)
        with open(self.path("bad.csv"), encoding="utf-8") as file:
            content = file.read()
        with open(self.path("bad.csv"), "w", encoding="utf-8") as file:
            file.write(content[:len(content) // 2])
        self.refused(*score)
        with open(self.path("bad.h5"), "wb") as file:
            file.write(b"\x89HDF\r\n\x1a\n" + bytes(40))
        self.assertIn("bad.h5", self.refused("score", "--set", "kerr-core", "--rays", "bad.h5", "--out", "card"))

    def test_says_what_is_missing_or_unknown(self):
        self.assertIn("did you mean 'kerr-core'", self.refused("export", "--set", "ker-core", "--out", "c.csv"))
        self.assertIn("--out is missing", self.refused("export", "--set", "flat"))
        self.assertIn("--set is missing", self.refused("score", "--rays", "x.csv", "--out", "card"))
        self.assertIn("--rays is missing", self.refused("score", "--set", "flat", "--out", "card"))
        self.assertIn("--count -3", self.refused("export", "--set", "flat", "--count", "-3", "--out", "c.csv"))
        self.assertIn("chart", self.refused("export", "--set", "flat", "--chart", "areal", "--out", "c.csv"))
        self.assertIn("TOLERANCE=FILE", self.refused("score", "--set", "flat", "--rays", "tight=x.csv", "--out", "card"))

    def test_a_peer_that_fails_or_is_not_there(self):
        """A stand-in for tools/peers/gyoto_rays.py that ends as it is told to."""
        script = pathlib.Path(self.folder, "peers", "gyoto_rays.py")
        script.parent.mkdir()

        def grade_with(code, text):
            script.write_text(f"import sys\nprint({text!r}, file=sys.stderr)\nsys.exit({code})\n", encoding="utf-8")
            return self.run_command("grade", "gyoto", "--set", "flat", "--out", "card", XPRIMERAY_PEERS=str(script.parent))

        run = grade_with(4, "gyoto_rays: GYOTO is not installed")
        self.assertEqual(run.returncode, 0)
        self.assertIn("SKIPPED: GYOTO was not graded. gyoto_rays: GYOTO is not installed", run.stdout)
        run = grade_with(3, "gyoto_rays: RuntimeError: boom")
        self.assertEqual(run.returncode, 3)
        self.assertIn("boom", run.stderr)
        self.assertEqual(grade_with(2, "gyoto_rays: no such integrator").returncode, 2)
        self.assertEqual(os.listdir(self.folder), ["peers"])

    def test_a_peer_that_works_gets_a_card(self):
        """A stand-in that moves light in flat space by one straight line."""
        script = pathlib.Path(self.folder, "peers", "gyoto_rays.py")
        script.parent.mkdir()
        script.write_text(
            f"import sys\nsys.path.insert(0, {str(SOURCE / 'tools/peers')!r})\n"
            "from challenge_rays import *\n"
            "def main():\n"
            "    c = read_challenge(sys.argv[1])\n"
            "    ends = []\n"
            "    for x, p in zip(c.x, c.p):\n"
            "        lam = 100.0\n"
            "        v = p * np.array([-1, 1, 1, 1])\n"
            "        ends.append(End('escaped', x + lam * v, p, lam, 1))\n"
            "    write_ends(f'{sys.argv[2]}/rays-1e-06.csv', c, ends)\n"
            "sys.exit(guarded('stand-in', main))\n", encoding="utf-8")
        run = self.run_command("grade", "gyoto", "--set", "flat", "--chart", "cartesian", "--tol", "1e-6", "--count", "50",
                               "--out", "card", "--json", XPRIMERAY_PEERS=str(script.parent))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["grade"], "A+")


    def test_gyoto_itself_is_graded_where_it_is_installed_and_skipped_loudly_elsewhere(self):
        run = self.run_command("grade", "gyoto", "--set", "schwarzschild-core", "--count", "20", "--integrator",
                               "runge_kutta_dopri5", "--tol", "1e-6,1e-10", "--out", "card", "--json")
        self.assertIn(run.returncode, (0, 1), run.stderr)
        if run.stdout.startswith("SKIPPED"):
            self.assertIn("python3-gyoto", run.stdout)
            self.assertFalse(os.path.exists(self.path("card")))
            return
        card = json.loads(run.stdout)
        self.assertEqual(card["cards"][1]["mistakes"], [])
        self.assertEqual(card["cards"][1]["undone"]["failed"], 0)
        # Swept angles that a quadrature of dphi/du finds too: 4e-10 rad at 1e-10 (docs/grading.md).
        loose, tight = (one["undone"]["quantities"]["swept"]["median"] for one in card["cards"])
        self.assertTrue(1e-11 < tight < 1e-8 < loose < 1e-4, (tight, loose))


class Adapters(unittest.TestCase):
    def test_swept_azimuths_count_turns_in_either_sense(self):
        path = np.linspace(0.3, 0.3 + 5.0 * np.pi, 40)
        for sense in (1.0, -1.0):
            self.assertAlmostEqual(swept(np.remainder(sense * path, 2.0 * np.pi), sense), sense * 5.0 * np.pi, delta=1e-12)

    def test_a_step_past_an_axis_turns_with_the_momentum(self):
        self.assertAlmostEqual(swept(np.array([0.1, 0.1 + 0.9 * np.pi]), -1.0), -1.1 * np.pi, delta=1e-12)
        self.assertAlmostEqual(swept(np.array([0.1, 0.1 + 0.9 * np.pi]), 1.0), 0.9 * np.pi, delta=1e-12)

    def test_what_gave_up_is_written_as_nan(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([XPRIMERAY, "grade", "export", "--set", "flat", "--count", "3", "--out", f"{folder}/c.csv"],
                                 capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
            challenge = read_challenge(f"{folder}/c.csv")
            self.assertEqual(challenge.metric, "minkowski")
            write_ends(f"{folder}/m.csv", challenge, [End("max_steps")] * 3)
            with open(f"{folder}/m.csv", encoding="utf-8") as file:
                self.assertIn("1000000,max_steps,nan,nan", file.read())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
