"""A report as its readers see it: report.h5 through h5py, XML and HTML through parsers, figures as files.

Usage: report_h5_test.py SAMPLE_REPORT [unittest arguments]
"""

import html.parser
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

SAMPLE_REPORT = sys.argv.pop(1)
SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "tools/figures"
FIGURES = ["convergence", "error-over-tolerance", "kerr-critical", "kerr-shadow-edge", "null-drift",
           "schwarzschild-deflection", "tolerance", "work-precision"]


def write_report(kind, directory, *more, **options):
    return subprocess.run([SAMPLE_REPORT, kind, str(directory), *more], capture_output=True, text=True, check=False,
                          **options)


def datasets(file, volatile=False):
    """Every dataset by its path, /volatile left out unless asked for."""
    found = {}

    def visit(path, item):
        if isinstance(item, h5py.Dataset) and (volatile or not path.startswith("volatile")):
            found[path] = item

    file.visititems(visit)
    return found


class Page(html.parser.HTMLParser):
    """Collects anchors, links and images, and notes tags that do not close as they opened."""

    VOID = {"meta", "img", "br", "link"}

    def __init__(self):
        super().__init__()
        self.open, self.mismatched = [], []
        self.ids, self.links, self.images, self.scripts = [], [], [], 0

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.ids += [named["id"]] if "id" in named else []
        self.links += [named["href"]] if "href" in named else []
        self.images += [named["src"]] if "src" in named else []
        self.scripts += tag == "script"
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.mismatched.append(tag)


