#!/usr/bin/env python3
"""What the program leaves in its output folder, and how to run and score again."""

import os
import shutil
import unittest

from program import IMPOSSIBLE, OFF_THE_MAP, SHORT, ProgramTest, files_in

SAME_BYTES = ("recording.h5", "metrics.json", "resolved.yaml", "truth.tum", "riekf.tum", "mekf.tum")


class Repeat(ProgramTest):
    def assertSameResult(self, a, b):
        names = {path.name for path in a.iterdir()}
        self.assertEqual(names, {*SAME_BYTES, "run.json"})
        self.assertEqual(names, {path.name for path in b.iterdir()})
        for name in SAME_BYTES:
            self.assertTrue((a / name).read_bytes() == (b / name).read_bytes(), name)

    def test_neither_threads_nor_order_nor_process_change_a_byte(self):
        self.write("a.yaml", SHORT + "world: {terrain: {kind: rough}}\n")
        self.write("b.yaml")
        self.run_ok("a.yaml", "--out", "apart")
        self.run_ok("b.yaml", "--out", "apart")
        self.run_ok("a.yaml", "b.yaml", "--out", "ab")
        self.run_ok("b.yaml", "a.yaml", "--out", "ba")
        self.run_ok("a.yaml", "b.yaml", "--out", "threads", "--jobs", "2")
        for out in ("ab", "ba", "threads"):
            for name in ("a", "b"):
                self.assertSameResult(self.result(name, out="apart"), self.result(name, out=out))

    def test_resolved_scenario_gives_the_same_bytes(self):
        self.write("short.yaml")
        self.run_ok("short.yaml", "--seed", "5", "--set", "sensors.imu.grade=mpu6050")
        (self.folder / "moved").mkdir()
        shutil.copy(self.result(seed=5) / "resolved.yaml", self.folder / "moved" / "short.yaml")
        self.run_ok("moved/short.yaml", "--out", "again")
        self.assertSameResult(self.result(seed=5), self.result(seed=5, out="again"))

    def test_another_seed_gives_other_bytes(self):
        self.write("short.yaml")
        self.run_ok("short.yaml")
        self.run_ok("short.yaml", "--seed", "2")
        for name in set(SAME_BYTES) - {"truth.tum"}:  # on flat ground no seed moves the robot
            self.assertFalse((self.result() / name).read_bytes() ==
                             (self.result(seed=2) / name).read_bytes(), name)

    def test_results_are_named_after_the_path_below_scenarios(self):
        self.run_ok(self.write("scenarios/field/day.yaml"))
        self.assertTrue((self.result("field/day") / "run.json").exists())


