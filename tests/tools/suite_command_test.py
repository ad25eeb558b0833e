#!/usr/bin/env python3
"""`xprimeray validate` and `xprimeray conform` as a user meets them.

Usage: suite_command_test.py PATH_OF_XPRIMERAY [unittest arguments]
"""

import json
import os
import signal
import subprocess
import unittest

from command_case import XPRIMERAY, CommandCase

REPORT = ["figures", "junit.xml", "report.h5", "report.html", "report.md", "summary.json"]


class SuiteCommandTest(CommandCase):
    def refuse(self, *arguments, says):
        self.assertIn(says, self.refused(*arguments))

    def end_of(self, *arguments):
        lines = [json.loads(line) for line in self.succeed(*arguments, "--json").stdout.splitlines()]
        self.assertEqual(lines[-1]["event"], "end")
        return lines[-1]

    def test_every_metric_conforms(self):
        done = self.succeed("conform", "--all")
        self.assertIn("0 of ", done.stdout)
        self.assertNotIn("FAIL", done.stdout)
        for chart in ("kerr boyer-lindquist", "ellis isotropic", "ellipsoid geographic-turned"):
            self.assertIn(chart, done.stdout)

    def test_conform_takes_a_chart_and_parameters(self):
        done = self.succeed("conform", "kerr", "--chart", "boyer-lindquist", "--set", "a=1", "--set", "M=1")
        self.assertIn("a = 1", done.stdout)
        self.assertNotIn("kerr kerr-schild", done.stdout)

    def test_conform_speaks_json(self):
        done = self.succeed("conform", "kerr", "--json")
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        findings = [line for line in lines if line["event"] == "finding" and line["state"] == "passed"]
        self.assertGreater(len(findings), 40)
        for finding in findings:
            self.assertLessEqual(finding["error"], finding["tolerance"])
            self.assertTrue(finding["tolerance_reason"])
        self.assertEqual(lines[-1]["failed"], 0)

    def test_conform_refuses_what_it_does_not_know(self):
        self.refuse("conform", says="needs a metric or --all")
        self.refuse("conform", "kerr", "--all", says="needs a metric or --all")
        self.refuse("conform", "ker", says="did you mean 'kerr'?")
        self.refuse("conform", "kerr", "--chart", "boyer-lindqist", says="did you mean 'boyer-lindquist'?")
        self.refuse("conform", "kerr", "--set", "a=1.2", says="1.2")
        self.refuse("conform", "schwarzschild", "--set", "M=0", says="M = 0")
        self.refuse("conform", "kerr", "--set", "a", says="name=number")
        self.refuse("conform", "kerr", "--points", "0", says="--points")

    def test_validate_writes_a_whole_report(self):
        done = self.succeed("validate", "--case", "conformance/minkowski", "--out", "report")
        self.assertIn("PASSED", done.stdout)
        self.assertEqual(sorted(os.listdir(self.path("report"))), REPORT)
        self.succeed("validate", "--case", "conformance/minkowski", "--out", "report", "--quiet")

    def test_hashes_do_not_depend_on_threads(self):
        case = ["validate", "--case", "schwarzschild/d*", "--case", "conformance/ellis"]
        one = self.end_of(*case, "--threads", "1", "--out", "one")
        two = self.end_of(*case, "--threads", "2", "--out", "two")
        self.assertEqual(one["rays_hash"], two["rays_hash"])
        self.assertEqual(one["report_hash"], two["report_hash"])

    def test_self_test_shows_each_fault_caught(self):
        done = self.succeed("validate", "--case", "conformance/schwarzschild", "--self-test", "--out", "report")
        self.assertIn("schwarzschild-sine-not-squared", done.stdout)
        self.assertNotIn("NOT CAUGHT", done.stdout)
        self.assertNotIn("kerr-frame-dragging", done.stdout)  # under another case

    def test_validate_lists_without_running(self):
        done = self.succeed("validate", "--suite", "conformance", "--list")
        self.assertIn("conformance/kerr", done.stdout)
        self.assertNotIn("schwarzschild/deflection", done.stdout)
        self.assertEqual(os.listdir(self.folder), [])

    def test_validate_refuses_what_it_does_not_know(self):
        self.refuse("validate", "--suite", "quik", says="did you mean 'quick'?")
        self.refuse("validate", "--case", "kerr/deflexion", says="unknown case")
        self.refuse("validate", "--case", "conformance/kerrr", says="did you mean 'conformance/kerr'?")
        self.refuse("validate", "--filter", "no such words", says="nothing is selected")
        self.refuse("validate", "--threads", "-1", says="--threads")

    def test_validate_refuses_a_place_that_is_not_its_own(self):
        os.mkdir(self.path("mine"))
        with open(self.path("mine/thesis.tex"), "w", encoding="utf-8") as file:
            file.write("years of work")
        self.refuse("validate", "--case", "conformance/minkowski", "--out", "mine", says="mine")
        self.assertEqual(os.listdir(self.path("mine")), ["thesis.tex"])
        self.refuse("validate", "--case", "conformance/minkowski", "--out", "/proc/nowhere", says="/proc")

    def test_ctrl_c_leaves_nothing(self):
        arguments = ["validate", "--suite", "full", "--out", "report", "--threads", "1", "--json"]
        with subprocess.Popen(
            [XPRIMERAY, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as running:
            running.stdout.readline()  # a first case is done
            running.send_signal(signal.SIGINT)
            _, errors = running.communicate(timeout=250)
        self.assertEqual(running.returncode, 130, errors)
        self.assertIn("nothing was written", errors)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
