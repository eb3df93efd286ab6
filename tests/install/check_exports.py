#!/usr/bin/env python3
"""usage: check_exports.py LIBRARY

Fails unless every symbol that LIBRARY defines for others is of namespace nacre (or nacre_* in C),
and there is at least one.
"""

import re
import subprocess
import sys

OURS = re.compile(
    r"nacre::|nacre_\w+$|"
    r"(typeinfo|typeinfo name|vtable|VTT|construction vtable) for nacre::|"
    r"(non-)?virtual thunk to nacre::")


def main() -> int:
    listing = subprocess.run(["nm", "--dynamic", "--demangle", "--defined-only", "--extern-only",
                              sys.argv[1]],
                             capture_output=True, text=True, check=True).stdout
    # "0000000000003cd0 T nacre::is_closure(nacre::Type)"; version names have type A.
    symbols = [line.split(maxsplit=2) for line in listing.splitlines()]
    names = [symbol[2] for symbol in symbols if symbol[1] != "A"]
    foreign = [name for name in names if not OURS.match(name)]
    for name in foreign:
        print(f"exported, but not ours: {name}")
    if not names:
        print(f"{sys.argv[1]} exports nothing")
    return 1 if foreign or not names else 0


if __name__ == "__main__":
    sys.exit(main())
