#!/usr/bin/env python3
"""usage: check_image_input.py PREFIX LIBDIR MARBLE.mtlx

Copies the installed package to another place and has programs of OpenImageIO, to which nothing is
told but where its plug-in is, read graph outputs. LIBDIR is the library's folder below the prefix.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PREFIX, LIBDIR, MARBLE = (pathlib.Path(argument) for argument in sys.argv[1:])

NAME = f"{MARBLE}?output=NG_marble/base_color&size=200x150"


class ImageInput(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="nacre-moved-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.moved = self.folder / "moved"
        shutil.copytree(PREFIX, self.moved, symlinks=True)
        self.plug_ins = self.moved / LIBDIR / "nacre" / "openimageio"

    def run_program(self, *command, status=0):
        done = subprocess.run(command, cwd=self.folder, text=True, check=False,
                              env={"PATH": os.environ["PATH"],
                                   "OIIO_LIBRARY_PATH": str(self.plug_ins)},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, status, done.stdout)
        return done.stdout

    def test_the_folder_has_the_plug_in_alone(self):
        self.assertEqual(os.listdir(self.plug_ins), ["mtlx.imageio.so"])

    def test_texels_are_those_of_the_installed_tool(self):
        self.run_program(self.moved / "bin" / "nacre", "bake", MARBLE, "--output",
                         "NG_marble/base_color", "--size", "200x150", "--format", "exr", "--out",
                         ".", "--no-cache", "-q")
        self.run_program("idiff", "-fail", "0", NAME, "NG_marble.base_color.exr")

    def test_everything_is_found_from_there(self):
        # The data library, and the program that compiles: their absence would be a warning.
        printed = self.run_program("oiiotool", "--info", "-v", NAME)
        self.assertIn("200 x  150, 3 channel, float mtlx", printed)
        self.assertNotIn("mtlx:warnings", printed)
        (self.moved / "libexec" / "nacre" / "nacre-compile-worker").unlink()
        printed = self.run_program("oiiotool", "--info", "-v", NAME)
        self.assertIn("[no-worker]", printed)
        # Which is no problem of a document.
        self.run_program(self.moved / "bin" / "nacre", "check", MARBLE)

    def test_the_module_is_of_the_same_build(self):
        module = self.plug_ins.parent / "nacre_graphs.so"
        content = module.read_bytes()
        # The version and sixteen digits, of which the last one becomes another.
        key = re.search(rb"\d+\.\d+\.\d+ [0-9a-f]{16}\0", content)
        last = key.end() - 2
        other = b"1" if content[last:last + 1] == b"0" else b"0"
        module.write_bytes(content[:last] + other + content[last + 1:])
        self.assertIn("of another build than the plug-in",
                      self.run_program("iinfo", NAME, status=1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
