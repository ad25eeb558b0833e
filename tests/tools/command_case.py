"""What tests of the xprimeray command share: the program under test, a folder of its own, runs and refusals."""

import os
import subprocess
import sys
import tempfile
import unittest

XPRIMERAY = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else ""


class CommandCase(unittest.TestCase):
    """A test in an empty folder, which is the program's working directory. `prefix` precedes every command line."""

    prefix = ()

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xprimeray-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_command(self, *arguments):
        return subprocess.run([XPRIMERAY, *self.prefix, *arguments], capture_output=True, text=True, check=False,
                              timeout=300, cwd=self.folder)

    def succeed(self, *arguments):
        run = self.run_command(*arguments)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run

    def refused(self, *arguments, code=2):
        """One clear line, the exit code, and nothing written. Returns the line."""
        before = sorted(os.listdir(self.folder))
        run = self.run_command(*arguments)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        return run.stderr
