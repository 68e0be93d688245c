#!/usr/bin/env python3
"""Feeds house.py what it must find, and what it must let pass."""

import pathlib
import unittest

import house


def findings(name, text):
    path = pathlib.PurePath(name)
    return [*house.check_path(path), *house.check_text(path, text.splitlines())]


class House(unittest.TestCase):
    def test_finds_what_is_wrong(self):
        for name, text in [
            ("sim/a.h", "\n" * 201),
            ("sim/a.cpp", "\n" * 401),
            ("sim/utils/a.h", ""),
            ("estimator/a.cpp", '#include "../sim/world.h"'),
            ("estimator/a.cpp", '#include "reckon/models/../sim/world.h"'),
            ("estimator/a.cpp", '#include "world.h"'),
            ("docs/a.md", "see iss" + "ue 12"),
            ("sim/a.cpp", "// fixes #" + "12"),
            ("sim/a.cpp", "// in /ho" + "me/someone/reckon"),
        ]:
            with self.subTest(name=name, text=text[:40]):
                self.assertEqual(len(findings(name, text)), 1)

    def test_lets_the_rest_pass(self):
        for name, text in [
            ("sim/a.h", "\n" * 200),
            ("estimator/a.cpp", '#include "reckon/models/pose.h"\n#include <vector>'),
            ("scenarios/a.yaml", "# 12 metres"),
            ("docs/a.md", "[a section](#1-a-section) &#39;"),
            ("docs/a.md", "out/work/a, $HOME/work/a"),
        ]:
            with self.subTest(name=name, text=text[:40]):
                self.assertEqual(findings(name, text), [])

    def test_counts_long_functions(self):
        lines = ["void Short() {", "}", "void Long(", "    int a) {", *["  a;"] * 40, "}"]
        self.assertEqual(house.long_functions(lines), (2, 1))


if __name__ == "__main__":
    unittest.main()
