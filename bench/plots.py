"""The pictures of the README: bars of points a second."""

import pathlib

import results

VARIANTS = {
    "interpreter/standard": ("interpreter", "#9aa5b1"),
    "jit_w1/standard": ("JIT, W = 1", "#c9d9ee"),
    "jit_w4/standard": ("JIT, W = 4", "#8fb4dd"),
    "jit_w8/standard": ("JIT, W = 8", "#4f86c6"),
    "jit_w16/standard": ("JIT, W = 16", "#1f4e8c"),
    "xsimd": ("xsimd by hand", "#d98e2b"),
    "oiio": ("OpenImageIO", "#d98e2b"),
}


def bars(run: results.Run, subjects: dict[str, str], variants: list[str], title: str,
         file: pathlib.Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 3.6), dpi=110)
    width = 0.8 / len(variants)
    for i, variant in enumerate(variants):
        found = [(k, run.get(f"{subject}/{variant}")) for k, subject in enumerate(subjects)]
        found = [(k, each) for k, each in found if each]
        label, colour = VARIANTS[variant]
        axes.bar([k + (i - (len(variants) - 1) / 2) * width for k, _ in found],
                 [1e3 / each.median for _, each in found], width, label=label, color=colour)
    axes.set_xticks(range(len(subjects)), subjects.values())
    axes.set_yscale("log")
    axes.set_ylabel("million points a second")
    axes.set_title(title)
    axes.grid(axis="y", alpha=0.3)
    axes.set_axisbelow(True)
    axes.legend(fontsize=8, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.17))
    figure.savefig(file, bbox_inches="tight")
    pyplot.close(figure)


def draw(run: results.Run, out: pathlib.Path) -> None:
    widths = ["interpreter/standard", *(f"jit_w{w}/standard" for w in (1, 4, 8, 16))]
    bars(run, {"peers/chain": "50 arithmetic nodes", "peers/fractal": "fractal3d, 4 octaves",
               "peers/conductor": "conductor, f and pdf"}, widths + ["xsimd"],
         "The same formula, one thread", out / "peers.png")
    filters = {"closest": "closest", "bilinear": "bilinear", "trilinear": "trilinear",
               "anisotropic": "aniso"}
    bars(run, {f"textures/{f}/{p}": f"{label}\n{p}" for f, label in filters.items()
               for p in ("coherent", "random")}, widths[1:] + ["oiio"],
         "Texture look-ups, RGBA8, resident, one thread", out / "textures.png")
    names = ("standard_surface", "open_pbr_surface", "gltf_pbr", "UsdPreviewSurface",
             "disney_principled")
    bars(run, {f"materials/{n}/frozen/evaluate": "_\n".join(n.rsplit("_", 1)) for n in names}
         | {"materials/standard_surface/live/evaluate": "standard_\nsurface, live"},
         widths, "evaluate: f and pdf of all lobes, one thread", out / "materials.png")
