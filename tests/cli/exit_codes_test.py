#!/usr/bin/env python3
"""Exit codes 0 to 3, and what the program says with them."""

import json
import os
import resource
import shlex
import shutil
import subprocess
import unittest

from program import IMPOSSIBLE, OFF_THE_MAP, PROGRAM, SHORT, SOURCE, ProgramTest, files_in, \
    repeat_command


class Holds(ProgramTest):
    def test_run_without_expectations(self):
        self.run_ok(self.write("short.yaml"))
        self.assertEqual(self.run_json()["outcome"], "finished")

    def test_expectation_that_holds(self):
        self.run_ok(self.write("short.yaml", SHORT + IMPOSSIBLE.replace("1.0e-9", "10")))
        self.assertTrue(all(verdict["holds"] for verdict in self.run_json()["expectations"]))

    def test_run_that_has_to_fail(self):
        self.run_ok(self.write("off.yaml", OFF_THE_MAP + "expect: {exit_code: 3}\n"))
        self.assertEqual(self.run_json(name="off")["outcome"], "failed")


class ExpectationFailed(ProgramTest):
    def test_says_which_by_how_much_and_how_to_repeat_it(self):
        self.write("short.yaml", SHORT + IMPOSSIBLE)
        arguments = ["short.yaml", "--seed", "7", "--estimator", "riekf",
                     "--set", "description=it's a \"test\"", "--quiet"]
        done = self.call("run", *arguments)
        self.assertEqual(done.returncode, 1, done.stderr)
        found = json.loads((self.result(seed=7) / "metrics.json").read_text())[
            "estimators"]["riekf"]["ate_position_rmse_m"]
        self.assertIn("riekf.ate_position_rmse_m <= 1e-09", done.stdout)
        self.assertIn(f"found {found:.6g}, off by {found - 1e-9:.3g}", done.stdout)

        command = repeat_command(done.stdout)
        self.assertEqual(self.run_json(seed=7)["command"], command)
        metrics = (self.result(seed=7) / "metrics.json").read_bytes()
        program, *again = shlex.split(command)
        self.assertEqual(program, "reckon")
        repeated = self.call(*again, "--out", "again")
        self.assertEqual(repeated.returncode, 1, repeated.stderr)
        self.assertEqual((self.result(seed=7, out="again") / "metrics.json").read_bytes(), metrics)

    def test_run_that_had_to_fail_but_does_not(self):
        self.write("short.yaml", SHORT + "expect: {exit_code: 3}\n")
        done = self.call("run", "short.yaml")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("must end with exit code 3", done.stdout)

    def test_comparison(self):
        self.write("short.yaml", SHORT + "expect: {compare: ['riekf.final_drift_m < 0 * "
                                         "mekf.final_drift_m']}\n")
        done = self.call("run", "short.yaml")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("FAILED riekf.final_drift_m < 0 * mekf.final_drift_m", done.stdout)


class WrongScenario(ProgramTest):
    """Wrong files: file:line:column, key, what was found and what was expected."""

    def refuse(self, text, *patterns):
        self.write("short.yaml", text)
        self.assertRefused(self.call("run", "short.yaml"), *patterns)
        self.assertFalse((self.folder / "out").exists())

    def test_unknown_key(self):
        self.refuse(SHORT + "durations_s: 3\n",
                    r"^short\.yaml:7:1: error: unknown key 'durations_s'.*'duration_s'")

    def test_wrong_type(self):
        self.refuse(SHORT.replace("radius_m: 3", "radius_m: wide"),
                    r"short\.yaml:3:\d+: error: '/motion/radius_m': expected .*number.*'wide'")

    def test_out_of_range(self):
        self.refuse(SHORT + "world: {gravity_m_s2: 9810}\n",
                    r"short\.yaml:7:\d+: error: '/world/gravity_m_s2': expected .*30.*'9810'")

    def test_nan(self):
        self.refuse(SHORT.replace("radius_m: 3", "radius_m: .nan"),
                    r"short\.yaml:3:\d+: error: '/motion/radius_m': expected .*finite.*nan")

    def test_negative_duration(self):
        self.refuse(SHORT.replace("duration_s: 2", "duration_s: -2"),
                    r"short\.yaml:2:13: error: '/duration_s': expected .*above 0.*'-2'")

    def test_sensor_twice(self):
        self.refuse(SHORT + "sensors:\n  imu: {rate_hz: 100}\n  imu: {rate_hz: 200}\n",
                    r"short\.yaml:9:3: error: key 'imu' is written twice.*line 8")

    def test_broken_yaml(self):
        self.refuse(SHORT + "world: {terrain: [\n", r"short\.yaml:\d+:\d+: error: ")

    def test_unknown_robot(self):
        self.refuse(SHORT + "robot: huskie\n", r"short\.yaml:7:8: error: .*'huskie'.*'husky'")

    def test_unknown_metric(self):
        self.refuse(SHORT + IMPOSSIBLE.replace("rmse_m", "rsme_m"),
                    r"short\.yaml:8:\d+: error: .*'ate_position_rsme_m'.*'ate_position_rmse_m'")

    def test_several_mistakes_in_one_message(self):
        self.refuse(SHORT + "sede: 1\nworld: {gravity_m_s2: high}\n",
                    r"(?m)^short\.yaml:7:1: error: .*'seed'\?$",
                    r"(?m)^short\.yaml:8:\d+: error: '/world/gravity_m_s2'")

    def test_urdf_without_inertia(self):
        home = self.folder / "home"
        shutil.copytree(SOURCE / "models" / "husky", home / "models" / "bare")
        urdf = home / "models" / "bare" / "husky.urdf"
        text = urdf.read_text()
        start = text.index("<inertial>")
        end = text.index("</inertial>") + len("</inertial>")
        urdf.write_text(text[:start] + text[end:])
        self.write("short.yaml", SHORT + "robot: bare\n")
        done = self.call("run", "short.yaml", environment={"RECKON_HOME": str(home)})
        self.assertRefused(done, r"husky\.urdf.*inerti")
        self.assertFalse((self.folder / "out").exists())


