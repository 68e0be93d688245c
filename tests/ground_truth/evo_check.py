"""Compares our statistics of two exported trajectories with those of evo, run as a program.

    evo_check.py TRAJECTORY_ERRORS [TRUTH.tum ESTIMATE.tum]

Without files, the program makes a pair first. Exits with 1 and a line for each difference.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile
from concurrent.futures import ThreadPoolExecutor

RELATIVE = 1e-6
ABSOLUTE = 1e-9  # the least error after alignment to the first pose is zero but for roundings


def evo(folder, program, flags, relation, truth, estimate):
    """The statistics that an evo program writes into its results archive."""
    name = "_".join([program, *flags, relation]).replace("-", "") + ".zip"
    archive = pathlib.Path(folder, name)
    command = [str(pathlib.Path(sys.executable).with_name(program)), "tum", truth, estimate,
               "--pose_relation", relation, *flags, "--save_results", str(archive), "--no_warnings",
               "--silent"]
    done = subprocess.run(command, env={**os.environ, "HOME": folder}, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    with zipfile.ZipFile(archive) as results:
        return json.loads(results.read("stats.json"))


def differences(job, theirs):
    program, flags, relation, ours = job
    for statistic, expected in theirs.items():
        found = ours[statistic]
        if not abs(found - expected) <= RELATIVE * abs(expected) + ABSOLUTE:
            yield f"{program} {flags} {relation} {statistic}: ours {found}, evo {expected}"


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        if len(sys.argv) > 2:
            truth, estimate = sys.argv[2:4]
        else:
            truth, estimate = folder + "/truth.tum", folder + "/estimate.tum"
            subprocess.run([program, "make", truth, estimate], check=True)
        ours = json.loads(subprocess.run([program, truth, estimate], check=True,
                                         capture_output=True).stdout)
        jobs = [("evo_" + kind, flags, relation, statistics) for kind in ("ape", "rpe")
                for flags, relations in ours[kind].items()
                for relation, statistics in relations.items()]

        def ask(job):
            return evo(folder, job[0], job[1].split(), job[2], truth, estimate)

        ask(jobs[0])  # evo writes its settings at the first start: not twice at once
        with ThreadPoolExecutor(2) as pool:
            answers = list(pool.map(ask, jobs))
    wrong = [line for job, theirs in zip(jobs, answers) for line in differences(job, theirs)]
    compared = sum(len(theirs) for theirs in answers)
    print("\n".join(wrong) or f"{compared} statistics of {len(jobs)} runs of evo agree")
    return 1 if wrong or compared < 7 * len(jobs) else 0


if __name__ == "__main__":
    sys.exit(main())
