#!/usr/bin/env python3
"""Ctrl-C ends a run cleanly; a kill leaves nothing that looks finished."""

import json
import os
import signal
import subprocess
import time
import unittest

from program import PROGRAM, SHORT, ProgramTest, files_in

# Hours of work, unless somebody stops it.
LONG = SHORT.replace("duration_s: 2", "duration_s: 100000")


class Interrupt(ProgramTest):
    def start(self, *arguments):
        """Starts the program; comes back when a long run has recorded something."""
        process = subprocess.Popen([PROGRAM, "run", *arguments], cwd=self.folder, text=True,
                                   env=self.environment({}), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        until = time.monotonic() + 60
        while not any(path.stat().st_size > 500_000
                      for path in self.folder.glob("out/long*/*.part*/recording.h5")):
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), until, "it records nothing")
            time.sleep(0.05)
        return process

    def end(self, process, number):
        process.send_signal(number)
        started = time.monotonic()
        stdout, stderr = process.communicate(timeout=30)
        self.assertLess(time.monotonic() - started, 5)
        return stdout, stderr

    def assertStoppedCleanly(self, number, *arguments):
        process = self.start(*arguments)
        stdout, stderr = self.end(process, number)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertEqual(stdout, "")
        self.assertIn("interrupted", stderr)
        self.assertEqual(files_in(self.folder / "out"), {})
        self.assertEqual(list(self.folder.glob("out/**/*.part*")), [])

    def test_leaves_nothing_half_done(self):
        self.write("long.yaml", LONG)
        self.assertStoppedCleanly(signal.SIGINT, "long.yaml")

    def test_by_the_system(self):
        self.write("long.yaml", LONG)
        self.assertStoppedCleanly(signal.SIGTERM, "long.yaml")

    def test_ends_all_threads_and_starts_no_more(self):
        names = [self.write(f"long{i}.yaml", LONG) for i in range(4)]
        self.assertStoppedCleanly(signal.SIGINT, *names, "--jobs", "2")

    def test_keeps_what_was_finished(self):
        self.write("short.yaml")
        self.write("long.yaml", LONG)
        process = self.start("short.yaml", "long.yaml")
        self.end(process, signal.SIGINT)
        self.assertEqual(process.returncode, 130)
        self.assertTrue((self.result() / "run.json").exists())
        self.assertFalse(self.result("long").exists())

    def test_keeps_an_older_result(self):
        self.write("long.yaml")
        self.run_ok("long.yaml")
        before = files_in(self.folder / "out")
        self.write("long.yaml", LONG)
        self.end(self.start("long.yaml"), signal.SIGINT)
        self.assertEqual(files_in(self.folder / "out"), before)

    def assertHangingEstimatorStops(self, script):
        """An external estimator that never answers must not keep Ctrl-C waiting for its timeout."""
        started = self.folder / "started"
        command = ["sh", "-c", f"{script}; echo $$ > {started}.new; mv {started}.new {started}; "
                   "exec sleep 1000"]
        self.write("hangs.yaml", SHORT +
                   f"  mine: {{type: process, command: {json.dumps(command)}, timeout_s: 60}}\n")
        process = subprocess.Popen([PROGRAM, "run", "hangs.yaml"], cwd=self.folder, text=True,
                                   env=self.environment({}), stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        until = time.monotonic() + 60
        while not started.exists():
            self.assertIsNone(process.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), until, "it starts no estimator")
            time.sleep(0.05)
        time.sleep(0.2)  # so that it is waited for
        before = time.monotonic()
        _, stderr = self.end(process, signal.SIGINT)
        # 0.1 s until the flag is seen and 0.7 s of grace for the program; the rest is a busy machine.
        self.assertLess(time.monotonic() - before, 2.5)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("interrupted", stderr)
        self.assertEqual(list(self.folder.glob("out/**/*.part*")), [])
        self.assertEqual(files_in(self.folder / "out"), {})
        with self.assertRaises(ProcessLookupError):
            os.kill(int(started.read_text()), 0)

    def test_while_an_external_estimator_hangs(self):
        self.assertHangingEstimatorStops("true")

    def test_while_an_external_estimator_hangs_and_will_not_leave(self):
        self.assertHangingEstimatorStops("trap '' TERM INT")

    def test_killed_run_leaves_nothing_under_the_final_name(self):
        self.write("long.yaml", LONG)
        process = self.start("long.yaml")
        self.end(process, signal.SIGKILL)
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assertFalse(self.result("long").exists())
        parts = list(self.folder.glob("out/long/*.part*"))
        self.assertEqual(len(parts), 1)
        self.assertEqual({path.name for path in parts[0].iterdir()},
                         {"recording.h5", "resolved.yaml"})
        # And it is no obstacle.
        self.write("long.yaml")
        self.run_ok("long.yaml")
        self.assertTrue(parts[0].exists(), "somebody may still want to read it")


if __name__ == "__main__":
    unittest.main()
