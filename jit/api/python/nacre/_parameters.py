"""Parameters of shaders, and instances, which have values for them."""

import dataclasses
from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
from typing import TYPE_CHECKING, Any

import numpy

from . import _core
from ._errors import refusal

if TYPE_CHECKING:
    from ._shader import Shader

Value = float | int | bool | tuple[float, ...] | tuple[int, ...] | tuple[bool, ...]

# By number_type: float, int32, int32 that is 0 or 1; and the kinds of NumPy's that it takes.
_STORED = (numpy.dtype("float32"), numpy.dtype("int32"), numpy.dtype("int32"))
_TAKEN = ("fiu", "iu", "b")
_NUMBERS = ("real numbers", "whole numbers", "booleans")


@dataclasses.dataclass(frozen=True)
class Ui:
    """What an interface shows of a parameter. Texts are "" where a document says nothing."""

    type: str  # "color3", "matrix44"
    components: int
    is_varying: bool  # A channel of each point, not of an instance.
    value: Value  # The document's.
    minimum: Value | None  # For a slider; None: no limit.
    maximum: Value | None
    label: str
    folder: str
    unit: str
    doc: str


class Parameters(Mapping[str, Value]):
    """What may change without compiling: names to the document's values, numbers or tuples.
    `ui` has what else there is to know of each."""

    def __init__(self, shader: "Shader") -> None:
        self.ui: dict[str, Ui] = {}
        self._places: dict[str, tuple[int, int]] = {}  # Index and number type.
        for index, (name, type_, number, components, is_varying, value, minimum, maximum, label,
                    folder, unit, doc) in enumerate(shader._parameters()):
            self._places[name] = (index, number)
            self.ui[name] = Ui(type_, components, is_varying, _from_bytes(value, number),
                               _from_bytes(minimum, number), _from_bytes(maximum, number), label,
                               folder, unit, doc)

    def __getitem__(self, name: str) -> Value:
        return self.ui[name].value

    def __iter__(self) -> Iterator[str]:
        return iter(self.ui)

    def __len__(self) -> int:
        return len(self.ui)

    def __repr__(self) -> str:
        return f"<nacre.Parameters {dict(self)!r}>"


class Instance(_core.Instance):
    """Values of a shader's parameters, to begin with the document's: some hundred bytes, a mapping
    that can be set.

        instance = shader.instance()
        instance["SR_gold/base_color"] = 1, 0, 0
        shader.run(points, entry=nacre.Entry.ALBEDO, instance=instance)

    Varying parameters are none of an instance's. KeyError for a name that the shader does not
    have, Error for a value that does not fit.
    """

    def __init__(self, shader: "Shader") -> None:
        super().__init__(shader)
        self._of = shader.parameters

    def _ui(self, name: str) -> Ui:
        ui = self._of.ui.get(name)
        if ui is None or ui.is_varying:
            reason = "comes with each point" if ui else "is no live parameter of the shader"
            raise KeyError(f"{name!r} {reason}; those are: {', '.join(self) or 'none'}")
        return ui

    def __getitem__(self, name: str) -> Value:
        components = self._ui(name).components
        index, number = self._of._places[name]
        return _from_bytes(self._get(index, components), number)

    def __setitem__(self, name: str, value: Any) -> None:
        ui = self._ui(name)
        index, number = self._of._places[name]
        given = numpy.asarray(value)
        taken = given.dtype.kind in _TAKEN[number]
        if not taken or given.size != ui.components:
            raise refusal("bad-parameter", name, f"'{name}' cannot be set to that",
                          f"a {ui.type}: {ui.components} {_NUMBERS[number]}", repr(value))
        if number == 1 and (given.min() < -2**31 or given.max() >= 2**31):
            raise refusal("bad-parameter", name, f"'{name}' cannot be set to that",
                          "32 bits a number", repr(value))
        self._set(index, given.astype(_STORED[number]).tobytes())

    def __contains__(self, name: object) -> bool:
        return name in self._of.ui and not self._of.ui[name].is_varying  # type: ignore[index]

    def __iter__(self) -> Iterator[str]:
        return (name for name, ui in self._of.ui.items() if not ui.is_varying)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def keys(self) -> KeysView[str]:
        return KeysView(self)  # type: ignore[arg-type]

    def values(self) -> ValuesView[Value]:
        return ValuesView(self)  # type: ignore[arg-type]

    def items(self) -> ItemsView[str, Value]:
        return ItemsView(self)  # type: ignore[arg-type]

    def update(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            self[name] = value

    def __repr__(self) -> str:
        return f"<nacre.Instance {dict(self)!r}>"


def _from_bytes(stored: bytes | None, number: int) -> Any:
    """A number, or a tuple of them; None for None."""
    if stored is None:
        return None
    values = numpy.frombuffer(stored, _STORED[number]).tolist()
    if number == 2:
        values = [value != 0 for value in values]
    return values[0] if len(values) == 1 else tuple(values)
