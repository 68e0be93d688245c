#!/usr/bin/env python3
"""Stepping and recording take flat memory; scoring may hold one trajectory."""

import os
import pathlib
import subprocess
import unittest

from program import PROGRAM, SHORT, ProgramTest

MIB = 1024 * 1024
STREAMS = ("truth", "measurements", "estimates", "covariance", "innovations")


@unittest.skipIf(b"__asan_init" in pathlib.Path(PROGRAM).read_bytes(),
                 "the sanitizer keeps what is freed")
class Memory(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("short.yaml")

    def peak(self, duration_s, *arguments):
        """The most memory that a run of so many seconds ever holds, in bytes."""
        process = subprocess.Popen(
            [PROGRAM, "run", "short.yaml", "--quiet", "--set", f"duration_s={duration_s}",
             *arguments], cwd=self.folder, env=self.environment({}), stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return 1024 * usage.ru_maxrss

    def growth(self, *arguments):
        """How much more 200 s take than 20 s."""
        return self.peak(200, *arguments) - self.peak(20, *arguments)

    def test_stepping_and_recording_are_flat(self):
        # The filter waits for a rest that never comes, so there is no trajectory to score: only
        # 45 000 refusals of 24 bytes. A growing buffer of truth alone, 180 000 rows of 240 bytes,
        # would take 41 MiB.
        self.write("short.yaml", SHORT[:SHORT.index("estimators")] +
                   "estimators: {mine: {type: inekf, initialisation: {kind: static, "
                   "static_duration_s: 3600}}}\n")
        self.assertLess(self.growth(), 4 * MIB)

    def test_recording_estimates_is_flat(self):
        one = ("--estimator", "riekf")
        off = [word for stream in STREAMS for word in ("--set", f"record.{stream}=false")]
        # 36 000 estimates with covariance are 41 MiB, in a file that is not held.
        self.assertLess(self.growth(*one) - self.growth(*one, *off), 2 * MIB)

    def test_scoring_holds_one_trajectory(self):
        # In 180 s: 36 000 instants of truth, estimate and NEES (46 numbers), 9000 corrections of
        # 12. Twice that while a vector grows or its part from start_s on is copied, and once
        # more for the numbers that a median needs.
        trajectory = 8 * (36_000 * 46 + 9_000 * 12)
        self.assertLess(self.growth("--estimator", "riekf"), 3 * trajectory)


if __name__ == "__main__":
    unittest.main()