class ReadReports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.keep = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.keep.cleanup)
        root = pathlib.Path(cls.keep.name)
        cls.troubled, cls.again = root / "troubled", root / "again"
        done = write_report("troubled", cls.troubled)
        assert (done.returncode, done.stderr) == (0, ""), done.stderr
        done = write_report("troubled", cls.again, "--other-circumstances", env={**os.environ, "XPRIMERAY_PYTHON": ""})
        assert done.returncode == 0, done.stderr
        cls.file = h5py.File(cls.troubled / "report.h5", "r")
        cls.addClassCleanup(cls.file.close)
        cls.summary = json.loads((cls.troubled / "summary.json").read_text(encoding="utf-8"))

    def test_every_dataset_has_units_and_a_long_name(self):
        found = datasets(self.file, volatile=True)
        self.assertGreater(len(found), 100)
        for path, dataset in found.items():
            with self.subTest(path):
                self.assertIsInstance(dataset.attrs["units"], str)
                self.assertTrue(dataset.attrs["units"])
                self.assertGreater(len(dataset.attrs["long_name"]), 3)

    def test_the_file_says_what_it_is(self):
        self.assertEqual(self.file.attrs["schema"], "xprimeray-report")
        self.assertEqual(self.file.attrs["schema_version"], 1)
        self.assertEqual(self.file["provenance"].attrs["version"], "0.1.0")
        self.assertEqual(json.loads(self.file["provenance"].attrs["configuration"]), {"suite": "quick"})
        self.assertEqual(self.file["volatile"].attrs["threads"], "2")
        self.assertEqual(self.file["volatile"].attrs["date"], "2024-06-07T12:00:00Z")
        self.assertNotIn("date", self.file["provenance"].attrs)

    def test_parameters_and_labels_are_scales_of_every_column(self):
        case = self.file["cases/schwarzschild/deflection"]
        for name in ("parameter/b_over_M", "label"):
            self.assertTrue(h5py.h5ds.is_scale(case[name].id), name)
        for name, column in case.items():
            if name in ("parameter", "label"):
                continue
            with self.subTest(name):
                self.assertEqual(set(column.dims[0].keys()), {"label", "b/M"})
                np.testing.assert_array_equal(column.dims[0]["b/M"][()], case["parameter/b_over_M"][()])
        curve = self.file["sweeps/kerr/dop853/kerr-schild/deflection"]
        np.testing.assert_array_equal(curve["error_norm"].dims[0]["setting"][()], curve["setting"][()])

    def test_verdicts_are_an_enum_whose_counts_the_summary_gives(self):
        totals = dict.fromkeys(["pass", "fail", "inconclusive", "error", "skipped"], 0)
        for path, dataset in datasets(self.file).items():
            if path.endswith("/verdict"):
                names = h5py.check_enum_dtype(dataset.dtype)
                self.assertEqual(set(names), set(totals))
                for name, code in names.items():
                    totals[name] += int((dataset[()] == code).sum())
        self.assertEqual({**totals, "total": sum(totals.values())}, self.summary["counts"])
        self.assertEqual(totals, {"pass": 95, "fail": 1, "inconclusive": 1, "error": 2, "skipped": 1})
        family_totals = [family["counts"]["total"] for family in self.summary["families"].values()]
        self.assertEqual(sum(family_totals), self.summary["counts"]["total"])

    def test_flags_of_faults_are_booleans(self):
        self.assertEqual(self.file["faults/caught"][()].tolist(), [True, True, False])

    def test_columns_of_a_case_agree_with_one_another(self):
        case = self.file["cases/kerr/shadow_edge"]
        np.testing.assert_array_equal(np.abs(case["value"][()] - case["reference"][()]), case["error"][()])
        self.assertEqual(case["value"].attrs["units"], "M")
        self.assertEqual(case["parameter/inclination"].attrs["units"], "radian")
        self.assertEqual(case.attrs["rank"], "closed form")

    def test_another_run_differs_only_in_what_is_volatile(self):
        other_summary = json.loads((self.again / "summary.json").read_text(encoding="utf-8"))
        for name in ("report_hash", "rays_hash"):
            self.assertRegex(self.summary[name], "^[0-9a-f]{32}$")
            self.assertEqual(self.summary[name], other_summary[name])
            self.assertEqual(self.summary[name], self.file["provenance"].attrs[name])
            self.assertIn(self.summary[name], (self.troubled / "report.md").read_text(encoding="utf-8"))
        self.assertNotEqual(self.summary["report_hash"], self.summary["rays_hash"])
        with h5py.File(self.again / "report.h5", "r") as other:
            ours, theirs = datasets(self.file), datasets(other)
            self.assertEqual(set(ours), set(theirs))
            for path in ours:
                self.assertEqual(ours[path][()].tobytes() if ours[path].dtype.kind != "O" else list(ours[path][()]),
                                 theirs[path][()].tobytes() if theirs[path].dtype.kind != "O" else
                                 list(theirs[path][()]), path)
            self.assertNotEqual(list(self.file["volatile/cases/seconds"]), list(other["volatile/cases/seconds"]))

    def test_the_same_inputs_give_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "copy"
            self.assertEqual(write_report("troubled", copy).returncode, 0)
            for path in sorted(self.troubled.rglob("*")):
                if path.is_file():
                    relative = path.relative_to(self.troubled)
                    self.assertEqual(path.read_bytes(), (copy / relative).read_bytes(), relative)

    def test_figures_are_drawn_and_shown_by_every_page(self):
        self.assertEqual(self.summary["figure_problems"], [])
        drawn = sorted(path.stem for path in (self.troubled / "figures").glob("*.svg"))
        self.assertEqual(drawn, FIGURES)
        markdown = (self.troubled / "report.md").read_text(encoding="utf-8")
        for name in FIGURES:
            self.assertIn(f"(figures/{name}.png)", markdown)
            png = (self.troubled / f"figures/{name}.png").read_bytes()
            self.assertTrue(png.startswith(b"\x89PNG") and len(png) > 8000, name)
            xml.etree.ElementTree.parse(self.troubled / f"figures/{name}.svg")

    def test_the_page_is_well_formed_and_its_links_lead_somewhere(self):
        page = Page()
        page.feed((self.troubled / "report.html").read_text(encoding="utf-8"))
        self.assertEqual((page.open, page.mismatched), ([], []))
        self.assertEqual(len(page.ids), len(set(page.ids)))
        for link in page.links:
            if link.startswith("#"):
                self.assertIn(link[1:], page.ids)
            else:
                self.assertTrue((self.troubled / link).exists(), link)
        self.assertEqual(sorted(page.images), [f"figures/{name}.svg" for name in FIGURES])
        self.assertEqual(page.scripts, 0)
        self.assertIn("case-schwarzschild-deflection", page.ids)

    def test_junit_parses_and_counts_as_the_summary_does(self):
        root = xml.etree.ElementTree.parse(self.troubled / "junit.xml").getroot()
        suites = {suite.get("name"): suite for suite in root}
        self.assertEqual(len(suites), 5)
        cases = [case for name, suite in suites.items() if name != "planted-faults" for case in suite]
        counts = self.summary["counts"]
        self.assertEqual(len(cases), counts["total"])
        self.assertEqual(sum(case.find("failure") is not None for case in cases),
                         counts["fail"] + counts["inconclusive"])
        self.assertEqual(sum(case.find("error") is not None for case in cases), counts["error"])
        self.assertEqual(sum(case.find("skipped") is not None for case in cases), counts["skipped"])
        labels = [case.get("name") for case in suites["conformance/kerr"]]
        self.assertIn('Ricci & Riemann | "vacuum", kerr-schild', labels)

    def test_the_first_row_in_the_report_is_the_one_that_fails(self):
        lines = (self.troubled / "report.md").read_text(encoding="utf-8").splitlines()
        first = next(line for line in lines if "schwarzschild/deflection" in line)
        self.assertIn("**FAIL**", first)
        self.assertEqual(self.summary["failures"][0]["verdict"], "fail")
        self.assertEqual(self.summary["failures"][1]["value"], "nan")
        self.assertIsNone(self.summary["failures"][2]["value"])
        self.assertEqual((self.summary["outcome"], self.summary["exit_code"]), ("ERROR", 3))
        self.assertEqual(self.summary["faults"], {"planted": 3, "caught": 2, "missed": ["sin-for-sin-squared"]})