class RunAgain(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("short.yaml")
        self.run_ok("short.yaml")
        self.run_ok("short.yaml", "--seed", "2")
        self.write("out/notes.txt", "mine")
        self.write("out/short/notes.txt", "mine")
        self.before = files_in(self.folder / "out")

    def changed(self):
        """The files that are not as they were, by the folder that holds them."""
        after = files_in(self.folder / "out")
        names = {name for name in {*self.before, *after}
                 if self.before.get(name) != after.get(name)}
        return {os.path.dirname(name) for name in names}

    def test_replaces_its_result_and_nothing_else(self):
        extra = self.result() / "left_over.txt"
        extra.write_text("of the old result")
        self.before = files_in(self.folder / "out")
        self.run_ok("short.yaml", "--set", "duration_s=1.5")
        self.assertEqual(self.changed(), {"short/seed_00001"})
        self.assertFalse(extra.exists())
        self.assertEqual(self.run_json()["simulated_s"], 1.5)

    def test_replaces_a_failed_result(self):
        self.write("off.yaml", OFF_THE_MAP)
        for _ in range(2):
            self.assertEqual(self.call("run", "off.yaml").returncode, 3)
        self.assertEqual(self.changed(), {"off/seed_00001"})

    def test_resume_keeps_a_finished_result(self):
        done = self.run_ok("short.yaml", "--resume")
        self.assertEqual(self.changed(), set())
        self.assertIn("riekf", done.stdout)

    def test_resume_says_again_that_an_expectation_failed(self):
        self.write("strict.yaml", SHORT + IMPOSSIBLE)
        self.assertEqual(self.call("run", "strict.yaml").returncode, 1)
        self.before = files_in(self.folder / "out")
        done = self.call("run", "strict.yaml", "--resume")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("FAILED riekf.ate_position_rmse_m", done.stdout)
        self.assertEqual(self.changed(), set())

    def test_resume_runs_what_has_changed(self):
        self.run_ok("short.yaml", "--resume", "--set", "world.terrain.friction=0.7")
        self.assertEqual(self.changed(), {"short/seed_00001"})

    def test_resume_runs_what_is_missing(self):
        self.run_ok("short.yaml", "--resume", "--seed", "3")
        self.assertEqual(self.changed(), {"short/seed_00003"})

    def test_resume_runs_what_failed(self):
        self.write("off.yaml", OFF_THE_MAP)
        self.call("run", "off.yaml")
        before = (self.result("off") / "run.json").stat().st_mtime_ns
        self.assertEqual(self.call("run", "off.yaml", "--resume").returncode, 3)
        self.assertNotEqual((self.result("off") / "run.json").stat().st_mtime_ns, before)

    def test_force_replaces_what_is_not_ours(self):
        self.write("out/other/seed_00001/notes.txt", "not needed")
        self.write("other.yaml")
        self.assertEqual(self.call("run", "other.yaml").returncode, 2)
        self.run_ok("other.yaml", "--force")
        self.assertTrue((self.result("other") / "run.json").exists())
        self.assertFalse((self.result("other") / "notes.txt").exists())
        self.assertEqual(self.changed(), {"other/seed_00001"})


class Score(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("short.yaml")
        self.run_ok("short.yaml")
        self.metrics = self.result() / "metrics.json"

    def test_again_gives_the_same_bytes(self):
        before = self.metrics.read_bytes()
        done = self.call("score", self.result())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.metrics.read_bytes(), before)

    def test_with_another_alignment_and_back(self):
        before = self.metrics.read_bytes()
        self.assertEqual(
            self.call("score", self.result(), "--set", "score.align=none").returncode, 0)
        self.assertNotEqual(self.metrics.read_bytes(), before)
        self.assertEqual(self.call("score", self.result()).returncode, 0)
        self.assertEqual(self.metrics.read_bytes(), before)

    def test_judges_expectations(self):
        done = self.call("score", self.result(), "--set",
                         "expect.riekf.ate_position_rmse_m.max=1.0e-9")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("FAILED riekf.ate_position_rmse_m <= 1e-09", done.stdout)

    def test_cannot_change_what_was_measured(self):
        before = files_in(self.folder)
        for override in ("sensors.imu.rate_hz=100", "seed=4", "score.algin=none"):
            self.assertRefused(self.call("score", self.result(), "--set", override),
                               f"--set {override}")
        self.assertEqual(files_in(self.folder), before)

    def test_refuses_what_is_no_result(self):
        (self.folder / "empty").mkdir()
        self.assertRefused(self.call("score", "empty"), "^empty: error: not a result")
        self.assertRefused(self.call("score", "out/short"), "not a result")
        self.assertRefused(self.call("score", "nowhere"), "not a result")
        self.assertRefused(self.call("score", "short.yaml"), "not a result")
        self.assertEqual(list((self.folder / "empty").iterdir()), [])

    def test_refuses_a_result_without_its_recording(self):
        (self.result() / "recording.h5").unlink()
        done = self.call("score", self.result())
        self.assertIn(done.returncode, (2, 3))
        self.assertIn("recording.h5", done.stderr)


if __name__ == "__main__":
    unittest.main()
