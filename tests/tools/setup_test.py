"""The scripts under tools/ in an environment of stubs: what they install, what they say, how they exit.

Usage: setup_test.py SOURCE_DIR [unittest arguments]
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ["tools/setup", "tools/run", "tools/test", "tools/format", "tools/build_steps.sh", ".ci/run"]
# What the scripts call from a bare system: these are the machine's own, all else is a stub or absent.
SYSTEM = "bash env sed tail head cat tr wc mkdir dirname grep tee find xargs getconf awk".split()

DPKG_QUERY = """#!/bin/bash
for name in "$@"; do
  case "$name" in -*) continue ;; esac
  if grep -qx "$name" "$STUBS/installed"; then printf 'installed %s\\n' "$name"; else status=1; fi
done
exit ${status:-0}
"""

APT_GET = """#!/bin/bash
printf '%s | %s\\n' "${DEBIAN_FRONTEND:-}" "$*" >>"$STUBS/apt_calls"
if [[ -e $STUBS/apt_broken ]]; then echo 'E: Unable to fetch some archives'; exit 100; fi
installing=no
for word in "$@"; do
  [[ $word == -* || $installing == no ]] || printf '%s\\n' "$word" >>"$STUBS/installed"
  [[ $word != install ]] || installing=yes
done
"""


def packages():
    """(name, needed or optional, purpose) of each row of the table in tools/setup."""
    row = re.compile(r"^([a-z0-9+-]+) *\| *(needed|optional) *\| [^|]* \| (.*)$", re.M)
    rows = row.findall((SOURCE / "tools/setup").read_text())
    return [(name, need, purpose.strip()) for name, need, purpose in rows]


class Stubs(unittest.TestCase):
    """A copy of the scripts in a root of their own, and a PATH that holds nothing but stubs and a few system tools."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.root = pathlib.Path(directory.name) / "a checkout"
        self.stubs = pathlib.Path(directory.name) / "stubs"
        self.stubs.mkdir()
        for script in SCRIPTS + ["CMakePresets.json"]:
            (self.root / script).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / script, self.root / script)
        for tool in SYSTEM:
            (self.stubs / tool).symlink_to(shutil.which(tool))
        self.stub("dpkg-query", DPKG_QUERY)
        self.stub("apt-get", APT_GET)
        self.user("1000")
        self.system("ID=debian\nVERSION_ID=12\n")
        self.installed(name for name, _, _ in packages())

    def stub(self, name, text="#!/bin/bash\n"):
        path = self.stubs / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def user(self, number):
        self.stub("id", f"#!/bin/bash\necho {number}\n")

    def system(self, release):
        (self.stubs / "os-release").write_text(release)

    def installed(self, names):
        (self.stubs / "installed").write_text("".join(f"{name}\n" for name in names))

    def all_but(self, *absent):
        self.installed(name for name, _, _ in packages() if name not in absent)

    def apt_calls(self):
        path = self.stubs / "apt_calls"
        return path.read_text().splitlines() if path.exists() else []

    def call(self, script, *arguments):
        environment = {
            "PATH": str(self.stubs),
            "STUBS": str(self.stubs),
            "XPRIMERAY_OS_RELEASE": str(self.stubs / "os-release"),
            "XPRIMERAY_PYTHON": str(self.stubs / "python3"),
        }
        command = [self.root / script, *arguments]
        return subprocess.run(command, env=environment, cwd=self.root, capture_output=True, text=True, check=False)


