#!/usr/bin/env python3
"""usage: security.py ROOT NACRE

The limits that SECURITY.md lists, with their defaults, are those that the tool shows.
"""

import pathlib
import re
import subprocess
import sys

ROW = re.compile(r"^\| `(--[a-z-]+)` \| ([0-9.]+) \|.*\| `(\w+)::(\w+)` \|$", re.MULTILINE)
OPTION = re.compile(r"^  (--max-[a-z-]+) (?:(?!^  -).)*?\(default:\s+([0-9.]+)\)", re.MULTILINE | re.DOTALL)


def shown(nacre: str, command: str) -> dict[str, str]:
    text = subprocess.run([nacre, command, "--help-all"], capture_output=True, text=True, check=True).stdout
    limits = text[text.index("Limits, beyond which"):]
    return dict(OPTION.findall(limits))


def main() -> int:
    root, nacre = pathlib.Path(sys.argv[1]), sys.argv[2]
    rows = ROW.findall((root / "SECURITY.md").read_text(encoding="utf-8"))
    faults = []
    for command in ("bake", "check", "inspect", "render"):
        limits = shown(nacre, command)
        # Only these have a scene.
        listed = {flag: default for flag, default, structure, _ in rows
                  if structure != "SceneLimits" or command in ("bake", "render")}
        if not limits:
            faults.append(f"nacre {command} --help-all shows no limits")
        for flag in sorted(limits.keys() | listed.keys()):
            said, is_there = listed.get(flag, "nothing"), limits.get(flag, "nothing")
            if said != is_there:
                faults.append(f"SECURITY.md says {said} of {flag}, nacre {command} {is_there}")
    sources = "\n".join(file.read_text(encoding="utf-8") for folder in ("runtime", "jit", "examples/render")
                        for file in sorted((root / folder).rglob("*.h")))
    for _, _, structure, member in rows:
        body = re.search(rf"struct {structure} \{{(.*?)^\}};", sources, re.DOTALL | re.MULTILINE)
        if body is None or not re.search(rf"\b{member}\b", body[1]):
            faults.append(f"SECURITY.md names {structure}::{member}, which is not there")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
