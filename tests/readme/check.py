#!/usr/bin/env python3
"""The README shows the embedding example as it is built, and links to files that exist."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
text = (root / "README.md").read_text(encoding="utf-8")
faults = []

example = (root / "examples/embed/main.cpp").read_text(encoding="utf-8").rstrip()
if example not in text:
    faults.append("README.md does not contain examples/embed/main.cpp as it is")

for document in ("README.md", "HACKING.md", "SECURITY.md"):
    for target in re.findall(r"\]\(([^)#]+)\)", (root / document).read_text(encoding="utf-8")):
        if "://" not in target and not (root / target).exists():
            faults.append(f"{document}: links to {target}, which does not exist")

print("\n".join(faults))
sys.exit(1 if faults else 0)
