"""Nacre's kernels on Dr.Jit's arrays, none of which is copied."""

import concurrent.futures
import functools
import os

import drjit as dr
import mitsuba as mi
import nacre
import numpy

BLOCK = 8192  # Points of a call: what a core's caches hold, while a call from Python costs little.

_TYPES = {"float32": mi.Float, "int32": mi.Int32}


@functools.cache
def shader(file: str, changed: int, name: str | None, live: tuple[str, ...],
           varying: tuple[str, ...], options: tuple[tuple[str, object], ...],
           is_material: bool) -> tuple[str, nacre.Shader]:
    """Compiled once for all plug-ins that ask for the same; and the name of what was."""
    del changed  # The time of the file's last change: part of what is asked for.
    document, system = nacre.Document(file), nacre.default_system()
    names = document.materials if is_material else document.outputs
    kind = "material" if is_material else "output"
    if name is None and (len(names) == 1 or is_material and names):
        name = names[0]
    if name not in names:
        raise ValueError(f"{file}: {kind} {name!r}; there are: {', '.join(names) or 'none'}")
    asked = {"live": live + varying, "varying": varying, "no_footprints": True, **dict(options)}
    if is_material:
        return name, system.compile_material(document, name, **asked)
    return name, system.compile_outputs(document, [name], **asked)


class Plugin:
    """What the plug-ins share: a document, its open inputs, and running kernels on hits."""

    def __init__(self, props: mi.Properties, named: str, options: dict[str, object], *,
                 is_material: bool) -> None:
        if "filename" not in props:
            raise ValueError(f"{props.plugin_name()}: 'filename' names a MaterialX document")
        file = mi.file_resolver().resolve(props["filename"])
        self.file = str(file)
        self.textures: dict[str, mi.Texture] = {}
        values = {}
        for key in props.keys():
            if "/" not in key:
                continue
            if props.type(key) == mi.Properties.Type.Object:
                self.textures[key] = props[key]
            else:
                values[key] = _value(props[key])
        patterns = [each.strip() for each in props.get("live", "").split(",")]
        live = tuple(filter(None, [*patterns, *values]))
        options = {"accuracy": props.get("accuracy", "standard")} | options
        self.name, self.shader = shader(self.file, os.stat(self.file).st_mtime_ns, props.get(named),
                                        live, tuple(self.textures), tuple(options.items()),
                                        is_material)
        self.parameters = self.shader.instance(values)
        self.open = {key: _variable(value) for key, value in self.parameters.items()}
        unknown = set(self.textures) - set(self.shader.parameters)
        if unknown:
            raise ValueError(f"{self.file}: no input {', '.join(sorted(unknown))}")

    def traverse(self, callback) -> None:
        for key, value in self.open.items():
            callback.put(key, value, mi.ParamFlags.NonDifferentiable)
        for key, texture in self.textures.items():
            callback.put(key, texture, mi.ParamFlags.NonDifferentiable)

    def parameters_changed(self, keys) -> None:
        for key, value in self.open.items():
            self.parameters[key] = numpy.ravel(numpy.array(value))

    def run(self, entries, si, active, given=None) -> dict[str, object]:
        """Results of the last of the entries at the hits that are active, 0 at the others, by
        channel; `given`: further arrays by channel."""
        if dr.flag(dr.JitFlag.SymbolicScope):
            raise RuntimeError("Nacre's kernels need numbers, and Mitsuba is recording: render "
                               "within `with nacre_mitsuba.eager():`")
        given, shader = dict(given or {}), self.shader
        reads = {each.name for entry in entries for each in shader.inputs(entry)}
        arrays = hits(si, {name.rpartition(".")[0] or name for name in reads}) | given
        for key, texture in self.textures.items():
            arrays |= _looked_up(key, shader.parameters.ui[key], texture, si, active)
        arrays = {name: array for name, array in arrays.items() if name in reads}
        count = max([dr.width(si), dr.width(active), *map(dr.width, given.values())])
        # Kernels may leave elements alone: then those are zeros that are theirs to write.
        some = dr.width(active) > 1 or not active[0]
        results = {each.name: dr.opaque(_TYPES[each.dtype], 0, count) if some
                   else dr.empty(_TYPES[each.dtype], count)
                   for each in shader.results(entries[-1]) if each.role != "state"}
        points = dr.compress(active) if some else dr.arange(mi.UInt32, count)
        if dr.width(active) == 1 and some:
            points = mi.UInt32()
        dr.eval(arrays, results, points)
        dr.sync_thread()  # Kernels of Dr.Jit's are done: their numbers are there.
        # What Dr.Jit knows to be the same for all has one element.
        arrays = {name: array if len(array) > 1 else array[0] for name, array in arrays.items()}
        arrays |= results
        if shader.state_count:
            arrays["state"] = numpy.empty((shader.state_count, count + 16), "float32")[:, :count].T
        if len(points):
            self._shade(shader.bind(arrays, entries=entries), entries, numpy.from_dlpack(points))
        return results

    def _shade(self, binding, entries, points) -> None:
        def shade(begin: int) -> None:
            block = points[begin:begin + BLOCK]
            for entry in entries:
                binding.run(entry, points=block, instance=self.parameters)

        list(_threads().map(shade, range(0, len(points), BLOCK)))


