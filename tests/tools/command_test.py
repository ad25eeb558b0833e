#!/usr/bin/env python3
"""The xprimeray command as a user meets it: what it prints, its exit codes, what it leaves on the disk.

Usage: command_test.py PATH_OF_XPRIMERAY [unittest arguments]
"""

import json
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy

XPRIMERAY = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else ""
HEADER = "id,x0,x1,x2,x3,p0,p1,p2,p3"
OUT_HEADER = (
    "id,status,sheet,x0,x1,x2,x3,p0,p1,p2,p3,lambda,steps,rejected,null_residual,null_residual_max"
)
KERR = ["trace", "--metric", "kerr", "--set", "a=0.9", "--set", "M=1", "--chart", "boyer-lindquist"]
FLAT = ["trace", "--metric", "minkowski", "--chart", "cartesian"]


def kerr_ray(number, r, theta, p_theta, angular_momentum, a=0.9, mass=1.0):
    """A line of a ray table: E = 1, going inward, in Boyer-Lindquist coordinates; p_r from H = 0."""
    delta = r * r - 2 * mass * r + a * a
    potential = (r * r + a * a - a * angular_momentum) ** 2
    carter = p_theta**2 + math.cos(theta) ** 2 * (angular_momentum**2 / math.sin(theta) ** 2 - a * a)
    radial = potential - delta * (carter + (angular_momentum - a) ** 2)
    p_r = -math.sqrt(radial) / delta
    return f"{number},0,{r!r},{theta!r},0,-1,{p_r!r},{p_theta!r},{angular_momentum!r}"


