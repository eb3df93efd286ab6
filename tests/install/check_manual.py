#!/usr/bin/env python3
"""usage: check_manual.py PAGE INCLUDE

Fails unless the manual page is set without a warning and names every function of the headers in
INCLUDE/nacre, and none that there is not.
"""

import pathlib
import re
import subprocess
import sys

from check_exports import DECLARED


def main() -> int:
    page, include = sys.argv[1:]
    done = subprocess.run(["groff", "-mandoc", "-Tutf8", "-ww", "-z", page], capture_output=True,
                          text=True, check=False)
    print(done.stderr)
    named = set(re.findall(r"^\.Fn (nacre_\w+)", pathlib.Path(page).read_text(encoding="utf-8"),
                           re.MULTILINE))
    declared = {name for header in pathlib.Path(include, "nacre").glob("*.h")
                for name in DECLARED.findall(header.read_text(encoding="utf-8"))}
    for name in sorted(declared ^ named):
        print(f"{name}: {'no function' if name in named else 'not in the page'}")
    return 1 if done.returncode != 0 or done.stderr or named != declared else 0


if __name__ == "__main__":
    sys.exit(main())
