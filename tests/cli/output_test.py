#!/usr/bin/env python3
"""What goes to stdout and what to stderr, and what the commands that don't run print."""

import json
import os
import pty
import re
import signal
import subprocess
import threading
import time
import unittest

from program import IMPOSSIBLE, PROGRAM, SHORT, SOURCE, ProgramTest

HOLDS = IMPOSSIBLE.replace("1.0e-9", "10")


class Run(ProgramTest):
    def test_table_names_every_estimator(self):
        done = self.run_ok(self.write("short.yaml"))
        self.assertIn("out/short/seed_00001", done.stdout)
        for name in ("riekf", "mekf"):
            self.assertRegex(done.stdout, rf"(?m)^\s*{name}(\s+[\d.e-]+){{5}}")

    def test_a_line_of_progress_every_few_seconds(self):
        self.write("long.yaml", SHORT.replace("duration_s: 2", "duration_s: 100000"))
        started = time.monotonic()
        process = subprocess.Popen([PROGRAM, "run", "long.yaml"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        line = process.stderr.readline()
        self.assertLess(time.monotonic() - started, 30)
        self.assertRegex(line, r"^long: \d+ %, \d+ times real time$")
        process.send_signal(signal.SIGINT)
        stdout, _ = process.communicate(timeout=30)
        self.assertEqual(stdout, "")

    def test_quiet(self):
        done = self.run_ok(self.write("short.yaml"), "--quiet")
        self.assertEqual(done.stderr, "")
        self.assertIn("riekf", done.stdout)

    def test_json_holds_the_verdicts(self):
        self.write("short.yaml", SHORT + IMPOSSIBLE)
        self.write("good.yaml", SHORT + HOLDS)
        self.write("bad.yaml", "sede: 1\n")
        done = self.call("run", "short.yaml", "good.yaml", "bad.yaml", "--json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("bad.yaml:1:1", done.stderr)
        strict, good = json.loads(done.stdout)
        self.assertEqual([strict["exit_code"], good["exit_code"]], [1, 0])
        verdict, = strict["expectations"]
        self.assertFalse(verdict["holds"])
        self.assertIn("riekf.ate_position_rmse_m <= 1e-09", verdict["expectation"])
        self.assertIn("off by", verdict["detail"])
        self.assertTrue(good["expectations"][0]["holds"])
        self.assertEqual(strict["command"], "reckon run short.yaml")
        metrics = json.loads((self.result("good") / "metrics.json").read_text())
        self.assertEqual(good["estimators"], metrics["estimators"])

    def test_json_of_score_and_resume(self):
        self.write("short.yaml", SHORT + HOLDS)
        first, = json.loads(self.run_ok("short.yaml", "--json").stdout)
        again, = json.loads(self.run_ok("short.yaml", "--json", "--resume").stdout)
        self.assertEqual(again, first)
        scored, = json.loads(self.call("score", self.result(), "--json").stdout)
        for key in ("estimators", "expectations", "exit_code", "seed", "scenario"):
            self.assertEqual(scored[key], first[key], key)

    def on_terminal(self, stream, environment=None, duration_s=2):
        """Everything that a run writes to a terminal on stdout or stderr."""
        try:
            mine, its = pty.openpty()
        except OSError as error:
            self.skipTest(f"no pseudo-terminal here: {error}")
        text = []

        def read():
            try:
                while block := os.read(mine, 65536):
                    text.append(block)
            except OSError:  # the other end is closed
                pass

        reader = threading.Thread(target=read)
        reader.start()
        done = self.call("run", "short.yaml", "--set", f"duration_s={duration_s}",
                         environment=environment, **{stream: its})
        os.close(its)
        reader.join()
        os.close(mine)
        self.assertEqual(done.returncode, 0, done.stderr)
        return b"".join(text).decode()

    def test_color_only_where_it_is_welcome(self):
        self.write("short.yaml", SHORT + HOLDS)
        self.assertIn("\x1b[", self.on_terminal("stdout", {"TERM": "xterm"}))
        self.assertNotIn("\x1b", self.on_terminal("stdout", {"TERM": "xterm", "NO_COLOR": "1"}))
        self.assertNotIn("\x1b", self.run_ok("short.yaml").stdout)

    def test_progress_bar_on_a_terminal(self):
        self.write("short.yaml")
        text = self.on_terminal("stderr", duration_s=60)
        self.assertRegex(text, r"\rshort|\r\x1b\[Kshort")
        self.assertRegex(text, r"\d+ %")
        self.assertTrue(text.endswith("\r\x1b[K"), "it wipes itself away")

    def test_nothing_prompts(self):
        self.write("short.yaml")
        with open(os.devnull) as nothing:
            self.run_ok("short.yaml", stdin=nothing)

    def test_run_json_says_where_when_and_how(self):
        self.run_ok(self.write("short.yaml"))
        run = self.run_json()
        for key in ("version", "commit", "platform", "wall_s", "real_time_factor", "costs",
                    "outcome", "command"):
            self.assertIn(key, run)
        self.assertEqual(run["simulated_s"], 2)
        metrics = (self.result() / "metrics.json").read_text()
        self.assertNotIn("wall", metrics)
        self.assertNotIn("NaN", metrics)
        self.assertNotIn("Infinity", metrics)

    def test_tum_files_have_eight_columns(self):
        self.run_ok(self.write("short.yaml"))
        for name in ("truth", "riekf", "mekf"):
            lines = (self.result() / f"{name}.tum").read_text().splitlines()
            self.assertGreater(len(lines), 390)  # 200 Hz for 2 s
            rows = [[float(word) for word in line.split(" ")] for line in lines]
            self.assertEqual({len(row) for row in rows}, {8}, name)
            for row in rows:
                self.assertAlmostEqual(sum(q * q for q in row[4:]), 1, places=9)
            times = [row[0] for row in rows]
            self.assertEqual(times, sorted(set(times)))


class Check(ProgramTest):
    def check(self, *arguments):
        done = self.call("check", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_resolved_scenario_is_a_fixpoint(self):
        scenarios = sorted((SOURCE / "scenarios").rglob("*.yaml"))
        self.assertGreater(len(scenarios), 10)
        for scenario in scenarios:
            if scenario.parent.name == "logs":
                # A log that is not ours to keep beside the project may be missing.
                done = self.call("check", scenario)
                if done.returncode == 77 and "there is no log" in done.stderr:
                    continue
            resolved = self.check(scenario)
            # Under the same name, in a folder of its own, with all that it needs inside.
            self.write(f"{scenario.stem}.yaml", resolved)
            self.assertEqual(self.check(f"{scenario.stem}.yaml"), resolved, scenario.name)

    def test_writes_nothing(self):
        self.write("short.yaml")
        self.check("short.yaml")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["short.yaml"])

    def test_overrides(self):
        self.write("short.yaml")
        self.assertIn("\nduration_s: 9\n", self.check("short.yaml", "--set", "duration_s=9"))

    def test_is_what_a_run_writes(self):
        self.write("short.yaml")
        self.run_ok("short.yaml", "--seed", "4")
        self.assertEqual(self.check("short.yaml", "--set", "seed=4"),
                         (self.result(seed=4) / "resolved.yaml").read_text())

    def test_wrong_scenario(self):
        self.assertRefused(self.call("check", self.write("bad.yaml", "sede: 1\n")),
                           r"^bad\.yaml:1:1: error: .*'seed'")

    def test_schema(self):
        schema = json.loads(self.check("--schema"))
        self.assertIn("$schema", schema)
        self.assertIn("duration_s", schema["properties"])
        self.assertEqual(self.check("--schema"),
                         (SOURCE / "scenarios" / "scenario.schema.json").read_text())


class List(ProgramTest):
    SECTIONS = ("robots", "estimators", "sensors", "grades", "terrains", "metrics", "scenarios")

    def test_sections(self):
        done = self.call("list")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        headings = re.findall(r"(?m)^(\w+)$", done.stdout)
        self.assertLessEqual(set(self.SECTIONS), set(headings))
        for name in ("husky", "inekf", "mekf", "odometry", "process", "vn100", "rough",
                     "ate_position_rmse_m", "scenarios/husky/square.yaml"):
            self.assertRegex(done.stdout, rf"(?m)^  {re.escape(name)}\s")

    def test_json_has_the_same_names(self):
        text = self.call("list").stdout
        everything = json.loads(self.call("list", "--json").stdout)
        self.assertLessEqual(set(self.SECTIONS), set(everything))
        for entries in everything.values():
            self.assertTrue(entries)
            for entry in entries:
                self.assertIn(f"\n  {entry['name']}", text)
                self.assertTrue(entry["description"], entry["name"])

    def test_one_section(self):
        grades = self.call("list", "grades")
        self.assertEqual(grades.returncode, 0)
        self.assertIn("blank", grades.stdout)
        self.assertNotIn("husky", grades.stdout)
        self.assertEqual(list(json.loads(self.call("list", "grades", "--json").stdout)),
                         ["grades"])


class Help(ProgramTest):
    def test_is_a_result(self):
        done = self.call("--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for command in ("run", "score", "check", "list"):
            self.assertRegex(done.stdout, rf"(?m)^\s+{command}\s")
        done = self.call("run", "--help")
        for flag in ("--seed", "--set", "--estimator", "--out", "--jobs", "--json", "--quiet",
                     "--force", "--resume"):
            self.assertIn(flag, done.stdout)

    def test_version(self):
        self.assertRegex(self.call("--version").stdout, r"^reckon \d+\.\d+")


if __name__ == "__main__":
    unittest.main()