def flat_ray(number, x=0.0):
    return f"{number},0,{x!r},0.5,0,-1,1,0,0"


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xprimeray-command-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, lines):
        with open(self.path(name), "w", encoding="utf-8", newline="") as file:
            file.write("\n".join(lines) + "\n")
        return self.path(name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def run_command(self, *arguments, **options):
        return subprocess.run(
            [XPRIMERAY, *arguments], capture_output=True, text=True, timeout=300, check=False, **options
        )

    def succeed(self, *arguments, **options):
        done = self.run_command(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, *arguments, says, code=2, **options):
        """The command fails with one clear line and leaves no file that was not there before."""
        before = sorted(os.listdir(self.folder))
        done = self.run_command(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        return done

    def trace(self, arguments, lines, out="out.csv", *more):
        return [*arguments, "--rays", self.write("in.csv", lines), "--out", self.path(out), *more]


class Trace(CommandTest):
    def rays(self):
        cases = [(30.0, 1.2, 0.5, 1.0), (30.0, 1.2, 0.5, 6.0), (30.0, 2.0, -3.0, -7.5), (20.0, 1.57, 0.0, 2.9)]
        return [HEADER] + [kerr_ray(10 - k, *case) for k, case in enumerate(cases)]

    def test_the_example_of_the_help_works(self):
        arguments = self.trace(
            [*KERR, "--method", "dop853", "--tol", "1e-12", "--r-max", "100", "--r-min", "1.5"], self.rays()
        )
        done = self.succeed(*arguments)
        self.assertIn("4 rays", done.stdout)
        self.assertEqual(done.stderr, "")
        lines = self.read("out.csv").splitlines()
        self.assertEqual(lines[0], OUT_HEADER)
        self.assertEqual([line.split(",")[0] for line in lines[1:]], ["10", "9", "8", "7"])
        radius_at = {"escaped": 100.0, "captured": 1.5}
        for line, start in zip(lines[1:], self.rays()[1:]):
            row = dict(zip(OUT_HEADER.split(","), line.split(",")))
            self.assertIn(row["status"], radius_at)
            # The stop is met to the tolerance; E and L_z are constants of the motion.
            self.assertAlmostEqual(float(row["x1"]), radius_at[row["status"]], delta=1e-9)
            self.assertAlmostEqual(float(row["p0"]), -1.0, delta=1e-9)
            self.assertAlmostEqual(float(row["p3"]), float(start.split(",")[8]), delta=1e-9)
            self.assertLess(float(row["null_residual"]), 1e-9)
            self.assertEqual(row["sheet"], "1")
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.csv", "out.csv", "out.csv.meta.json"])

    def test_the_settings_stand_beside_the_table(self):
        self.succeed(*self.trace(KERR, self.rays()))
        meta = json.loads(self.read("out.csv.meta.json"))
        configuration = meta["configuration"]
        self.assertEqual(configuration["metric"], "kerr")
        self.assertEqual(configuration["set"], {"M": 1.0, "a": 0.9})
        self.assertEqual(configuration["chart"], "boyer-lindquist")
        self.assertEqual(configuration["method"], "dopri54")
        self.assertEqual(configuration["lambda-max"], "inf")
        self.assertGreater(configuration["r-min"], 1.4358)
        self.assertEqual(sum(meta["status"].values()), meta["rays"])
        self.assertRegex(meta["rays_hash"], "^[0-9a-f]{32}$")
        for key in ["version", "commit", "compiler", "flags", "cpu", "date"]:
            self.assertTrue(meta["volatile"]["provenance"][key])
            self.assertNotIn("/", meta["volatile"]["provenance"][key])  # no path of the machine that built it

    def test_hdf5_and_csv_hold_the_same_bits(self):
        self.succeed(*self.trace(KERR, self.rays()))
        self.succeed(*self.trace(KERR, self.rays(), "out.h5"))
        hashes = [json.loads(self.read(name + ".meta.json"))["rays_hash"] for name in ["out.csv", "out.h5"]]
        self.assertEqual(hashes[0], hashes[1])
        lines = self.read("out.csv").splitlines()
        with h5py.File(self.path("out.h5"), "r") as file:
            rays = file["rays"]
            self.assertEqual(sorted(rays), sorted(OUT_HEADER.split(",")))
            self.assertEqual(rays.attrs["metric"], "kerr")
            self.assertEqual(json.loads(rays.attrs["parameters"]), {"M": 1.0, "a": 0.9})
            self.assertEqual(rays.attrs["chart"], "boyer-lindquist")
            self.assertEqual(rays.attrs["schema"], "xprimeray/traced-rays")
            self.assertEqual(rays["x2"].attrs["units"], "radian")
            self.assertEqual(rays["x1"].attrs["units"], "1")
            self.assertTrue(rays["p3"].attrs["long_name"])
            names = {code: name for name, code in h5py.check_enum_dtype(rays["status"].dtype).items()}
            for k, line in enumerate(lines[1:]):
                for name, text in zip(lines[0].split(","), line.split(",")):
                    value = rays[name][k]
                    if name == "status":
                        self.assertEqual(names[value], text)
                    else:
                        self.assertEqual(value, float(text), name)

    def test_hdf5_comes_in_too(self):
        self.succeed(*self.trace(KERR, self.rays()))
        table = numpy.genfromtxt(self.path("in.csv"), delimiter=",", names=True)
        with h5py.File(self.path("in.h5"), "w") as file:
            for name in HEADER.split(","):
                file.create_dataset(f"rays/{name}", data=table[name].astype("i8" if name == "id" else "f8"))
            file["rays"].attrs["chart"] = "boyer-lindquist"
        common = ["trace", "--metric", "kerr", "--set", "a=0.9", "--rays", self.path("in.h5")]
        self.succeed(*common, "--out", self.path("from_h5.csv"))  # the table says which chart
        self.assertEqual(self.read("from_h5.csv"), self.read("out.csv"))
        self.refuse(*common, "--chart", "kerr-schild", "--out", self.path("x.csv"), says="chart 'boyer-lindquist'")
        with open(self.path("in.h5"), "rb") as file:
            whole = file.read()
        with open(self.path("short.h5"), "wb") as file:
            file.write(whole[: len(whole) * 2 // 3])
        self.refuse(
            *KERR, "--rays", self.path("short.h5"), "--out", self.path("x.csv"), says=["short.h5", "truncated"]
        )
        with h5py.File(self.path("flat.h5"), "w") as file:
            file.create_dataset("rays/id", data=numpy.zeros((2, 2), dtype="i8"))
        self.refuse(*KERR, "--rays", self.path("flat.h5"), "--out", self.path("x.csv"), says="2 dimensions")
        with h5py.File(self.path("single.h5"), "w") as file:
            for name in HEADER.split(","):
                file.create_dataset(f"rays/{name}", data=table[name].astype("i8" if name == "id" else "f4"))
        self.refuse(*KERR, "--rays", self.path("single.h5"), "--out", self.path("x.csv"), says="float32, needs float64")

    def test_threads_do_not_change_a_byte(self):
        lines = [HEADER] + [kerr_ray(k, 30.0, 1.2, 0.5, -8 + 0.16 * k) for k in range(100)]
        self.succeed(*self.trace(KERR, lines, "one.csv", "--threads", "1"))
        self.succeed(*self.trace(KERR, lines, "two.csv", "--threads", "2"))
        self.assertEqual(self.read("one.csv"), self.read("two.csv"))

    def test_a_ray_off_the_light_cone_is_refused_or_renormalised(self):
        fields = self.rays()[1].split(",")
        fields[5] = "-1.01"
        lines = [HEADER, ",".join(fields)]
        self.refuse(*self.trace(KERR, lines), says=["line 2, id 10: off the light cone", "0.0", "--renormalise"])
        self.succeed(*self.trace(KERR, lines, "out.csv", "--renormalise"))
        row = self.read("out.csv").splitlines()[1].split(",")
        self.assertAlmostEqual(float(row[7]), -1.0, delta=1e-9)

    def test_a_start_that_physics_does_not_admit_is_a_row(self):
        lines = self.rays()[:2] + ["11,0,-4,1.2,0,-1,0,0,0"]
        done = self.succeed(*self.trace(KERR, lines))
        self.assertIn("1 outside_domain", done.stdout)
        row = self.read("out.csv").splitlines()[2]
        self.assertTrue(row.startswith("11,outside_domain,1,0,-4,1.2,0,-1,0,0,0,0,0,0,nan,nan"), row)

    def test_malformed_tables_are_refused_whole(self):
        good = self.rays()
        for lines, says in [
            ([HEADER.replace(",p3", ""), "1,0,10,1,0,-1,-1,0"], "line 1: column 'p3' is missing"),
            ([HEADER + ",sheets", good[1] + ",1"], "did you mean 'sheet'?"),
            ([HEADER + ",x1", good[1] + ",1"], "appears twice"),
            (good + ["11,0,10,1,0,-1,-1,0"], "line 6: has 8 fields where the header has 9"),
            (good + ["11,0,nan,1,0,-1,-1,0,1"], "line 6, column x1: 'nan'"),
            (good + ["11,0,inf,1,0,-1,-1,0,1"], "line 6, column x1: 'inf'"),
            (good + ["11,0,,1,0,-1,-1,0,1"], "line 6, column x1: ''"),
            (good + ["11.5,0,10,1,0,-1,-1,0,1"], "line 6, column id: '11.5' is not an integer"),
            (good + [good[2]], "lines 3 and 6 have the same id 9"),
            (good + ['11,"0,10'], "a quoted field is not closed"),
            ([], "column"),
        ]:
            with self.subTest(says):
                self.write("in.csv", lines)
                self.refuse(*self.trace(KERR, lines), says=["in.csv", says])
        os.remove(self.path("in.csv"))
        self.refuse(*KERR, "--rays", self.path("in.csv"), "--out", self.path("out.csv"), says="No such file")

    def test_wrong_settings_name_what_would_be_right(self):
        self.write("in.csv", self.rays())
        files = ["--rays", self.path("in.csv"), "--out", self.path("out.csv")]
        for arguments, says in [
            (["--metric", "kerrr"], "did you mean 'kerr'?"),
            (["--metric", "kerr", "--chart", "boyer-lindqvist"], "did you mean 'boyer-lindquist'?"),
            (["--metric", "kerr", "--transport-chart", "kerr-shild"], "did you mean 'kerr-schild'?"),
            (["--metric", "kerr", "--method", "dop835"], "did you mean 'dop853'?"),
            (["--metric", "kerr", "--project", "momenta"], "did you mean 'momentum'?"),
            (["--metric", "kerr", "--set", "a=1.2"], "1.2"),
            (["--metric", "kerr", "--set", "M=0"], "M"),
            (["--metric", "ellis", "--set", "b0=-1"], "b0"),
            (["--metric", "kerr", "--set", "spin=0.5"], "unknown parameter 'spin'"),
            (["--metric", "kerr", "--set", "a"], "needs name=number"),
            (["--metric", "kerr", "--set", "a=0.9x"], "needs name=number"),
            (["--metric", "kerr", "--set", "a=0.1", "--set", "a=0.2"], "set twice"),
            (["--metric", "kerr", "--tol", "0"], "needs 0 < tol < 1"),
            (["--metric", "kerr", "--tol", "tight"], "tol"),
            (["--metric", "kerr", "--max-steps", "0"], "max-steps"),
            (["--metric", "kerr", "--threads", "-1"], "--threads"),
            (["--metric", "kerr", "--l-min", "-5"], "no throat"),
            (["--metric", "kerr", "--tolerance", "1e-8"], "unknown option '--tolerance'"),
            (["--metric", "kerr", "stray"], "unexpected argument 'stray'"),
        ]:
            with self.subTest(says):
                self.refuse("trace", *files, *arguments, says=says)
        self.refuse("trace", *files, says="--metric is missing")
        self.refuse(*KERR, "--out", self.path("out.csv"), says="--rays is missing")
        self.refuse(*KERR, "--rays", self.path("in.csv"), says="--out is missing")
        self.refuse(*KERR, *files[:2], "--out", self.path("out.txt"), says="ends in .csv or .h5")

    def test_a_configuration_file_serves_and_a_flag_beats_it(self):
        config = self.write("run.toml", ['metric = "kerr"', 'chart = "boyer-lindquist"', "tol = 1e-6", 'method = "dop853"',
                                         "renormalise = true", "r-max = 100", "[set]", "a = 0.5", "M = 1"])
        self.succeed(*self.trace(["trace", "--config", config, "--tol", "1e-9", "--set", "a=0.9"], self.rays()))
        configuration = json.loads(self.read("out.csv.meta.json"))["configuration"]
        self.assertEqual(configuration["method"], "dop853")
        self.assertEqual(configuration["tol"], 1e-9)
        self.assertEqual(configuration["set"], {"M": 1.0, "a": 0.9})
        self.assertEqual(configuration["r-max"], 100.0)
        self.assertIs(configuration["renormalise"], True)
        for lines, says in [
            (["methd = 'rk4'"], "line 1: unknown key 'methd'; did you mean 'method'?"),
            (["tol = 'tight'"], "line 1"),
            (["tol = "], "line 1"),
            (["", "[tol]", "a = 1"], "tol is no table"),
            (["[set]", "a = [1, 2]"], "set needs a number"),
        ]:
            with self.subTest(says):
                self.write("bad.toml", lines)
                arguments = self.trace([*KERR, "--config", self.path("bad.toml")], self.rays())
                self.refuse(*arguments, says=["bad.toml", says])
        self.refuse(*self.trace([*KERR, "--config", self.path("no.toml")], self.rays()), says="No such file")

    def test_output_that_cannot_be_written_is_refused_before_the_work(self):
        self.refuse(*self.trace(KERR, self.rays(), "absent/out.csv"), says=["absent", "No such file or directory"])
        os.mkdir(self.path("folder.csv"))
        self.refuse(*self.trace(KERR, self.rays(), "folder.csv"), says="is a directory")
        os.mkdir(self.path("locked"), 0o555)
        if os.geteuid() == 0:  # root may write anywhere but here
            self.refuse(*self.trace(KERR, self.rays(), "/proc/out.csv"), says="/proc/out.csv")
        else:
            self.refuse(*self.trace(KERR, self.rays(), "locked/out.csv"), says="Permission denied")

    def test_a_full_disk_is_a_fault_and_leaves_nothing(self):
        arguments = self.trace(FLAT, [HEADER] + [flat_ray(k) for k in range(9000)], "out.csv")
        self.refuse(*arguments[:-1], "/dev/full", says=["/dev/full", "No space left on device"], code=3)

        # A limit on the size of files fails the same write call in a file of our own.
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))

        # HDF5 cannot free what it cannot write: a leak checker would see that and end with a code of its own.
        no_leak_check = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
        for name in ["out.csv", "out.h5"]:
            with self.subTest(name):
                refused = [*arguments[:-1], self.path(name)]
                self.refuse(
                    *refused, says=["out", "File too large"], code=3, preexec_fn=small_files, env=no_leak_check
                )

    def test_a_pipe_gets_the_table_and_nothing_else(self):
        done = self.succeed(*self.trace(KERR, self.rays())[:-1], "/dev/stdout", "--quiet")
        self.assertEqual(done.stdout.splitlines()[0], OUT_HEADER)
        self.assertEqual(len(done.stdout.splitlines()), 5)
        self.assertEqual(os.listdir(self.folder), ["in.csv"])

    def test_json_and_quiet(self):
        done = self.succeed(*self.trace(KERR, self.rays(), "out.csv", "--json"))
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual(events[-1]["event"], "end")
        self.assertEqual(events[-1]["rays"], 4)
        self.assertEqual(self.succeed(*self.trace(KERR, self.rays(), "out.csv", "--quiet")).stdout, "")

    def test_ctrl_c_leaves_the_earlier_output_as_it_was(self):
        lines = [HEADER] + [kerr_ray(k, 30.0, 1.2, 0.5, 6.0) for k in range(20_000)]
        arguments = self.trace([*KERR, "--method", "rk4", "--step", "0.001"], lines)
        self.write("out.csv", ["earlier"])
        before = sorted(os.listdir(self.folder))
        with subprocess.Popen([XPRIMERAY, *arguments], stderr=subprocess.PIPE, text=True) as process:
            while sorted(os.listdir(self.folder)) == before:
                self.assertIsNone(process.poll())
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            message = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130)
        self.assertIn("interrupted", message)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.assertEqual(self.read("out.csv"), "earlier\n")

    def test_memory_does_not_grow_with_the_table(self):
        # A child's peak counts what its parent had before exec, so a small process does the measuring.
        measure = (
            "import os, subprocess, sys\n"
            "child = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)\n"
            "_, status, usage = os.wait4(child.pid, 0)\n"
            "print(usage.ru_maxrss / 1024)\n"
            "sys.exit(status != 0)\n"
        )
        # A sanitizer that holds back what is freed would be measured instead.
        environment = {**os.environ, "ASAN_OPTIONS": "quarantine_size_mb=1"}
        peaks = {}
        for count in [30_000, 300_000]:
            with open(self.path("rays.csv"), "w", encoding="utf-8") as file:
                file.write(HEADER + "\n")
                file.writelines(flat_ray(k, 0.001 * k) + "\n" for k in range(count))
            command = [XPRIMERAY, *FLAT, "--method", "euler", "--step", "1e9", "--rays", self.path("rays.csv")]
            for name in ["out.csv", "out.h5"]:
                measured = subprocess.run(
                    [sys.executable, "-S", "-c", measure, *command, "--out", self.path(name)],
                    capture_output=True, text=True, check=True, timeout=300, env=environment,
                )
                peaks[count, name] = float(measured.stdout)
            self.assertEqual(self.read("out.csv").count("\n"), count + 1)
        for name in ["out.csv", "out.h5"]:
            # MiB. The larger table is 12 MB of text; what may grow are the ids, 8 bytes a ray (2 MiB), and HDF5's index.
            self.assertLess(peaks[300_000, name] - peaks[30_000, name], 6)


class Sweep(CommandTest):
    SMALL = ["sweep", "--metric", "schwarzschild", "--methods", "rk4,dop853", "--rays", "4", "--from", "1e-6",
             "--to", "1e-8", "--step-from", "0.5", "--step-to", "0.25"]

    def test_prints_a_line_for_every_setting(self):
        lines = self.succeed(*self.SMALL).stdout.splitlines()
        self.assertIn("truth: closed form", lines[0])
        self.assertEqual([line.split()[0] for line in lines[2:7]], ["rk4"] * 2 + ["dop853"] * 3)

    def test_json_points_carry_errors_costs_and_orders(self):
        lines = [json.loads(line) for line in self.succeed(*self.SMALL, "--json").stdout.splitlines()]
        points = [line for line in lines if line["event"] == "point"]
        self.assertEqual(len(points), 5)
        self.assertEqual([point.get("tol") for point in points[2:]], [1e-6, 1e-7, 1e-8])
        # The order of RK4 between steps of 1/2 and 1/4 M, near the hole not yet in its clean regime.
        self.assertAlmostEqual(points[1]["observed_order"], 4.0, delta=0.3)
        for point in points:
            self.assertGreater(point["evaluations_per_ray"], 0)
        self.assertEqual(lines[-1]["event"], "end")

    def test_the_report_holds_the_curves_and_repeats_to_the_bit(self):
        hashes = set()
        for name, threads in (("a", "1"), ("b", "2")):
            done = self.succeed(*self.SMALL, "--json", "--out", self.path(name), "--threads", threads)
            end = json.loads(done.stdout.splitlines()[-1])
            hashes.add((end["rays_hash"], end["report_hash"]))
            with h5py.File(os.path.join(self.path(name), "report.h5")) as file:
                self.assertEqual(sorted(file["sweeps/schwarzschild"]), ["dop853", "rk4"])
        self.assertEqual(len(hashes), 1)

    def test_wrong_requests_name_what_would_be_right(self):
        for arguments, says in (
            (["--metric", "kerrr"], "did you mean 'kerr'?"),
            (["--metric", "medium-uniform"], "no rays and no truth"),
            (["--methods", "dopri45"], "did you mean 'dopri54'?"),
            (["--methods", "verlet"], "does not separate"),
            (["--set", "a=1.2"], "spin a = 1.2"),
            (["--from", "1e-12", "--to", "1e-4"], "needs 1 > from >= to > 0"),
            (["--rays", "0"], "0 rays"),
        ):
            with self.subTest(arguments):
                self.refuse("sweep", *arguments, says=says)


class OtherCommands(CommandTest):
    def test_every_help_has_an_example(self):
        names = [line.split()[0] for line in self.succeed("--help").stdout.split("Subcommands:")[1].splitlines()
                 if line.startswith("  ") and line.strip() and not line.startswith("   ")]
        names = [name for name in names if name != "xprimeray"]
        self.assertIn("trace", names)
        for name in names:
            with self.subTest(name):
                self.assertIn(f"Example:\n  xprimeray {name}", self.succeed(name, "--help").stdout)

    def test_unknown_subcommands_and_options_name_the_nearest(self):
        self.refuse("trcae", says="unknown subcommand 'trcae'; did you mean 'trace'?")
        self.refuse("list", "--quite", says="did you mean '--quiet'?")
        self.refuse(says="subcommand is required")

    def test_list_names_everything_that_has_an_id(self):
        everything = self.succeed("list").stdout
        for word in ["kerr", "boyer-lindquist", "dop853", "ellis", "metrics", "methods", "cases", "faults"]:
            self.assertIn(word, everything)
        self.refuse("list", "metrix", says="did you mean 'metrics'?")
        for line in self.succeed("list", "methods", "--json").stdout.splitlines():
            self.assertEqual(json.loads(line)["list"], "methods")

    def test_explain_knows_every_id_that_list_prints(self):
        for what in ["metrics", "methods", "cases", "faults"]:
            for line in self.succeed("list", what, "--json").stdout.splitlines():
                identifier = json.loads(line)["id"]
                with self.subTest(identifier):
                    self.assertIn(identifier, self.succeed("explain", identifier).stdout)
        self.refuse("explain", "kerrr", says="did you mean 'kerr'?")

    def test_doctor_says_what_the_build_is(self):
        text = self.succeed("doctor").stdout
        for word in ["build", "isa", "arithmetic", "threads", "hdf5", "figures"]:
            self.assertIn(word, text)
        for line in self.succeed("doctor", "--json").stdout.splitlines():
            self.assertIn(json.loads(line)["health"], ["ok", "missing"])

    def test_a_full_standard_output_is_a_fault(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([XPRIMERAY, "list"], stdout=full, stderr=subprocess.PIPE, check=False, timeout=60)
        self.assertEqual(done.returncode, 3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
