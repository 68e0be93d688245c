#!/usr/bin/env python3
"""What scores and exported trajectories say of each other, and what scoring again leaves."""

import json
import math
import unittest

from program import SHORT, ProgramTest, files_in

# Two estimators whose beliefs have other stamps, and a start that is not scored.
LATE = SHORT.replace("  mekf: {type: mekf}\n", "  wheels: {type: odometry}\n") + \
    "score: {align: none, start_s: 1}\n"


def trajectory(path):
    rows = [line.split() for line in path.read_text().splitlines()]
    return {row[0]: [float(number) for number in row[1:4]] for row in rows}


class Scores(ProgramTest):
    def metrics(self):
        return json.loads((self.result() / "metrics.json").read_text())["estimators"]

    def test_are_those_of_the_exported_trajectories(self):
        self.write("short.yaml", LATE)
        self.run_ok("short.yaml")
        truth = trajectory(self.result() / "truth.tum")
        self.assertGreaterEqual(min(map(float, truth)), 1.0)
        for name, scores in self.metrics().items():
            estimate = trajectory(self.result() / f"{name}.tum")
            self.assertEqual(len(estimate), scores["estimate_count"])
            squares = [math.dist(position, truth[stamp]) ** 2
                       for stamp, position in estimate.items()]
            rmse = math.sqrt(sum(squares) / len(squares))
            # Twice the same sum over numbers that are written exactly: round-off alone.
            self.assertAlmostEqual(scores["ate_position_rmse_m"] / rmse, 1.0, delta=1e-9)

    def test_of_a_slow_message_are_those_of_its_recording(self):
        self.write("short.yaml", SHORT + "score: {align: none}\n")
        self.run_ok("short.yaml", "--set", "sensors.imu.latency_s=3", "--set", "duration_s=6")
        first = self.metrics()
        self.assertGreater(first["riekf"]["estimate_count"], 500)
        self.assertEqual(first["riekf"]["unpaired_estimate_count"], 0)
        self.assertEqual(self.call("score", self.result()).returncode, 0)
        self.assertEqual(self.metrics(), first)

    def test_of_a_recording_that_left_something_out_are_refused(self):
        self.write("short.yaml")
        for key in ("truth=false", "estimates=false", "covariance=false", "innovations=false",
                    "estimate_rate_hz=60", "truth_rate_hz=50"):
            self.run_ok("short.yaml", "--set", f"record.{key}")
            before = files_in(self.result())
            done = self.call("score", self.result())
            self.assertRefused(done, "its recording")
            self.assertIn(key.split("=")[0], done.stderr)
            self.assertEqual(files_in(self.result()), before, key)

    def test_need_neither_measurements_nor_truth_between_the_estimates(self):
        self.write("short.yaml")
        # The IMU's rate: truth at every stamp of the filters.
        self.run_ok("short.yaml", "--set", "record.measurements=false",
                    "--set", "record.truth_rate_hz=200")
        first = self.metrics()
        self.assertEqual(self.call("score", self.result()).returncode, 0)
        self.assertEqual(self.metrics(), first)

    def test_again_tell_how_they_were_made(self):
        self.write("short.yaml", SHORT + "score: {align: none}\n"
                   "expect: {riekf: {ate_position_rmse_m: {min: 1.0e-3}}}\n")
        self.run_ok("short.yaml")
        first = self.metrics()
        done = self.call("score", self.result(), "--set", "score.align=se3",
                         "--set", "expect.riekf.ate_position_rmse_m.min=100")
        self.assertEqual(done.returncode, 1)
        metrics = json.loads((self.result() / "metrics.json").read_text())
        self.assertIn("score.align=se3", metrics["score_overrides"])
        run = json.loads((self.result() / "run.json").read_text())
        self.assertEqual(run["exit_code"], 1)
        self.assertFalse(run["expectations"][0]["holds"])
        # A run that resumes does not take those scores for its own.
        self.run_ok("short.yaml", "--resume")
        self.assertEqual(self.metrics(), first)

    def test_of_the_resolved_scenario_are_the_same_bytes(self):
        self.write("short.yaml")
        self.run_ok("short.yaml")
        self.run_ok(self.result() / "resolved.yaml")
        files = sorted(path.name for path in self.result().iterdir())
        again = self.result("resolved")
        self.assertEqual(sorted(path.name for path in again.iterdir()), files)
        for name in files:
            if name != "run.json":
                self.assertEqual((again / name).read_bytes(), (self.result() / name).read_bytes(),
                                 name)


if __name__ == "__main__":
    unittest.main()
