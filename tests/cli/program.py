"""Runs the program as a user would: in a folder of its own, by its command line alone.

RECKON_PROGRAM names the program."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RECKON_PROGRAM"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]

# A short run of everything. A test adds keys to it, or overrides them.
SHORT = """\
description: A short circle
duration_s: 2
motion: {path: circle, radius_m: 3, start_s: 0.2}
estimators:
  riekf: {type: inekf}
  mekf: {type: mekf}
"""

# Drives straight off a small map, after about 3 s.
OFF_THE_MAP = """\
duration_s: 20
world: {terrain: {kind: flat, half_size_m: 2}}
motion: {path: velocity_profile, start_s: 0, profile: [[0, 1, 0]]}
estimators: {riekf: {type: inekf}}
"""

# No filter is right to a nanometre from an initial error of a centimetre.
IMPOSSIBLE = "expect:\n  riekf: {ate_position_rmse_m: {max: 1.0e-9}}\n"


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, which goes away."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="reckon_cli_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name, text=SHORT):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return name

    def environment(self, changes):
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("NO_COLOR", "RECKON_HOME")}
        return {**environment, **changes}

    def call(self, *arguments, environment=None, **options):
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                              env=self.environment(environment or {}), timeout=300, **options)

    def run_ok(self, *arguments, **options):
        done = self.call("run", *arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return done

    def result(self, name="short", seed=1, out="out"):
        return self.folder / out / name / f"seed_{seed:05}"

    def run_json(self, **where):
        return json.loads((self.result(**where) / "run.json").read_text())

    def assertRefused(self, done, *patterns):
        """The input is wrong: code 2, stdout empty, and the message says what is expected of it."""
        self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
        self.assertEqual(done.stdout, "")
        for pattern in patterns:
            self.assertRegex(done.stderr, pattern)

    def assertNothingLeft(self, out="out"):
        """No file at all below the results folder."""
        self.assertEqual(files_in(self.folder / out), {})


def files_in(folder):
    """Every file below a folder: its path there, and its bytes and times."""
    return {str(path.relative_to(folder)): (path.read_bytes(), path.stat().st_mtime_ns)
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}


def repeat_command(text):
    """The command that a run's output offers for repeating it."""
    return re.search(r"repeat it with: (.*)", text)[1]
