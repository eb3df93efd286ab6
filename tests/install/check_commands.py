#!/usr/bin/env python3
"""usage: check_commands.py PREFIX

The manual's pages of the installed program and what bash completes know every command and option
that --help-all shows, and none that there is not; pages are set without a warning.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

OPTION = re.compile(r"^  ((?:-[a-zA-Z-]+(?:, )?)+)", re.MULTILINE)
ITEM = re.compile(r"^\.TP\n\\fB(.*?)\\fR", re.MULTILINE)


def output_of(*command: str, folder: str | None = None) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder).stdout


def names_in(lists: list[str]) -> set[str]:
    return {name for names in lists for name in names.split(", ")}


class Check:
    def __init__(self, prefix: pathlib.Path) -> None:
        self.nacre = str(prefix / "bin" / "nacre")
        self.pages = prefix / "share" / "man" / "man1"
        self.script = prefix / "share" / "bash-completion" / "completions" / "nacre"
        self.share = prefix / "share"
        self.faults: list[str] = []

    def complete(self, *words: str, folder: str | None = None) -> set[str]:
        """What bash has for the last of the words of a command line."""
        line = " ".join(map(shlex.quote, words))
        script = (f"source {shlex.quote(str(self.script))}\n"
                  "function=$(complete -p nacre); function=${function#*-F }; function=${function%% *}\n"
                  f"COMP_WORDS=(nacre {line}); COMP_CWORD={len(words)}\n"
                  "$function nacre; printf '%s\\n' \"${COMPREPLY[@]}\"")
        return set(output_of("bash", "--norc", "-c", script, folder=folder).split("\n")) - {""}

    def want(self, what: str, found: set[str], wanted: set[str]) -> None:
        for name in sorted(found ^ wanted):
            self.faults.append(f"{what}: {name} is {'there' if name in found else 'missing'}")

    def page(self, name: str, options: set[str]) -> None:
        page = self.pages / f"{name}.1"
        if not page.exists():
            self.faults.append(f"there is no {page}")
            return
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", str(page)],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0 or done.stderr:
            self.faults.append(done.stderr)
        text = page.read_text(encoding="utf-8")
        listed = text[text.index(".SH OPTIONS"):text.index(".SH EXAMPLES")]
        self.want(page.name, names_in([item.replace("\\-", "-") for item in ITEM.findall(listed)]),
                  options)

    def commands(self) -> list[str]:
        listed = re.search(r"^Commands:\n((?:  .*\n)+)", output_of(self.nacre, "--help"), re.MULTILINE)
        assert listed is not None
        return re.findall(r"^  (\w+)", listed[1], re.MULTILINE)

    def run(self) -> list[str]:
        commands = self.commands()
        top = names_in(OPTION.findall(output_of(self.nacre, "--help-all")))
        self.want("pages", {page.name for page in self.pages.iterdir()},
                  {"nacre.1"} | {f"nacre-{each}.1" for each in commands})
        self.want("commands", self.complete(""), set(commands) | top)
        self.page("nacre", top)
        for command in commands:
            options = names_in(OPTION.findall(output_of(self.nacre, command, "--help-all")))
            self.page(f"nacre-{command}", options)
            self.want(f"options of {command}", self.complete(command, "-"), options)
            # Short help fits a screen.
            lines = output_of(self.nacre, command, "--help").splitlines()
            if len(lines) > 40 or max(map(len, lines)) > 80:
                self.faults.append(f"nacre {command} --help has {len(lines)} lines")
        self.want("formats", self.complete("bake", "--format", ""), {"exr", "png", "tx"})
        self.want("a beginning", self.complete("bake", "--format", "e"), {"exr"})
        self.want("--format=", self.complete("bake", "--format", "=", "p"), {"png"})
        self.want("shells", self.complete("completion", ""), {"bash", "fish", "zsh"})
        self.want("a size", self.complete("bake", "--size", ""), set())
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a b.mtlx", "a.png"):
                pathlib.Path(folder, name).touch()
            pathlib.Path(folder, "all").mkdir()
            self.want("documents", self.complete("bake", "a", folder=folder), {"a b.mtlx", "all"})
            self.want("folders", self.complete("bake", "--out", "", folder=folder), {"all"})
            self.want("files", self.complete("render", "--scene", "a.", folder=folder), {"a.png"})
        for name in ("fish/vendor_completions.d/nacre.fish", "zsh/site-functions/_nacre"):
            text = (self.share / name).read_text(encoding="utf-8")
            shell = "fish" if "fish" in name else "zsh"
            if text != output_of(self.nacre, "completion", shell):
                self.faults.append(f"{name} is not what the program prints")
        return self.faults


def main() -> int:
    faults = Check(pathlib.Path(sys.argv[1]).resolve()).run()
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
