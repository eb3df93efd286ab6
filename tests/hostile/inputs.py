#!/usr/bin/env python3
"""usage: inputs.py NACRE [--first] [--share N] [--folder FOLDER] [WORD...]

Gives the tool what crashed an earlier version, took all memory or never ended, and variants of it.
Each ends with status 0 or 1, within 5 s of processor time and 1 GiB; with 1 where it says an error,
which names a file. --first: one of each class. --share: so many times as much, for builds with
sanitizers. --folder: the files of a folder instead. WORDs choose among the names of classes.
"""

import argparse
import pathlib
import shutil
import sys
import tempfile

import hostile_documents
import hostile_files
from outcome import run

SECONDS, MEGABYTES = 5, 1024
PLASTIC = pathlib.Path(__file__).resolve().parents[2] / "examples" / "documents" / "plastic.mtlx"
TEXTURE = ('<materialx version="1.39"><image name="i" type="color3"><input name="file" type="filename" value="%s"/>'
           '</image><output name="out" type="color3" nodename="i"/></materialx>\n')


def with_document(path, out):
    yield ["check", "--quiet", path]
    yield ["bake", "--quiet", path, "--size", "4", "--no-cache", "--out", out]
    if 'type="material"' in path.read_text(errors="replace"):
        yield ["render", "--quiet", path, "--material", "M", "--spp", "1", "--size", "4x4", "--no-cache",
               "--out", out / "a.exr"]


def render(out, *more):
    return ["render", "--quiet", PLASTIC, "--material", "Plastic", "--spp", "1", "--size", "8x8", "--no-cache",
            "--out", out / "a.exr", *more]


def with_image(path, out):
    yield render(out, "--environment", path)
    document = path.parent / "image.mtlx"
    document.write_text(TEXTURE % path.name)
    yield ["bake", "--quiet", document, "--size", "4", "--no-cache", "--out", out]


def with_scene(path, out):
    yield render(out, "--scene", path)


def with_file(path, out):
    kind = path.suffix
    if kind == ".mtlx":
        yield from with_document(path, out)
    elif kind in (".gltf", ".glb", ".obj"):
        yield from with_scene(path, out)
    elif kind not in (".glsl", ".md"):
        yield from with_image(path, out)


def judge(outcome, share):
    if "[no-data-library]" in outcome.said:
        return "found no data library, and so tried nothing; set NACRE_MATERIALX_LIBRARIES"
    if outcome.status not in (0, 1):
        return f"ended with {outcome.status}"
    if outcome.busy > SECONDS * share:
        return f"took {outcome.busy:.1f} s"
    if outcome.megabytes > MEGABYTES * share:
        return f"took {outcome.megabytes:.0f} MB"
    error = ": error: " in outcome.said or outcome.said.startswith("error: ")
    if error != (outcome.status == 1):
        return f"status {outcome.status}, and said {outcome.said[:200]!r}"
    return ""


class Runner:
    def __init__(self, arguments):
        self.arguments, self.faults, self.runs = arguments, 0, 0

    def give(self, name, build, commands):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
            folder = pathlib.Path(temporary)
            (folder / "out").mkdir()
            for command in commands(build(folder), folder / "out"):
                # What maps its shadow has no use for such a limit.
                room = (8 << 30) if self.arguments.share == 1 else None
                outcome = run([self.arguments.nacre, *command], 60 * self.arguments.share, room)
                fault = judge(outcome, self.arguments.share)
                self.faults += bool(fault)
                self.runs += 1
                print(f"{name:36} {command[0]:7} {outcome.busy:6.2f} s {outcome.megabytes:6.0f} MB  {outcome.status}  "
                      f"{', '.join(sorted(outcome.codes)) or '-'}{'  FAULT: ' + fault if fault else ''}", flush=True)

    def give_all(self, name, builders, commands):
        if self.arguments.words and not any(word in name for word in self.arguments.words):
            return
        for i, build in enumerate(builders[:1] if self.arguments.first else builders):
            self.give(f"{name} {i}", build, commands)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("nacre")
    parser.add_argument("--first", action="store_true")
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_intermixed_args()
    runner = Runner(arguments)
    if arguments.folder:
        for file in sorted(arguments.folder.iterdir()):
            # With all that is beside it: documents name texts.
            runner.give(file.name, lambda folder, file=file: pathlib.Path(shutil.copytree(
                arguments.folder, folder / "in")) / file.name, with_file)
    else:
        for name, builders in hostile_documents.CLASSES.items():
            runner.give_all(name, builders, with_document)
        runner.give_all("images", hostile_files.IMAGES, with_image)
        runner.give_all("scenes", hostile_files.SCENES, with_scene)
    print(f"{runner.runs} runs, {runner.faults} faults")
    return 1 if runner.faults or not runner.runs else 0


if __name__ == "__main__":
    sys.exit(main())