@functools.cache
def _threads() -> concurrent.futures.Executor:
    return concurrent.futures.ThreadPoolExecutor(dr.thread_count() or 1)


def hits(si: mi.SurfaceInteraction3f, wanted: set[str]) -> dict[str, mi.Float]:
    """Channels of groups that a kernel reads."""
    n, t = si.sh_frame.n, si.sh_frame.s
    b = dr.cross(n, t)
    up = -si.dp_dv  # MaterialX's v: Mitsuba's goes down.
    groups = {
        "P": lambda: si.p, "N": lambda: n, "T": lambda: t,
        "B": lambda: dr.mulsign(b, dr.dot(b, up)),
        "Ng": lambda: dr.mulsign(si.n, dr.dot(si.n, n)),
        "wo": lambda: si.to_world(si.wi),
        "uv0": lambda: mi.Point2f(si.uv.x, 1 - si.uv.y),
    }
    groups |= {f"{name}o": groups[name] for name in "PNTB"}
    found = {}
    for name in wanted & set(groups):
        found |= {f"{name}.{axis}": part for axis, part in zip("xyz", groups[name]())}
    return found


def check_inputs(plugin: Plugin, entries) -> None:
    """Refuses what graphs read and hits do not have."""
    known = {"P", "Po", "N", "No", "T", "To", "B", "Bo", "Ng", "wo", "wi", "uv0", "u", "transport",
             "lobes_wanted", *plugin.textures}
    for entry in entries:
        for each in plugin.shader.inputs(entry):
            if each.role != "state" and (each.name.rpartition(".")[0] or each.name) not in known:
                raise ValueError(f"{plugin.file}: reads {each.name} ({each.meaning}), which "
                                 "hits of Mitsuba's do not have")


def _value(given):
    """A number, or a list of them."""
    if isinstance(given, (bool, int, float)):
        return given
    return [float(each) for each in given]


def _variable(value):
    if isinstance(value, bool):
        return mi.Bool(value)
    if isinstance(value, int):
        return mi.Int32(value)
    if isinstance(value, float):
        return mi.Float(value)
    if len(value) == 3 and isinstance(value[0], float):
        return mi.Color3f(*value)
    return mi.Float(value) if isinstance(value[0], float) else mi.Int32(value)


def _looked_up(key, ui, texture, si, active) -> dict[str, mi.Float]:
    if ui.components == 1:
        return {key: mi.Float(texture.eval_1(si, active))}
    if ui.components != 3:
        raise ValueError(f"{key}: a {ui.type}, which textures do not give")
    return {f"{key}.{axis}": part for axis, part in zip("xyz", texture.eval_3(si, active))}
