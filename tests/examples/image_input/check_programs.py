#!/usr/bin/env python3
"""usage: check_programs.py FOLDER MARBLE.mtlx

Has the programs of OpenImageIO open graph outputs as images, by the plug-in in FOLDER: their
environment says where that is, and nothing else is told them.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER, MARBLE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])

COLOR = "output=NG_marble/base_color"


class Programs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="nacre-programs-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(MARBLE, self.folder / "marble.mtlx")

    def run_program(self, *command):
        """Status, and all that is printed."""
        return self.run_with({"OIIO_LIBRARY_PATH": str(FOLDER)}, *command)

    def run_with(self, environment, *command):
        done = subprocess.run(command, cwd=self.folder, text=True, check=False,
                              env={"PATH": os.environ["PATH"]} | environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def good(self, *command):
        status, printed = self.run_program(*command)
        self.assertEqual(status, 0, printed)
        return printed

    def test_the_plug_in_is_known(self):
        printed = self.good("oiiotool", "--help")
        self.assertRegex(printed, r"Input formats supported: .*\bmtlx\b")
        self.assertRegex(printed, r"(?s)Dependent libraries: .*Nacre \d+\.\d+\.\d+")

    def test_only_what_openimageio_needs_is_shown(self):
        printed = self.good("nm", "-D", "--defined-only", FOLDER / "mtlx.imageio.so")
        self.assertEqual(sorted(line.split()[2] for line in printed.splitlines()),
                         ["mtlx_imageio_library_version", "mtlx_imageio_version",
                          "mtlx_input_extensions", "mtlx_input_imageio_create"])

    def test_only_graphs_load_what_shades_them(self):
        self.good("oiiotool", "--create", "8x8", "3", "-o", "black.exr")
        watched = {"OIIO_LIBRARY_PATH": str(FOLDER), "LD_DEBUG": "files"}
        status, printed = self.run_with(watched, "iinfo", "black.exr")
        self.assertEqual(status, 0)
        self.assertIn("mtlx.imageio.so", printed)
        self.assertNotIn("libnacre", printed)
        self.assertNotIn("libLLVM", printed)
        status, printed = self.run_with(watched, "iinfo", f"marble.mtlx?{COLOR}")
        self.assertEqual(status, 0)
        self.assertIn("libnacre", printed)

    def test_a_plug_in_without_its_module_says_so(self):
        moved = self.folder / "moved" / "openimageio"
        shutil.copytree(FOLDER, moved)
        module = moved.parent / "nacre_graphs.so"
        name = f"marble.mtlx?{COLOR}&size=64"
        for said in ("cannot be loaded", "file too short", "of another build"):
            status, printed = self.run_with({"OIIO_LIBRARY_PATH": str(moved)}, "iinfo", name)
            self.assertGreaterEqual(status, 0, printed)
            self.assertIn(f"{module}: error: what shades graphs", printed)
            self.assertIn(said, printed)
            self.assertIn("[no-module]", printed)
            if module.exists():
                shutil.copy(moved / "mtlx.imageio.so", module)  # A library, but not that one.
            else:
                module.write_text("no library\n", "utf-8")

    def test_information(self):
        printed = self.good("oiiotool", "--info", "-v", f"marble.mtlx?{COLOR}&size=2048")
        for text in ("2048 x 2048, 3 channel, float mtlx", "tile size: 64 x 64",
                     "2048x2048 1024x1024 512x512", "channel list: R, G, B",
                     'oiio:ColorSpace: "Linear"', 'textureformat: "Plain Texture"'):
            self.assertIn(text, printed)
        self.assertIn("4096 x 4096", self.good("iinfo", f"marble.mtlx?{COLOR}&size=4096"))

    def test_a_texture_is_made_with_all_levels(self):
        name = f"marble.mtlx?{COLOR}&size=256"
        self.good("oiiotool", name, "-o", "x.tx")
        printed = self.good("oiiotool", "--info", "-v", "x.tx")
        self.assertIn("tile size: 64 x 64", printed)
        self.assertIn("256x256 128x128 64x64 32x32 16x16 8x8 4x4 2x2 1x1", printed)
        self.assertIn("PASS", self.good("idiff", "-a", "-fail", "0", name, "x.tx"))

    def test_maketx_takes_a_text_file(self):
        (self.folder / "marble.mtlxtex").write_text(f"marble.mtlx?{COLOR}&size=256\n", "utf-8")
        self.good("maketx", "marble.mtlxtex", "-o", "y.tx")
        self.assertIn("(+mipmap)", self.good("oiiotool", "--info", "y.tx"))
        self.assertIn("PASS", self.good("idiff", "-fail", "0", "marble.mtlxtex", "y.tx"))

    def test_pictures_are_converted(self):
        name = f"marble.mtlx?{COLOR}&size=128"
        self.good("oiiotool", name, "--colorconvert", "linear", "sRGB", "-d", "uint8", "-o", "x.png")
        # Back to what it was within half a code, which is at most 1/255 of what is light.
        self.good("idiff", "-fail", "0.006", name, self.linear("x.png"))

    def linear(self, name):
        self.good("oiiotool", name, "--colorconvert", "sRGB", "linear", "-d", "float", "-o", "x.exr")
        return "x.exr"

    def test_a_configuration_says_what_is_wanted(self):
        printed = self.good("oiiotool", "-iconfig", "mtlx:output", "NG_marble/roughness", "-iconfig",
                            "mtlx:size", "96", "marble.mtlx", "--printinfo")
        self.assertIn("96 x   96, 1 channel", printed)

    def test_what_is_wrong_is_said(self):
        for name, said in (
                ("marble.mtlx", "expected '?output=' and one of NG_marble/base_color"),
                ("marble.mtlx?output=NG_marble/none", "marble.mtlx:3:2: error: the document has no"),
                (f"marble.mtlx?{COLOR}&size=0", "expected N or WxH with 1 to 65536 texels, found '0'"),
                (f"marble.mtlx?{COLOR}&sise=64", "found 'sise'"),
                ("none.mtlx?output=a", "none.mtlx: error: there is no such file")):
            status, printed = self.run_program("iinfo", name)
            self.assertIn(said, printed)
            self.assertGreaterEqual(status, 0, printed)  # No signal ended it.
            for program in ("oiiotool", "maketx", "idiff"):
                status, printed = self.run_program(program, name, "-o", "never.tx")
                self.assertGreater(status, 0, printed)
        self.assertFalse((self.folder / "never.tx").exists())

    def test_oiiotool_says_it_of_files(self):
        for line in ("marble.mtlx?output=none", "marble.mtlx", "marble.exr"):
            (self.folder / "wrong.mtlxtex").write_text(line, "utf-8")
            status, printed = self.run_program("oiiotool", "--info", "wrong.mtlxtex")
            self.assertEqual(status, 1, printed)
            self.assertRegex(printed, r"marble.mtlx:?.*: error: .* \[|names no document")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
