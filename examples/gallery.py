#!/usr/bin/env python3
"""Renders every material and bakes every graph output of MaterialX documents.

usage: gallery.py --nacre build/bin/nacre --out FOLDER [--scene FILE] [--allow-outside] DOCUMENT...

Writes FOLDER/rendered/NAME.png, FOLDER/baked/NAME/..., one labelled sheet
FOLDER/gallery.png and FOLDER/log.txt with what nacre said. Ends with status 1 if
anything failed; missing images are not failures, but are counted.
"""

import argparse
import pathlib
import re
import subprocess
import sys


def materials(document):
    """Names of the document's material nodes; raw <UDIM> may stand in values, so no XML parser."""
    text = document.read_text(encoding="utf-8")
    return re.findall(r'<surfacematerial\s[^>]*?name="([^"]+)"', text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("documents", nargs="+", type=pathlib.Path)
    parser.add_argument("--nacre", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--scene")
    parser.add_argument("--search-path", action="append", default=[], help="as nacre's, for images")
    parser.add_argument("--allow-outside", action="store_true", help="as nacre's, for images")
    parser.add_argument("--size", default="256")
    parser.add_argument("--spp", default="64")
    parser.add_argument("--bake-size", default="64")
    parser.add_argument("--columns", default="8")
    arguments = parser.parse_args()

    rendered = arguments.out / "rendered"
    rendered.mkdir(parents=True, exist_ok=True)
    pictures, failures, missing = [], [], 0
    with open(arguments.out / "log.txt", "w", encoding="utf-8") as log:

        def run(what, command):
            nonlocal missing
            done = subprocess.run(command, capture_output=True, text=True)
            log.write(f"== {what}\n{done.stdout}{done.stderr}")
            missing += done.stderr.count("[missing-image]") + done.stderr.count("[image-outside]")
            if done.returncode != 0 and "[nothing-to-bake]" not in done.stderr:
                failures.append(what)
                print(f"failed: {what}\n{done.stderr}", file=sys.stderr)
            return done.returncode == 0

        for document in arguments.documents:
            images = ["--missing-images", "default"]
            for folder in arguments.search_path:
                images += ["--search-path", folder]
            if arguments.allow_outside:
                images.append("--allow-outside")
            bake = [arguments.nacre, "bake", str(document), "--size", arguments.bake_size, *images]
            run(f"bake {document.stem}", bake + ["--out", str(arguments.out / "baked" / document.stem)])
            for material in materials(document):
                picture = rendered / f"{document.stem}.{material}.png"
                render = [arguments.nacre, "render", str(document), "--material", material]
                render += ["--spp", arguments.spp, "--size", arguments.size, "--out", str(picture), *images]
                if arguments.scene:
                    render += ["--scene", arguments.scene, "--ground"]
                if run(f"render {document.stem} {material}", render):
                    pictures.append(picture)
                    print(picture)

    sheet = pathlib.Path(__file__).with_name("contact_sheet.py")
    subprocess.run(
        [sys.executable, sheet, arguments.out / "gallery.png", *pictures]
        + ["--columns", arguments.columns, "--size", "192"],
        check=True,
    )
    print(f"{len(pictures)} rendered, {len(failures)} failed, {missing} complaints about images")
    print(arguments.out / "gallery.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
