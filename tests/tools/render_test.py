#!/usr/bin/env python3
"""xprimeray render and compare as a user meets them.

Usage: render_test.py PATH_OF_XPRIMERAY SOURCE_FOLDER [unittest arguments]
"""

import json
import os
import shutil
import sys
import unittest

import h5py
import numpy

from command_case import CommandCase

SCENES = os.path.join(os.path.abspath(sys.argv.pop(1)), "scenes") if len(sys.argv) > 1 else ""
FRAME = ["frame.exr", "frame.h5", "frame.json", "frame.md", "frame.png"]


class RenderTest(CommandCase):
    def render(self, scene, out, *arguments):
        run = self.run_command("render", os.path.join(SCENES, scene + ".toml"), "--out", out, "--json", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout.splitlines()[-1])

    def planes(self, out):
        with h5py.File(self.path(os.path.join(out, "frame.h5"))) as file:
            return {name: data[()] for name, data in file["frame"].items()}

    def test_writes_every_file_of_a_frame(self):
        result = self.render("fixture_001", "frame", "--scale", "0.1")
        self.assertEqual(sorted(os.listdir(self.path("frame"))), FRAME)
        with h5py.File(self.path("frame/frame.h5")) as file:
            frame = file["frame"]
            pixels = int(frame.attrs["columns"]) * int(frame.attrs["rows"])
            self.assertEqual(len(frame["R"]), pixels)
            self.assertEqual(frame["deflection"].attrs["units"], "radian")
            classes = h5py.check_enum_dtype(frame["class"].dtype)
            self.assertIn(classes["geom_hit"], frame["class"][()])
            self.assertEqual(file["provenance"].attrs["frame_hash"], result["frame_hash"])
        with open(self.path("frame/frame.json"), encoding="utf-8") as file:
            summary = json.load(file)
        self.assertEqual(sum(summary["classes"].values()), pixels)
        with open(self.path("frame/frame.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        with open(self.path("frame/frame.md"), encoding="utf-8") as file:
            self.assertIn("geom_hit", file.read())

    def test_no_pixel_depends_on_threads_lanes_or_backend(self):
        hashes = {self.render("fixture_001", "frame", "--scale", "0.05", *arguments)["frame_hash"]
                  for arguments in (["--threads", "1", "--lanes", "1"], ["--threads", "2", "--lanes", "4"],
                                    ["--threads", "2", "--lanes", "8"], ["--backend", "reference"])}
        self.assertEqual(len(hashes), 1)

    def test_compare_says_what_moved(self):
        self.render("fixture_001", "a", "--scale", "0.05")
        self.render("fixture_001", "b", "--scale", "0.05")
        self.assertIn("unchanged", self.succeed("compare", "a", "b").stdout)
        self.render("fixture_001", "b", "--scale", "0.05", "--tol", "1e-3")
        run = self.run_command("compare", "a", "b")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertRegex(run.stdout, r"deflection +\d+ pixels, at most \S+, \d+ ULPs; first at column")
        self.render("fixture_001", "c", "--scale", "0.06")
        self.assertIn("cannot be compared", self.refused("compare", "a", "c"))
        self.assertIn("neither a report nor a frame", self.refused("compare", "a", "."))
        self.assertIn("needs two directories", self.refused("compare", "a"))

    def test_light_bends_in_a_field_and_not_without(self):
        self.render("fixture_001", "curved", "--scale", "0.05")
        self.render("flat", "straight", "--scale", "0.05")
        self.assertGreater(numpy.nanmax(self.planes("curved")["deflection"]), 0.05)
        self.assertLess(numpy.nanmax(self.planes("straight")["deflection"]), 1e-12)

    def test_bad_input_is_one_line_and_leaves_nothing(self):
        scene = os.path.join(SCENES, "fixture_001.toml")
        self.assertIn("no scene named", self.refused("render", "--out", "frame"))
        self.assertIn("--out is missing", self.refused("render", scene))
        self.assertIn("nowhere.toml", self.refused("render", "nowhere.toml", "--out", "frame"))
        self.assertIn("did you mean 'reference'?", self.refused("render", scene, "--out", "frame", "--backend", "referense"))
        self.assertIn("tier", self.refused("render", scene, "--out", "frame", "--tier", "3"))
        with open(self.path("odd.toml"), "w", encoding="utf-8") as file:
            file.write("[camera]\nmodell = 'pinhole'\n")
        self.assertIn("did you mean 'model'?", self.refused("render", "odd.toml", "--out", "frame"))

    def test_a_dry_run_says_what_the_scene_comes_to(self):
        run = self.succeed("render", os.path.join(SCENES, "fixture_001.toml"), "--dry-run")
        self.assertIn("pinhole", run.stdout)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_directory_that_is_no_frame_stays(self):
        os.mkdir(self.path("mine"))
        with open(self.path("mine/thesis.txt"), "w", encoding="utf-8") as file:
            file.write("words")
        self.refused("render", os.path.join(SCENES, "fixture_001.toml"), "--out", "mine")
        self.assertEqual(os.listdir(self.path("mine")), ["thesis.txt"])
        shutil.rmtree(self.path("mine"))


if __name__ == "__main__":
    unittest.main()