class Setup(Stubs):
    def test_the_table_is_read(self):
        # Guards the other tests here: an empty table would let them pass.
        self.assertIn(("libhdf5-dev", "needed", "report.h5 and ray tables"), packages())
        self.assertGreater(len(packages()), 25)

    def test_check_names_each_missing_package_and_its_purpose(self):
        self.all_but("libhdf5-dev", "ninja-build")
        done = self.call("tools/setup", "--check")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"missing: libhdf5-dev +report\.h5 and ray tables\n")
        self.assertRegex(done.stderr, r"missing: ninja-build +runs the build\n")
        self.assertEqual(done.stderr.count("missing: "), 2)
        self.assertRegex(done.stderr, r"2 needed packages .* install \S+ ninja-build libhdf5-dev\n$")

    def test_every_needed_package_is_noticed_when_missing(self):
        self.installed([])
        done = self.call("tools/setup", "--check")
        for name, need, purpose in packages():
            with self.subTest(name):
                line = rf"missing: {re.escape(name)} +{re.escape(purpose)}\n"
                self.assertEqual(len(re.findall(line, done.stderr)), need == "needed")

    def test_missing_optional_packages_only_warn(self):
        self.all_but("clang", "clang-format", "ccache")
        done = self.call("tools/setup", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("optional, not found"), 3)

    def test_all_there_is_silent_when_quiet_and_never_calls_apt(self):
        self.user("0")
        done = self.call("tools/setup", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.apt_calls(), [])

    def test_root_installs_what_is_missing_and_only_that_without_prompts(self):
        self.user("0")
        self.all_but("libhdf5-dev", "cmake", "ccache")
        done = self.call("tools/setup")
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = self.apt_calls()
        self.assertEqual([bool(re.search(r" (update|install) ?", call)) for call in calls], [True] * 3)
        self.assertTrue(all(call.startswith("noninteractive | ") for call in calls))
        self.assertTrue(calls[0].endswith(" update"))
        self.assertTrue(calls[1].endswith(" install --no-install-recommends cmake libhdf5-dev"))
        self.assertTrue(calls[2].endswith(" install --no-install-recommends ccache"))

    def test_check_never_installs(self):
        self.user("0")
        self.all_but("cmake")
        self.assertEqual(self.call("tools/setup", "--check").returncode, 2)
        self.assertEqual(self.apt_calls(), [])

    def test_passwordless_sudo_installs_too(self):
        self.stub("sudo", '#!/bin/bash\n[[ $1 == -n ]] || exit 1\nshift\n[[ $1 == true ]] || exec "$@"\n')
        self.all_but("cmake")
        self.assertEqual(self.call("tools/setup").returncode, 0)
        self.assertEqual(len(self.apt_calls()), 2)

    def test_sudo_that_wants_a_password_is_not_asked(self):
        self.stub("sudo", "#!/bin/bash\nexit 1\n")
        self.all_but("cmake")
        self.assertEqual(self.call("tools/setup").returncode, 2)
        self.assertEqual(self.apt_calls(), [])

    def test_a_failed_installation_says_why_and_where_the_log_is(self):
        self.user("0")
        self.all_but("cmake")
        (self.stubs / "apt_broken").touch()
        done = self.call("tools/setup")
        self.assertEqual(done.returncode, 2)
        self.assertIn("Unable to fetch some archives", done.stderr)
        self.assertIn("build/logs/setup.log", done.stderr)
        self.assertIn("1 needed packages are missing", done.stderr)

    def test_another_system_is_probed_by_commands_headers_and_modules(self):
        self.system("ID=fedora\nVERSION_ID=40\n")
        self.user("0")
        for command in "cmake ninja pkg-config git nm clang++ clang-format ccache".split():
            self.stub(command)
        # A compiler that finds every header but HDF5's, a Python that has every module but h5py.
        self.stub("c++", '#!/bin/bash\n! grep -q hdf5\n')
        self.stub("python3", '#!/bin/bash\n[[ $2 != *h5py* ]]\n')
        done = self.call("tools/setup")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(re.findall(r"missing: (\S+)", done.stderr), ["libhdf5-dev", "python3-h5py"])
        # Like a compiler, it reads what it is piped: one that ends before could break the pipe (2026-11-22).
        self.stub("c++", "#!/bin/bash\ncat >/dev/null\n")
        self.stub("python3")
        self.assertEqual(self.call("tools/setup").returncode, 0)
        self.assertEqual(self.apt_calls(), [])

    def test_an_unknown_argument_is_refused(self):
        done = self.call("tools/setup", "--chek")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'--chek'", done.stderr)


