#!/usr/bin/env python3
"""usage: check_exports.py LIBRARY INCLUDE

Fails unless what LIBRARY exports is just what the headers in INCLUDE/nacre declare, and no more than
600 symbols.
"""

import pathlib
import re
import subprocess
import sys

MOST_SYMBOLS = 600
# "NACRE_API nacre_status nacre_report_create(" and "NACRE_API const char* nacre_version_text(".
DECLARED = re.compile(r"^NACRE_API\b[^;(]*?\b(nacre_\w+)\(", re.MULTILINE)


def main() -> int:
    library, include = sys.argv[1:]
    listing = subprocess.run(["nm", "--dynamic", "--defined-only", "--extern-only", library],
                             capture_output=True, text=True, check=True).stdout
    # "0000000000003cd0 T nacre_run"; version names have type A.
    symbols = [line.split(maxsplit=2) for line in listing.splitlines()]
    exported = {symbol[2] for symbol in symbols if symbol[1] != "A"}
    declared = {name for header in pathlib.Path(include, "nacre").glob("*.h")
                for name in DECLARED.findall(header.read_text(encoding="utf-8"))}
    for name in sorted(exported - declared):
        print(f"exported, but in no header: {name}")
    for name in sorted(declared - exported):
        print(f"declared, but not exported: {name}")
    print(f"{len(exported)} symbols")
    return 0 if exported and exported == declared and len(exported) <= MOST_SYMBOLS else 1


if __name__ == "__main__":
    sys.exit(main())
