#!/usr/bin/env python3
"""usage: check_modules.py PREFIX LIBDIR SOURCE.c MARBLE.mtlx

Copies the installed package to another place, builds a C host against it there and sees what the
host loads, and what it says where a module is missing, broken, another one or of another build.
LIBDIR is the library's folder below the prefix.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import documents

PREFIX, LIBDIR, SOURCE, MARBLE = (pathlib.Path(argument) for argument in sys.argv[1:])


class Modules(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="nacre-moved-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.libraries = self.folder / "moved" / LIBDIR
        shutil.copytree(PREFIX, self.folder / "moved", symlinks=True)
        self.images = self.libraries / "nacre" / "nacre_images.so"
        self.colors = self.libraries / "nacre" / "nacre_colors.so"
        self.document, self.config = documents.write(self.folder)
        self.host = self.build()

    def build(self):
        environment = os.environ | {"PKG_CONFIG_PATH": str(self.libraries / "pkgconfig")}
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "nacre"], env=environment,
                               capture_output=True, text=True, check=True).stdout.split()
        host = self.folder / "host"
        subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", SOURCE,
                        "-o", host, *flags, f"-Wl,-rpath,{self.libraries}"], check=True)
        return host

    def run_host(self, *arguments):
        """Status, what was loaded after each step, and what was said."""
        done = subprocess.run([self.host, *arguments], capture_output=True, text=True, check=False)
        steps = [line.split(":", 1)[1].split() for line in done.stdout.splitlines()]
        return done.returncode, steps, done.stderr

    def assert_fails(self, said, code, *arguments):
        status, _, errors = self.run_host(*arguments)
        self.assertEqual(status, 1, errors)
        self.assertIn(f"[{code}]", errors)
        self.assertIn(said, errors)

    def assert_no_image(self, said):
        self.assert_fails(said, "no-image-reader", "outputs", self.document, "NG_image/out")
        # Everything else goes on.
        status, _, errors = self.run_host("outputs", MARBLE, "NG_marble/base_color")
        self.assertEqual(status, 0, errors)

    def test_what_is_not_used_is_not_loaded(self):
        status, steps, errors = self.run_host("outputs", MARBLE, "NG_marble/base_color",
                                              "outputs", self.document, "NG_image/out")
        self.assertEqual(status, 0, errors)
        self.assertEqual(steps[:3], [[], [], []])
        self.assertIn(str(self.images), steps[3])
        names = " ".join(steps[3])
        self.assertIn("libOpenImageIO.so", names)
        self.assertIn("libOpenEXR-", names)
        self.assertNotIn("nacre_colors.so", names)

    def test_a_configuration_loads_what_it_needs(self):
        status, steps, errors = self.run_host("colors", self.config)
        self.assertEqual(status, 0, errors)
        self.assertEqual(steps[0], [])
        names = " ".join(steps[1])
        self.assertIn(str(self.colors), steps[1])
        self.assertIn("libOpenColorIO.so", names)
        self.assertNotIn("libOpenImageIO.so", names)

    def test_missing_modules(self):
        self.images.unlink()
        self.assert_no_image(f"{self.images}")
        self.colors.unlink()
        self.assert_fails(f"{self.colors}", "no-color-reader", "colors", self.config)

    def test_file_that_is_no_library(self):
        self.images.write_text("no library\n", encoding="utf-8")
        self.assert_no_image("file too short")

    def test_another_module(self):
        shutil.copy(self.colors, self.images)
        self.assert_no_image("another module")

    def test_library_that_is_no_module(self):
        shutil.copy(self.libraries / "libnacre.so", self.images)
        self.assert_no_image("a library that is no module")

    def test_another_build(self):
        content = self.images.read_bytes()
        # The version and sixteen digits, of which the last one becomes another.
        key = re.search(rb"\d+\.\d+\.\d+ [0-9a-f]{16}\0", content)
        last = key.end() - 2
        other = b"1" if content[last:last + 1] == b"0" else b"0"
        self.images.write_bytes(content[:last] + other + content[last + 1:])
        self.assert_no_image("one of another build")

    def test_the_tool(self):
        tool = self.folder / "moved" / "bin" / "nacre"
        if not tool.exists():
            self.skipTest("there is no tool in this build")
        graph = ["--output", "NG_marble/base_color", "--size", "8", "--out", self.folder / "out"]
        wood = self.folder / "wood.mtlx"
        wood.write_text(documents.IMAGE_DOCUMENT.replace("grey.tga", "grey.jpg"), encoding="utf-8")
        documents.write_jpeg(self.folder / "grey.jpg")
        image = ["--output", "NG_image/out", "--size", "8", "--out", self.folder / "out"]
        for command, loads in ((["--version"], False), (["bake", wood, *image], False),
                               (["bake", self.document, *image], True), (["check", MARBLE], False),
                               (["inspect", MARBLE], False), (["bake", MARBLE, *graph], False),
                               (["bake", MARBLE, *graph, "--format", "tx"], True)):
            done = subprocess.run([tool, *command], env=os.environ | {"LD_DEBUG": "files"},
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr[-2000:])
            self.assertEqual("libOpenImageIO.so" in done.stderr, loads, command)
            self.assertEqual("libOpenColorIO.so" in done.stderr, loads, command)  # It needs that.
        (self.libraries / "nacre" / "nacre_image_writer.so").unlink()
        done = subprocess.run([tool, "bake", MARBLE, *graph, "--format", "tx"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("[cannot-write]", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