class RunAndTest(Stubs):
    def setUp(self):
        super().setUp()
        self.stub("cmake", '#!/bin/bash\necho "$*" >>"$STUBS/cmake_calls"\n')
        self.stub("ctest", '#!/bin/bash\necho "ctest $*"\nexit 8\n')
        program = self.root / "build/release/bin/xprimeray"
        program.parent.mkdir(parents=True)
        program.write_text('#!/bin/bash\nprintf "<%s>" "$@"\nexit 4\n')
        program.chmod(0o755)

    def test_run_builds_one_target_and_passes_the_exit_code_on(self):
        done = self.call("tools/run")
        self.assertEqual(done.returncode, 4)
        self.assertEqual(done.stdout, "<validate><--suite><quick><--out><build/report/quick>")
        self.assertRegex((self.stubs / "cmake_calls").read_text(), r"--build --preset release .*--target xprimeray\n")

    def test_run_gives_no_default_for_a_flag_that_is_given(self):
        full = self.call("tools/run", "--suite", "full").stdout
        self.assertEqual(full, "<validate><--out><build/report/full><--suite><full>")
        elsewhere = self.call("tools/run", "--out=a b").stdout
        self.assertEqual(elsewhere, "<validate><--suite><quick><--out=a b>")

    def test_test_ends_with_ctest_and_its_exit_code(self):
        done = self.call("tools/test", "-L", "metrics")
        self.assertEqual(done.returncode, 8)
        self.assertRegex(done.stdout, r"ctest --preset release --parallel \d+ -L metrics\n$")

    def test_test_takes_another_preset_and_refuses_an_unknown_one(self):
        self.assertIn("ctest --preset asan", self.call("tools/test", "--preset", "asan").stdout)
        done = self.call("tools/test", "--preset=assan")
        self.assertEqual(done.returncode, 2)
        self.assertIn("known: release clang debug asan tsan", done.stderr)

    def test_a_broken_build_shows_the_cause_and_the_log(self):
        output = "[1/9] one\\n[7/9] two\\nFAILED: kerr.o\\nkerr.hpp:7: error: no sine\\n"
        self.stub("cmake", f"#!/bin/bash\n[[ $1 != --build ]] || {{ printf '{output}'; seq 200; exit 3; }}\n")
        (self.stubs / "seq").symlink_to(shutil.which("seq"))
        done = self.call("tools/test")
        self.assertEqual(done.returncode, 3)
        self.assertIn("kerr.hpp:7: error: no sine", done.stderr)
        self.assertIn("build/logs/build-release.log", done.stderr)
        self.assertIn("build-release: 7 of 9", done.stdout)
        self.assertNotIn("ctest", done.stdout)

    def test_nothing_is_built_where_packages_are_missing(self):
        self.all_but("libmpfr-dev")
        self.assertEqual(self.call("tools/run").returncode, 2)
        self.assertFalse((self.stubs / "cmake_calls").exists())

    def test_ci_fails_on_formatting_alone(self):
        self.stub("ctest", "#!/bin/bash\nexit 0\n")
        (self.root / "a.cpp").write_text("good\n")
        self.stub("clang-format", CLANG_FORMAT.format(version="14.0.6"))
        self.assertEqual(self.call(".ci/run").returncode, 0)
        (self.root / "a.cpp").write_text("bad\n")
        self.assertEqual(self.call(".ci/run").returncode, 1)


CLANG_FORMAT = """#!/bin/bash
[[ $1 != --version ]] || {{ echo 'Debian clang-format version {version}'; exit; }}
for word in "$@"; do [[ $word == -* ]] || ! grep -q bad "$word" || exit 1; done
"""


class Format(Stubs):
    def setUp(self):
        super().setUp()
        (self.root / "a.hpp").write_text("bad\n")

    def test_without_clang_format_it_says_that_it_skipped(self):
        done = self.call("tools/format", "--check")
        self.assertEqual(done.returncode, 0)
        self.assertIn("SKIPPED", done.stderr)

    def test_another_version_is_not_trusted(self):
        self.stub("clang-format", CLANG_FORMAT.format(version="16.0.1"))
        self.assertIn("SKIPPED", self.call("tools/format", "--check").stderr)

    def test_a_difference_fails(self):
        self.stub("clang-format", CLANG_FORMAT.format(version="14.0.6"))
        self.assertEqual(self.call("tools/format", "--check").returncode, 1)
        (self.root / "a.hpp").write_text("good\n")
        self.assertEqual(self.call("tools/format", "--check").returncode, 0)


class Files(unittest.TestCase):
    def test_every_script_parses_and_runs_as_a_program(self):
        for script in SCRIPTS:
            with self.subTest(script):
                subprocess.run(["bash", "-n", SOURCE / script], check=True)
                self.assertEqual(os.access(SOURCE / script, os.X_OK), not script.endswith(".sh"))

    def test_the_citation_names_the_version_that_is_built(self):
        built = re.search(r"project\(xprimeray VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)
        cited = re.search(r"^version: (\S+)$", (SOURCE / "CITATION.cff").read_text(), re.M).group(1)
        self.assertEqual(cited, built)


if __name__ == "__main__":
    unittest.main()
