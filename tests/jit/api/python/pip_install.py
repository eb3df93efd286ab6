#!/usr/bin/env python3
"""usage: pip_install.py SOURCE WORK [SETTING=VALUE]...

`pip install SOURCE` in a fresh virtual environment below the folder WORK, with what pip fetches
and these settings of scikit-build-core; then the example and the tests of the Python module on
that. Builds the library once more, into WORK/build, which is kept for the next time.
"""

import os
import pathlib
import shutil
import subprocess
import sys


def main() -> None:
    source, work = (pathlib.Path(each).resolve() for each in sys.argv[1:3])
    settings = [f"--config-settings={each}" for each in [f"build-dir={work / 'build'}",
                                                         *sys.argv[3:]]]
    work.mkdir(parents=True, exist_ok=True)
    environment = {name: value for name, value in os.environ.items()
                   if name not in ("PYTHONPATH", "NACRE_TOOL", "NACRE_MATERIALX_LIBRARIES")}
    environment |= {"MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1"}

    def run(*command: object, folder: pathlib.Path = work) -> str:
        print("+", *command, flush=True)
        done = subprocess.run([str(each) for each in command], cwd=folder, env=environment,
                              stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}\nstatus {done.returncode}")
        return done.stdout

    venv = work / "venv"
    shutil.rmtree(venv, ignore_errors=True)
    run(sys.executable, "-m", "venv", venv)
    python = venv / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", *settings, f"{source}[examples]", "pytest")

    # What is installed, and not what this project's folder has.
    package = pathlib.Path(run(python, "-c", "import nacre; print(nacre.__file__, end='')")).parent
    assert package.is_relative_to(venv), package
    library = run(python, "-c", "import nacre; print(nacre.data_library(), end='')")
    assert pathlib.Path(library).is_relative_to(venv), library
    assert "bake" in run(venv / "bin" / "nacre", "--help")

    tests = source / "tests" / "jit" / "api" / "python"
    run(python, source / "examples" / "python" / "tour.py", work / "tour", 48)
    run(python, tests / "check_tour.py", work / "tour")
    print(run(python, "-m", "pytest", "-q", "-p", "no:cacheprovider", tests))


if __name__ == "__main__":
    main()
