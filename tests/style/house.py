#!/usr/bin/env python3
"""The house's rules that no compiler checks: sizes, folders, includes, and words that don't belong
in the tree. Prints what breaks them; exits 1 if anything does."""

import pathlib
import re
import subprocess
import sys

MAX_LINES = {".h": 200, ".cpp": 400}
LONG_SHARE = 0.05  # of functions may be longer than forty lines
BANNED_FOLDERS = {"common", "utils", "util", "misc", "helpers"}
LAYERS = "models|estimator|sim|ground_truth|harness|render"
INCLUDE = re.compile(r'#\s*include\s*(["<])([^">]+)')
# Numbers of issues, and absolute paths of somebody's machine.
FOREIGN = re.compile(r"(?i)\bissues? #?\d|(?<![\w#&(])#\d+\b|(?<![\w.$}])/(?:home|root|Users|work)/")
SIGNATURE = re.compile(r"^(?!\s|#|//|}|using |namespace |class |struct |enum )[^;]*\([^;]*$")


def sources(root):
    """Every file that git tracks or would track; everything outside of build/ and out/ without git."""
    run = subprocess.run(["git", "-C", root, "ls-files", "-z", "-co", "--exclude-standard"],
                         capture_output=True, text=True)
    if run.returncode == 0:
        names = run.stdout.split("\0")
    else:
        names = (str(path.relative_to(root)) for path in pathlib.Path(root).rglob("*"))
    skipped = {"build", "out", ".git"}
    for name in sorted(filter(None, names)):
        path = pathlib.PurePath(name)
        if path.parts[0] not in skipped and pathlib.Path(root, name).is_file():
            yield path


def check_text(path, lines):
    """What is wrong in one file, as (line number, sentence)."""
    limit = MAX_LINES.get(path.suffix)
    if limit and len(lines) > limit:
        yield len(lines), f"{len(lines)} lines, at most {limit}"
    for number, line in enumerate(lines, 1):
        if FOREIGN.search(line):
            yield number, f"names an issue or somebody's machine: {line.strip()}"
        include = INCLUDE.match(line) if limit else None
        if include and ".." in include[2].split("/"):
            yield number, "an include must not climb out of its folder"
        elif include and include[1] == '"' and path.parts[0] in LAYERS.split("|") and \
                not re.match(rf"reckon/({LAYERS})/", include[2]) and include[2] != "reckon/build_info.h":
            yield number, f'write "reckon/<layer>/<file>.h", not "{include[2]}"'


def check_path(path):
    """What is wrong with where a file lies."""
    banned = BANNED_FOLDERS.intersection(path.parts[:-1])
    if banned:
        yield 1, f"no folder is called {banned.pop()}/"


def long_functions(lines, limit=40):
    """(all, long): how many functions there are, by where clang-format puts names and braces."""
    lengths, start = [], None
    for number, line in enumerate(lines):
        if SIGNATURE.match(line):
            start = number
        elif start is not None and line == "}":
            lengths.append(number - start + 1)
            start = None
    return len(lengths), sum(length > limit for length in lengths)


def main(root):
    findings, functions, too_long = [], 0, 0
    for path in sources(root):
        try:
            lines = pathlib.Path(root, path).read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue
        found = [*check_path(path), *check_text(path, lines)]
        findings += [f"{path}:{number}: {sentence}" for number, sentence in found]
        if path.suffix == ".cpp":
            count, long = long_functions(lines)
            functions, too_long = functions + count, too_long + long
    print("\n".join(findings))
    print(f"{len(findings)} findings; {too_long} of {functions} functions are longer than 40 lines")
    return 1 if findings or too_long > LONG_SHARE * functions else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
