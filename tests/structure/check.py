#!/usr/bin/env python3
"""usage: check.py ROOT CHECK

Runs one check over the source tree and prints every fault; exit status 1 if there is one.
"""

import pathlib
import sys

import dependencies
import form


def main() -> int:
    checks = {check.__name__: check for check in dependencies.CHECKS + form.CHECKS}
    if len(sys.argv) != 3 or sys.argv[2] not in checks:
        print(f"usage: check.py ROOT {'|'.join(checks)}", file=sys.stderr)
        return 2
    check = checks[sys.argv[2]]
    faults = check(pathlib.Path(sys.argv[1]))
    if faults:
        print(check.__doc__)
        print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
