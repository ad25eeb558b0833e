#!/usr/bin/env python3
"""xprimeray reference as a user meets it.

Usage: reference_test.py PATH_OF_XPRIMERAY SOURCE_FOLDER [unittest arguments]
"""

import json
import os
import shutil
import subprocess
import sys
import unittest

from command_case import XPRIMERAY, CommandCase

STORED = os.path.join(os.path.abspath(sys.argv.pop(1)), "reference_data") if len(sys.argv) > 1 else ""


def content(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class ReferenceTest(CommandCase):
    prefix = ("reference",)

    def setUp(self):
        super().setUp()
        self.data = os.path.join(self.folder, "reference_data")
        shutil.copytree(STORED, self.data)

    def test_lists_tables_with_rank_digits_and_state(self):
        run = self.run_command()
        self.assertEqual(run.returncode, 0, run.stderr)
        line = next(line for line in run.stdout.splitlines() if line.startswith("schwarzschild_deflection"))
        self.assertIn("closed form", line)
        self.assertIn("30", line)
        self.assertIn("hash agrees", line)
        self.assertEqual(self.run_command("--quiet").stdout, "")
        tables = [json.loads(line) for line in self.run_command("--json").stdout.splitlines()]
        self.assertEqual(sorted(table["name"] for table in tables), [table["name"] for table in tables])
        self.assertEqual({table["state"] for table in tables}, {"hash agrees"})

    def test_a_table_changed_by_hand_is_named(self):
        path = os.path.join(self.data, "ellis_deflection.csv")
        with open(path, "w", encoding="utf-8") as file:
            file.write(content(os.path.join(STORED, "ellis_deflection.csv")).replace("5.85059614", "5.85059615"))
        for arguments in ([], ["--check", "ellis_deflection"]):
            with self.subTest(arguments=arguments):
                run = self.run_command(*arguments)  # the tables are listed all the same
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertRegex(run.stderr, r"\A[^\n]*ellis_deflection\.csv: hash mismatch[^\n]*\n\Z")
        self.assertEqual(self.run_command("kerr_shadow_edge").returncode, 0)
        self.assertEqual(self.run_command("--regenerate", "ellis_deflection").returncode, 0)
        self.assertEqual(content(path), content(os.path.join(STORED, "ellis_deflection.csv")))

    def test_regenerates_the_stored_bytes(self):
        names = ["ellis_transit_angle", "schwarzschild_deflection", "kerr_spherical_orbits"]
        run = self.run_command("--regenerate", "--out", "new", *names)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "new"))), sorted(name + ".csv" for name in names))
        for name in names:
            self.assertEqual(content(os.path.join(self.folder, "new", name + ".csv")),
                             content(os.path.join(STORED, name + ".csv")))
        self.assertIn("every digit agrees", self.run_command("--check", *names).stdout)

    def test_lists_what_is_built_in_where_there_is_no_folder(self):
        elsewhere = os.path.join(self.folder, "elsewhere")
        os.mkdir(elsewhere)
        built_in = subprocess.run([XPRIMERAY, "reference"], capture_output=True, text=True, check=False, cwd=elsewhere)
        self.assertEqual(built_in.returncode, 0, built_in.stderr)
        self.assertEqual(built_in.stdout, self.run_command().stdout)

    def test_bad_input_is_one_line_and_writes_nothing(self):
        self.assertIn("did you mean 'ellis_deflection'?", self.refused("ellis_deflectoin"))
        self.assertIn("did you mean 'ellis_deflection'?", self.refused("--regenerate", "--out", "new", "ellis_deflectoin"))
        self.assertIn("not both", self.refused("--regenerate", "--check"))
        self.assertIn("goes with --regenerate", self.refused("--out", "new"))
        self.assertIn("No such file", self.refused("--data", "nowhere"))
        self.assertIn("No such file", self.refused("--regenerate", "--data", "nowhere", "ellis_deflection"))
        self.assertEqual(os.listdir(self.folder), ["reference_data"])


if __name__ == "__main__":
    unittest.main()
