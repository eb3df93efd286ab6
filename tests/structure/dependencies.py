"""Which folder may include which, and where a heavy dependency may show."""

import pathlib

import tree

# Folder -> folders it may include. The longest folder that holds a file decides.
MAY_INCLUDE = {
    "runtime": ("runtime",),
    "nodes": ("nodes", "runtime"),
    "pbs": ("pbs", "runtime"),
    "jit": ("jit", "nodes", "pbs", "runtime"),
    "bench": ("bench", "examples/measure", "jit", "nodes", "pbs", "runtime"),
    "examples": ("examples", "jit", "nodes", "pbs", "runtime"),
    "examples/image_input": ("examples/image_input",),
    "tests": ("jit", "nodes", "pbs", "runtime", "tests"),
    "tests/conformance": ("examples", "jit", "nodes", "pbs", "runtime", "tests"),
    "tests/examples": ("examples", "jit", "nodes", "pbs", "runtime", "tests"),
    "tests/examples/image_input": ("examples/image_input", "tests"),
    "tests/examples/render": ("examples", "runtime", "tests"),
    "tests/fuzz": ("examples", "jit", "nodes", "pbs", "runtime", "tests"),
}

# The path through jit/: a stage includes itself and what comes before, never what comes after.
# The longest folder that holds a file decides.
JIT_STAGES = ("jit/document", "jit/graph/look", "jit/graph", "jit/graph/color",
              "jit/graph/resolve", "jit/graph/build", "jit/graph/check", "jit/ocio", "jit/glsl",
              "jit/record", "jit/passes", "jit/llvm", "jit/cache", "jit/worker",
              "jit/service", "jit/compile", "jit/shading", "jit/tune", "jit/api")

# Start of an include from outside -> the folders that may have it.
QUARANTINE = {
    "OpenColorIO/": ("jit/ocio/opencolorio", "tests/jit/ocio"),
    "OpenImageIO/": ("bench/textures", "examples/image_input", "examples/image_writer",
                     "runtime/texture/openimageio", "tests/examples", "tests/runtime/texture"),
    "benchmark/": ("bench",),
    "draco/": ("examples/render", "tests/examples/render"),
    "embree": ("examples",),
    "gtest/": ("tests",),
    "gmock/": ("tests",),
    "jpeglib": ("runtime/texture/jpeg",),
    "libdeflate": ("examples/encode",),
    "llvm-c/": ("jit/llvm",),
    "llvm/": ("jit/llvm", "tests/jit/llvm", "tests/jit/worker"),
    "meshoptimizer": ("examples/render", "tests/examples/render"),
    "nanobind/": ("jit/api/python",),
    "nlohmann/": ("bench", "examples", "jit/tune", "tests"),
    "pugixml": ("jit/document",),
}


# Headers of the C library that a public header for C may have.
C_HEADERS = {"stdbool.h", "stddef.h", "stdint.h"}


def allowed(file: str) -> tuple[str, ...]:
    folder = max((f for f in MAY_INCLUDE if tree.inside(file, f)), key=len)
    return MAY_INCLUDE[folder]


def folders(root: pathlib.Path) -> list[str]:
    """Includes of our own follow the direction of the design."""
    faults = []
    for include in tree.includes(root):
        top = include.name.split("/")[0]
        if top in tree.FOLDERS and not any(
                tree.inside(include.name, folder) for folder in allowed(include.file)):
            faults.append(f'{include.where()}: includes "{include.name}", but files here may only '
                          f"include {', '.join(allowed(include.file))}")
    return faults


def stage(file: str) -> int | None:
    """The number of the stage that a file is of."""
    found = [i for i, folder in enumerate(JIT_STAGES) if tree.inside(file, folder)]
    return max(found, key=lambda i: len(JIT_STAGES[i]), default=None)


def stages(root: pathlib.Path) -> list[str]:
    """The stages of jit/ know those before them only, and every file of jit/ is of one."""
    faults = []
    for file in tree.files(root, tree.WRITTEN):
        if tree.inside(file, "jit") and stage(file) is None:
            faults.append(f"{file}: in no stage; the order is {' -> '.join(JIT_STAGES)}")
    for include in tree.includes(root):
        here, there = stage(include.file), stage(include.name)
        if here is not None and there is not None and there > here:
            faults.append(f'{include.where()}: includes "{include.name}", a later stage; '
                          f"the order is {' -> '.join(JIT_STAGES)}")
    return faults


def paths(root: pathlib.Path) -> list[str]:
    """A quoted include names a file of ours from the root."""
    return [f'{include.where()}: "{include.name}" is no file from the root of the project; '
            f"write the whole path, or <> if it is not ours"
            for include in tree.includes(root)
            if include.quoted and not (root / include.name).is_file()
            and not tree.inside(include.file, "tests/install")
            and not tree.inside(include.file, "examples/embed")]


def quarantine(root: pathlib.Path) -> list[str]:
    """Heavy dependencies stay in the one folder that wraps them."""
    faults = []
    for include in tree.includes(root):
        for start, homes in QUARANTINE.items():
            if include.name.startswith(start) and not any(
                    tree.inside(include.file, home) for home in homes):
                faults.append(f"{include.where()}: includes <{include.name}>, which only "
                              f"{', '.join(homes)} may")
    return faults


def public(root: pathlib.Path) -> list[str]:
    """A host that has our headers and a compiler needs nothing else."""
    return [f"{include.where()}: the interface includes {include.name}, which is neither "
            f"<nacre/...> nor of the standard library"
            for include in tree.includes(root)
            if tree.inside(include.file, "jit/api/include")
            and (include.quoted or not include.name.startswith("nacre/"))
            and include.name not in C_HEADERS and ("/" in include.name or "." in include.name)]


CHECKS = (folders, stages, paths, quarantine, public)