class BadDays(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.root = pathlib.Path(keep.name)

    def test_a_disk_that_is_full_leaves_what_stood_there(self):
        # A limit on the size of files stands in for the disk: writing fails in the same calls.
        without_figures = {**os.environ, "XPRIMERAY_PYTHON": ""}
        self.assertEqual(write_report("passing", self.root / "out", env=without_figures).returncode, 0)
        before = (self.root / "out/report.h5").read_bytes()
        for limit in (1000, 60000):
            done = write_report("troubled", self.root / "out", env=without_figures, restore_signals=False,
                                preexec_fn=lambda size=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertEqual([path.name for path in self.root.iterdir()], ["out"])
            self.assertEqual((self.root / "out/report.h5").read_bytes(), before)

    def test_one_figure_that_fails_does_not_take_the_others_with_it(self):
        shutil.copytree(SCRIPTS, self.root / "scripts")
        broken = self.root / "scripts/spacetime_figures.py"
        broken.write_text(broken.read_text().replace("def kerr_shadow(report):",
                                                     "def kerr_shadow(report):\n    raise ValueError('x')"))
        script = self.root / "scripts/report_figures.py"
        done = write_report("passing", self.root / "out", env={**os.environ, "XPRIMERAY_FIGURE_SCRIPT": str(script)})
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stderr, "A FIGURE IS MISSING: kerr-shadow-edge: ValueError: x\n")
        drawn = sorted(path.stem for path in (self.root / "out/figures").glob("*.svg"))
        self.assertEqual(drawn, [name for name in FIGURES if name != "kerr-shadow-edge"])

    def test_figures_come_out_of_a_report_with_little_in_it(self):
        self.assertEqual(write_report("passing", self.root / "out",
                                      env={**os.environ, "XPRIMERAY_PYTHON": ""}).returncode, 0)
        with h5py.File(self.root / "out/report.h5", "a") as file:
            for group in ("sweeps", "cases/kerr", "cases/schwarzschild"):
                del file[group]
        script = SCRIPTS / "report_figures.py"
        for expected in (["error-over-tolerance"], []):
            folder = self.root / f"figures-{len(expected)}"
            done = subprocess.run([sys.executable, "-B", script, self.root / "out/report.h5", folder],
                                  capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            index = json.loads((folder / "index.json").read_text(encoding="utf-8"))
            self.assertEqual([figure["name"] for figure in index["figures"]], expected)
            with h5py.File(self.root / "out/report.h5", "a") as file:
                if "cases" in file:
                    del file["cases"]


if __name__ == "__main__":
    unittest.main()
