#!/usr/bin/env python3
"""usage: check_test.py INCLUDE...

Plants changes in a copy of the headers and sees that check.py finds those that break hosts, and
lets pass those that do not.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check.py")
INCLUDES = []


class Changes(unittest.TestCase):
    def status(self, header: str, before: str, after: str) -> int:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for include in INCLUDES:
                shutil.copytree(include, folder / "include", dirs_exist_ok=True)
            file = folder / "include/nacre" / header
            text = file.read_text(encoding="utf-8")
            self.assertEqual(text.count(before), 1, f"{before!r} in {header}")
            file.write_text(text.replace(before, after), encoding="utf-8")
            return subprocess.run([sys.executable, CHECK, folder / "include", folder / "out"],
                                  capture_output=True, check=False).returncode

    def assert_breaks(self, *change: str) -> None:
        self.assertNotEqual(self.status(*change), 0)

    def assert_passes(self, *change: str) -> None:
        self.assertEqual(self.status(*change), 0)

    def test_nothing(self):
        self.assert_passes("report.h", "NACRE_STOPPED = 4", "NACRE_STOPPED = 4")

    def test_function_added(self):
        self.assert_passes("report.h", "/* NACRE_VERSION of", "NACRE_API int nacre_new(void);\n/* ")

    def test_function_gone(self):
        self.assert_breaks("report.h", "NACRE_API const char* nacre_version_text(void);", "")

    def test_function_renamed(self):
        self.assert_breaks("report.h", "nacre_version_text(void)", "nacre_version_string(void)")

    def test_argument_added(self):
        self.assert_breaks("report.h", "nacre_version(void)", "nacre_version(int which)")

    def test_argument_of_another_type(self):
        self.assert_breaks("report.h", "nacre_report_get(const nacre_report* report, size_t index",
                           "nacre_report_get(const nacre_report* report, int index")

    def test_result_of_another_type(self):
        self.assert_breaks("report.h", "NACRE_API size_t nacre_report_count",
                           "NACRE_API uint32_t nacre_report_count")

    def test_member_at_the_end(self):
        self.assert_passes("report.h", "} nacre_diagnostic;", "  int more;\n} nacre_diagnostic;")

    def test_member_in_the_middle(self):
        self.assert_breaks("report.h", "  const char* code;", "  int more[4];\n  const char* code;")

    def test_member_gone(self):
        self.assert_breaks("report.h", "  const char* path; ", "")

    def test_member_of_another_type(self):
        self.assert_breaks("report.h", "int severity;", "long severity;")

    def test_member_of_a_structure_without_size(self):
        self.assert_breaks("document.h", "} nacre_variant;", "  int more;\n} nacre_variant;")

    def test_constant_added(self):
        self.assert_passes("report.h", "NACRE_STOPPED = 4,", "NACRE_STOPPED = 4, NACRE_MORE = 9,")

    def test_constant_changed(self):
        self.assert_breaks("report.h", "NACRE_STOPPED = 4", "NACRE_STOPPED = 6")

    def test_constant_gone(self):
        self.assert_breaks("report.h", "NACRE_STOPPED = 4,", "")


if __name__ == "__main__":
    INCLUDES = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