class WrongCommandLine(ProgramTest):
    def refuse(self, arguments, *patterns):
        self.write("short.yaml")
        self.assertRefused(self.call(*arguments), *patterns)
        self.assertFalse((self.folder / "out").exists())

    def test_nothing(self):
        self.refuse([], "reckon --help")

    def test_unknown_command(self):
        self.refuse(["rnu", "short.yaml"], "'rnu'; did you mean 'run'")

    def test_unknown_flag(self):
        self.refuse(["run", "short.yaml", "--jbos", "2"], "'--jbos'; did you mean '--jobs'")
        self.refuse(["run", "short.yaml", "--jbos=2"], "'--jbos'; did you mean '--jobs'")

    def test_no_scenario(self):
        self.refuse(["run"], "scenario")

    def test_missing_file(self):
        self.refuse(["run", "nothing.yaml"], r"^nothing\.yaml: error: there is no such file")

    def test_folder_as_scenario(self):
        self.refuse(["run", "."], "folder")

    def test_unknown_estimator(self):
        self.refuse(["run", "short.yaml", "--estimator", "rieekf"], "'riekf'")

    def test_wrong_override(self):
        self.refuse(["run", "short.yaml", "--set", "world.terain.kind=flat"],
                    r"--set world\.terain\.kind=flat: error: unknown key 'terain'.*'terrain'")
        self.refuse(["run", "short.yaml", "--set", "duration_s"], "--set duration_s")

    def test_wrong_numbers(self):
        self.refuse(["run", "short.yaml", "--seed", "-1"], "seed")
        self.refuse(["run", "short.yaml", "--seed", "one"], "seed")
        self.refuse(["run", "short.yaml", "--jobs", "0"], "jobs")

    def test_two_scenarios_with_one_name(self):
        self.write("other/short.yaml")
        self.refuse(["run", "short.yaml", "other/short.yaml"], "same name")

    def test_unknown_section(self):
        self.refuse(["list", "terains"], "'terains'; did you mean 'terrains'")
        self.refuse(["list", "terains", "--json"], "'terains'; did you mean 'terrains'")


class WrongOutputFolder(ProgramTest):
    def test_file_in_the_way(self):
        self.write("short.yaml")
        self.write("taken", "mine")
        self.assertRefused(self.call("run", "short.yaml", "--out", "taken"), "taken")
        self.assertEqual((self.folder / "taken").read_text(), "mine")

    def test_unwritable_place(self):
        self.write("short.yaml")
        # No one can make a folder there, root included.
        done = self.call("run", "short.yaml", "--out", "/proc/results")
        self.assertRefused(done, r"^short\.yaml: error: .*/proc/results")

    @unittest.skipIf(os.geteuid() == 0, "root can write everywhere")
    def test_folder_without_permission(self):
        self.write("short.yaml")
        (self.folder / "closed").mkdir(mode=0o500)
        self.assertRefused(self.call("run", "short.yaml", "--out", "closed"), "closed.*ermission")

    def test_folder_of_somebody_else(self):
        self.write("short.yaml")
        self.write("out/short/seed_00001/thesis.tex", "my thesis")
        before = files_in(self.folder)
        done = self.call("run", "short.yaml")
        self.assertRefused(done, "out/short/seed_00001", "--force")
        self.assertEqual(files_in(self.folder), before)

    def test_result_of_another_scenario(self):
        self.write("short.yaml")
        self.run_ok("short.yaml")
        (self.folder / "out/short").rename(self.folder / "out/other")
        before = files_in(self.folder / "out")
        self.write("other.yaml")
        self.assertRefused(self.call("run", "other.yaml"), "out/other/seed_00001")
        self.assertEqual(files_in(self.folder / "out"), before)


