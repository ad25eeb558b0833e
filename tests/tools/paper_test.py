#!/usr/bin/env python3
"""xprimeray paper as a user meets it.

Usage: paper_test.py PATH_OF_XPRIMERAY [unittest arguments]
"""

import json
import os
import unittest

import h5py

from command_case import CommandCase


class PaperTest(CommandCase):
    prefix = ("paper",)

    def test_lists_the_papers(self):
        run = self.run_command("--list")
        self.assertEqual(run.returncode, 0, run.stderr)
        ids = [line.split()[0] for line in run.stdout.splitlines()]
        self.assertIn("virbhadra-ellis-2000", ids)
        self.assertEqual(len(ids), len(set(ids)))
        listed = [json.loads(line)["paper"] for line in self.run_command("--list", "--json").stdout.splitlines()]
        self.assertEqual(listed, ids)

    def test_shows_printed_exact_ours_and_writes_page_figure_and_numbers(self):
        run = self.run_command("virbhadra-ellis-2000")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"3 pi/2 +M +3\.21 +3\.2085317")
        self.assertRegex(run.stdout, r"Sgr A\* +microarcsecond +17 ")
        self.assertNotIn("16.898", run.stdout)  # from memory only: never shown as if printed
        folder = os.path.join(self.folder, "report", "virbhadra-ellis-2000")
        self.assertEqual(sorted(os.listdir(folder)),
                         ["figures", "junit.xml", "overview.html", "overview.md", "paper.h5", "summary.json",
                          "virbhadra-ellis-2000.html", "virbhadra-ellis-2000.md"])
        self.assertGreater(os.path.getsize(os.path.join(folder, "figures", "virbhadra-ellis-2000.png")), 10000)
        with open(os.path.join(folder, "virbhadra-ellis-2000.md"), encoding="utf-8") as file:
            page = file.read()
        for part in ("Printed, exact, ours", "Not checked", "Every route", "figures/virbhadra-ellis-2000.png", "dop853"):
            self.assertIn(part, page)
        with h5py.File(os.path.join(folder, "paper.h5")) as file:
            claims = file["papers/virbhadra-ellis-2000/claims"]
            printed = dict(zip(claims["quantity"].asstr()[()], claims["printed"].asstr()[()]))
            self.assertEqual(printed["closest approach for a deflection of 3 pi/2"], "3.21")
            rows = file["cases/papers/virbhadra-ellis-2000"]
            self.assertGreater(len(rows["value"]), 25)
            self.assertEqual(file["figures/virbhadra-ellis-2000/panel_0/series_00"].attrs["look"], "line")
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        self.assertEqual(summary["exit_code"], 0)
        self.assertEqual(summary["papers"]["virbhadra-ellis-2000"]["claims"]["fail"], 0)

    def test_one_and_two_threads_give_one_hash(self):
        hashes = set()
        for threads in ("1", "2"):
            run = self.run_command("darwin-1959", "bozza-2002", "--threads", threads, "--json", "--out", "r")
            self.assertEqual(run.returncode, 0, run.stderr)
            end = json.loads(run.stdout.splitlines()[-1])
            hashes.add((end["rays_hash"], end["report_hash"]))
        self.assertEqual(len(hashes), 1)

    def test_an_earlier_report_is_replaced_and_anything_else_is_not(self):
        self.assertEqual(self.run_command("bozza-2002", "--out", "r", "--quiet").returncode, 0)
        run = self.run_command("darwin-1959", "--out", "r", "--quiet")
        self.assertEqual((run.returncode, run.stdout), (0, ""))
        self.assertNotIn("bozza-2002.md", os.listdir(os.path.join(self.folder, "r")))
        os.mkdir(os.path.join(self.folder, "mine"))
        with open(os.path.join(self.folder, "mine", "thesis.tex"), "w", encoding="utf-8") as file:
            file.write("years of work")
        self.refused("bozza-2002", "--out", "mine")
        self.assertEqual(os.listdir(os.path.join(self.folder, "mine")), ["thesis.tex"])

    def test_says_what_was_wrong(self):
        self.assertIn("did you mean 'darwin-1959'", self.refused("darwin-1995"))
        self.assertIn("no paper named", self.refused())
        self.assertIn("one or the other", self.refused("--all", "darwin-1959"))
        self.assertIn("named twice", self.refused("darwin-1959", "darwin-1959"))
        self.assertIn("--threads is negative", self.refused("darwin-1959", "--threads", "-1"))
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
