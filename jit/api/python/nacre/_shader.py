"""Compiled kernels, on arrays."""

import functools
import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy

from . import _core
from ._core import Binding, Entry, Stop
from ._options import LobeKind, entry_bits
from ._parameters import Instance, Parameters

_TYPES = ("float32", "int32", "int32")  # By NACRE_FLOAT, NACRE_INT, NACRE_BOOL.
_ROLES = ("point", "direction", "state", "result", "slot", "value")


class Channel(NamedTuple):
    """Four bytes a point that a kernel reads or stores."""

    name: str  # "P.x"
    component: int  # 0 to 3 for .x to .w; -1: none; of "state.<k>" its place in the state.
    dtype: str  # "float32" or "int32"; booleans are int32, 0 or 1.
    role: str  # Who gives it its numbers: "point", "direction", "state", "result", ...
    unit: str
    meaning: str


class Lobe(NamedTuple):
    """A lobe of a material; the channel `lobe` counts in this order."""

    name: str  # Category of its node: "dielectric_bsdf".
    path: str  # The node, "SR_gold/coat_bsdf".
    kinds: LobeKind


class ShaderError(NamedTuple):
    """How far a shader's numbers are from double precision with everything exact, at points by
    which nothing was chosen."""

    mean: float
    p999: float  # What one number of a thousand exceeds.
    maximum: float
    worst: str  # The channel of the maximum.
    floor: float  # Errors are shares of a number, or of so much of the largest of its channel.
    is_absolute: bool  # They are differences.
    points: str  # Where that was measured, for people.


class Fact(NamedTuple):
    """What the option `facts` says of numbers that kernels read."""

    name: str
    minimum: float
    maximum: float
    # Instructions that kernels have less for it; None of code from the cache, and of parameters
    # where there are too many to try each.
    saved: int | None


class _Placed(NamedTuple):
    array: Any
    element: int


def of_place(array: Any) -> _Placed:
    """An array of which element i belongs to the i-th point that is shaded, whichever that is:
    as long as the list `points`."""
    return _Placed(array, 1)


def of_instance(array: Any) -> _Placed:
    """An array of which element instances[i] belongs to point i."""
    return _Placed(array, 2)