class RunFailed(ProgramTest):
    def test_leaving_the_map(self):
        done = self.call("run", self.write("off.yaml", OFF_THE_MAP))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stdout, r"FAILED: .*left the map.*2 m.*t = \d")
        self.assertEqual(repeat_command(done.stdout), "reckon run off.yaml")
        run = self.run_json(name="off")
        self.assertEqual((run["outcome"], run["exit_code"]), ("failed", 3))
        metrics = json.loads((self.result("off") / "metrics.json").read_text())
        self.assertFalse(metrics["complete"])

    def test_external_process_that_ends(self):
        process = "estimators: {mine: {type: process, command: [sh, -c, 'exit 7']}}\n"
        self.write("short.yaml", SHORT[:SHORT.index("estimators")] + process)
        done = self.call("run", "short.yaml")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stdout + done.stderr, r"'mine'.*exit code 7")

    def test_program_that_is_not_there(self):
        process = "estimators: {mine: {type: process, command: [no-such-program]}}\n"
        self.write("short.yaml", SHORT[:SHORT.index("estimators")] + process)
        self.assertRefused(self.call("run", "short.yaml"), "'mine'.*'no-such-program'")
        self.assertNothingLeft()

    def test_worst_code_wins(self):
        self.write("good.yaml")
        self.write("strict.yaml", SHORT + IMPOSSIBLE)
        self.write("off.yaml", OFF_THE_MAP)
        self.write("bad.yaml", "sede: 1\n")
        for scenarios, code in ((["good", "strict"], 1), (["off", "strict", "good"], 3),
                                (["strict", "off"], 3), (["off", "bad", "good", "strict"], 2),
                                (["bad", "strict", "off"], 2)):
            for jobs in ("1", "2"):
                done = self.call("run", *[name + ".yaml" for name in scenarios], "--jobs", jobs,
                                 "--out", jobs)
                self.assertEqual(done.returncode, code, (scenarios, jobs, done.stderr))
        for jobs in ("1", "2"):  # and the others ran all the same
            for name in ("good", "strict", "off"):
                self.assertTrue((self.result(name, out=jobs) / "run.json").exists())


class FullDisk(ProgramTest):
    def assertFull(self, done):
        self.assertEqual(done.returncode, 3, done.stderr + done.stdout)
        self.assertRegex(done.stderr, r"can't (write|start writing).*: (File too large|No space left on device)")

    def limited(self, size, *arguments):
        """Files can't grow beyond `size` bytes: what a full disk does, without one."""
        return self.call(*arguments, preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (size, size)))

    def test_at_any_moment(self):
        self.write("short.yaml")
        self.run_ok("short.yaml", "--out", "whole")
        sizes = {path.name: path.stat().st_size for path in self.result(out="whole").iterdir()}
        # The scenario itself; the recording at its start, midway and in its last block.
        for size in (1000, sizes["resolved.yaml"] + 1, sizes["recording.h5"] // 2,
                     sizes["recording.h5"] - 1):
            self.assertFull(self.limited(size, "run", "short.yaml"))
            self.assertNothingLeft()

    def test_after_the_recording(self):
        off = [f"record.{stream}=false" for stream in
               ("truth", "measurements", "estimates", "innovations")]
        arguments = ["short.yaml", *[word for key in off for word in ("--set", key)],
                     "--set", "duration_s=12"]
        self.write("short.yaml")
        self.run_ok(*arguments, "--out", "whole")
        sizes = {path.name: path.stat().st_size for path in self.result(out="whole").iterdir()}
        size = sizes["recording.h5"] + 1
        self.assertLess(size, sizes["truth.tum"], "the limit must let the recording pass")
        done = self.limited(size, "run", *arguments)
        self.assertEqual(done.returncode, 3, done.stderr + done.stdout)
        self.assertRegex(done.stderr, r"riekf\.tum|mekf\.tum|truth\.tum")
        self.assertNothingLeft()

    def test_keeps_an_older_result(self):
        self.write("short.yaml")
        self.run_ok("short.yaml")
        before = files_in(self.folder / "out")
        self.assertFull(self.limited(100_000, "run", "short.yaml"))
        self.assertFull(self.limited(100, "score", "out/short/seed_00001"))
        self.assertEqual(files_in(self.folder / "out"), before)

    def test_on_a_real_disk(self):
        self.write("short.yaml")
        script = ("mkdir disk && mount -t tmpfs -o size=300k none disk || exit 77; "
                  f"{shlex.quote(PROGRAM)} run short.yaml --out disk; code=$?; "
                  "find disk -type f >left; exit $code")
        unshare = shutil.which("unshare")
        done = subprocess.run([unshare or "false", "--mount", "sh", "-c", script],
                              cwd=self.folder, capture_output=True, text=True)
        if not (self.folder / "left").exists():
            self.skipTest("can't mount a small disk here")
        self.assertFull(done)
        self.assertEqual((self.folder / "left").read_text(), "")

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full")
    def test_on_standard_output(self):
        self.write("short.yaml")
        for arguments in (["run", "short.yaml"], ["run", "short.yaml", "--json"],
                          ["check", "short.yaml"], ["list"]):
            with open("/dev/full", "w") as full:
                done = self.call(*arguments, stdout=full)
            self.assertEqual(done.returncode, 3, (arguments, done.stderr))
            self.assertNotEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
