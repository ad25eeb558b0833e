#!/usr/bin/env python3
"""xprimeray errormap and repro as a user meets them.

Usage: errormap_test.py PATH_OF_XPRIMERAY [unittest arguments]
"""

import json
import os
import unittest

import h5py
import numpy

from command_case import CommandCase


class ErrorMapTest(CommandCase):
    def map_refused(self, *arguments, code=2):
        return self.refused("errormap", "--out", "map", *arguments, code=code)

    def test_writes_numbers_channels_figure_and_page(self):
        run = self.run_command("errormap", "--set", "a=0.9", "--pixels", "20x16", "--tol", "1e-8", "--out", "map")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("near_critical", run.stdout)
        folder = os.path.join(self.folder, "map")
        self.assertEqual(sorted(os.listdir(folder)), ["errormap.md", "figures", "map.exr", "map.h5"])
        with h5py.File(os.path.join(folder, "map.h5")) as file:
            table = file["map"]
            self.assertEqual(int(table.attrs["columns"]) * int(table.attrs["rows"]), 320)
            error = table["direction_error"][()]
            agrees = table["status_agrees"][()]
            self.assertTrue(numpy.all(agrees == 1))
            self.assertLess(numpy.nanmedian(error), 1e-7)
            self.assertEqual(table["direction_error"].attrs["units"], "radian")
            # The lower left pixel's centre.
            self.assertAlmostEqual(table["alpha"][0], -12 * 19 / 20, 12)
            self.assertAlmostEqual(table["beta"][0], -12 * 15 / 16, 12)
            classes = h5py.check_enum_dtype(table["class"].dtype)
            self.assertIn(classes["captured"], table["class"][()])
        with open(os.path.join(folder, "map.exr"), "rb") as file:
            self.assertEqual(file.read(4), b"\x76\x2f\x31\x01")
        with open(os.path.join(folder, "errormap.md"), encoding="utf-8") as file:
            page = file.read()
        self.assertIn("320 of 320 rays end as the closed form says", page)
        self.assertIn("figures/error-map.png", page)
        self.assertTrue(os.path.getsize(os.path.join(folder, "figures", "error-map.png")) > 10000)
        # An earlier map is replaced, whole.
        again = self.run_command("errormap", "--set", "a=0.9", "--pixels", "4x4", "--out", "map", "--json")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(json.loads(again.stdout)["pixels"], 16)

    def test_says_what_an_observer_and_a_screen_have_to_be(self):
        self.assertIn("ergosphere", self.map_refused("--set", "a=0.9", "--observer", "r=1.9,inclination=90deg"))
        self.assertIn("inside the horizon", self.map_refused("--set", "a=0.9", "--observer", "r=1.2,inclination=60deg"))
        self.assertIn("axis", self.map_refused("--observer", "r=100,inclination=0deg"))
        self.assertIn("needs a number with its unit", self.map_refused("--observer", "r=100,inclination=60"))
        self.assertIn("did you mean 'inclination'", self.map_refused("--observer", "r=100,inclinaton=60deg"))
        self.assertIn("needs columns x rows", self.map_refused("--pixels", "0x16"))
        self.assertIn("needs columns x rows", self.map_refused("--pixels", "16"))
        self.assertIn("16777216 pixels", self.map_refused("--pixels", "8192x4096"))
        self.assertIn("half-width 0", self.map_refused("--screen", "0"))
        self.assertIn("kerr and schwarzschild", self.map_refused("--metric", "ellis"))
        self.assertIn("spin a = 1.2", self.map_refused("--set", "a=1.2"))
        self.assertIn("--lanes is 3", self.map_refused("--lanes", "3"))
        self.assertIn("dop853", self.map_refused("--method", "dop835"))

    def test_repro_finds_one_hash(self):
        run = self.run_command("repro", "--rays", "16", "--json", "--threads", "2")
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [json.loads(line) for line in run.stdout.splitlines()]
        self.assertEqual({(row["threads"], row["lanes"]) for row in rows}, {(t, w) for t in (1, 2) for w in (1, 2, 4, 8)})
        self.assertEqual(len({row["rays_hash"] for row in rows}), 1)


if __name__ == "__main__":
    unittest.main()