class Shader(_core.Shader):
    """The compiled kernels of a material or of outputs; System.compile_* make it.

    Arrays go by the names of channels and their groups, results and varying parameters:

        {"P": (count, 3), "uv0": (count, 2), "wo": (0, 0, 1), "SR_gold/base_color": ...}

    Each has one element a point, of as many float32 (int32) numbers as the name has components;
    an array of one element, numbers and tuples are the same for all points. Several axes count
    as one, (height, width, 3), as long as one stride leads from each point to the next. Names that
    other shaders read are allowed, so one mapping does for all; unknown ones are an Error.
    """

    def inputs(self, entry: Entry) -> list[Channel]:
        """What must be bound for an entry."""
        return [_channel(each) for each in self._inputs(entry)]

    def results(self, entry: Entry) -> list[Channel]:
        """What an entry stores, wherever that is bound."""
        return [_channel(each) for each in self._results(entry)]

    @functools.cached_property
    def error(self) -> ShaderError | None:
        """None where neither max_error nor measure_error asked for it."""
        found = self._error()
        return None if found is None else ShaderError(*found)

    @functools.cached_property
    def facts(self) -> list[Fact]:
        """What the option `facts` said, each with what it saves."""
        return [Fact(*each) for each in self._facts()]

    @functools.cached_property
    def lobes(self) -> list[Lobe]:
        return [Lobe(name, path, LobeKind(kinds)) for name, path, kinds in self._lobes()]

    @functools.cached_property
    def parameters(self) -> Parameters:
        """Names of what may change without compiling, to the document's values; see `live`."""
        return Parameters(self)

    def instance(self, values: Mapping[str, Any] | None = None) -> Instance:
        """Values of the parameters: the document's, but for those given."""
        made = Instance(self)
        made.update(values or {})
        return made

    def bind(self, arrays: Mapping[str, Any], *, entries: Iterable[Entry] | None = None) -> Binding:
        """The kernels on these arrays, results among them, which are kept and never copied: what
        changes in them is seen by the next run. `entries`: those that are wanted; None: all that
        there are. Results that have no array are discarded. Error where an input has none, and
        where an array has another type or shape, is read-only or on another device."""
        placed = [(name, *(array if isinstance(array, _Placed) else (array, 0)))
                  for name, array in arrays.items()]
        return Binding(self, placed, 0 if entries is None else entry_bits(entries))

    def run(self, arrays: Mapping[str, Any], entry: Entry = Entry.OUTPUTS, *,
            count: int | None = None, points: Any = None, instances: Any = None,
            instance: Instance | None = None, point: int = 0,
            stop: Stop | None = None) -> dict[str, Any]:
        """Shades once and gives all results of an entry by name: those that `arrays` have, and
        NumPy arrays for the others, of shape (count,) or (count, components).

        Where the entry reads the state and `arrays` have none, BEGIN is run first. The other
        arguments are those of Binding.run; elements that `points` does not name are 0. Empty for
        an entry that the shader lacks. After `stop` the arrays hold anything."""
        if not self.has(entry):
            return {}
        request = {"instances": instances, "instance": instance, "stop": stop}
        given = dict(arrays)
        reads_state = entry == Entry.EVALUATE_AT or any(
            _ROLES[each[3]] == "state" for each in self._inputs(entry))
        if reads_state and self.state_count > 0 and "state" not in given:
            at = numpy.array([point], "uint32") if entry == Entry.EVALUATE_AT else points
            given["state"] = self._begin(given, 1 if at is not points else count, at, request)
        length = _length(self.bind(given, entries=[entry]), entry, count, points, instances)
        groups = _groups(self._results(entry))
        made = {name: numpy.zeros((length, components) if components else length, dtype)
                for name, (components, dtype) in groups.items() if name not in given}
        binding = self.bind(given | made, entries=[entry])
        binding.run(entry, count, points=points, point=point, **request)
        return {name: made[name] if name in made else given[name] for name in groups}

    def _begin(self, given: Mapping[str, Any], count: int | None, points: Any,
               request: Mapping[str, Any]) -> Any:
        """The state: an element a point, or one for all where all are the same."""
        unstored = self.bind(given, entries=[Entry.BEGIN])
        is_same = unstored.count(Entry.BEGIN) is None and request["instances"] is None
        if is_same:
            count, points = 1, None
        length = _length(unstored, Entry.BEGIN, count, points, request["instances"])
        # Read a number at a time, from rows that do not meet in the same sets of the caches.
        state = numpy.zeros((self.state_count, length + 16), "float32")[:, :length].T
        binding = self.bind({**given, "state": state}, entries=[Entry.BEGIN])
        binding.run(Entry.BEGIN, count, points=points, **request)
        return numpy.array(state[0]) if is_same else state


def _channel(said: tuple[Any, ...]) -> Channel:
    name, component, number, role, unit, meaning = said
    return Channel(name, component, _TYPES[number], _ROLES[role], unit, meaning)


def _groups(channels: list[tuple[Any, ...]]) -> dict[str, tuple[int, str]]:
    """Names to components, 0 for a number alone, and type; without the state."""
    found: dict[str, tuple[int, str]] = {}
    for name, _, number, role, *_ in channels:
        if _ROLES[role] == "state":
            continue
        component = re.fullmatch(r"(.*)\.(?:[xyzw]|[0-9]+)", name)
        group = component[1] if component else name
        components = found.get(group, (0, ""))[0]
        found[group] = (components + 1 if component else 0, _TYPES[number])
    return found


def _length(binding: Binding, entry: Entry, count: int | None, points: Any,
            instances: Any) -> int:
    """Elements that arrays of results need."""
    if count is not None and points is None:
        return count
    length = binding.count(entry)
    if length is None and instances is not None:
        length = len(instances)
    if length is None and points is not None:
        length = int(numpy.max(points, initial=-1)) + 1
    if length is None and entry != Entry.EVALUATE_AT:
        length = binding.length
    if length is None:
        binding.run(entry)  # Refuses: nothing says how many points there are.
    return length or 0
