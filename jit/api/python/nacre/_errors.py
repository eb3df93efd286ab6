"""What there is to say of documents, shaders and arrays."""

import dataclasses
import enum
import logging
import warnings
from collections.abc import Sequence


class Severity(enum.IntEnum):
    NOTE = 0
    WARNING = 1
    ERROR = 2  # Something is not there, or not right.


@dataclasses.dataclass(frozen=True)
class Diagnostic:
    """One complaint; str() is all of it in one line. Texts are "" and numbers 0 where nothing is
    known."""

    severity: int
    code: str  # Stable: "unknown-node".
    file: str = ""
    line: int = 0  # 1-based.
    column: int = 0  # 1-based.
    path: str = ""  # Of the element, "NG_marble/mix1/fg"; or the name of an array or parameter.
    message: str = ""  # One sentence.
    expected: str = ""  # What would have been right.
    found: str = ""  # What was there.
    text: str = ""
    hint: str = ""  # Which names will have been meant by one that there is not.

    def __post_init__(self) -> None:
        object.__setattr__(self, "severity", Severity(self.severity))

    def __str__(self) -> str:
        return self.text


class Error(Exception):
    """What was asked for is not there. `diagnostics` is everything that was said, warnings that
    came before included; str() is all of it, a line each."""

    def __init__(self, diagnostics: Sequence[Diagnostic], status: int = 1, text: str = "") -> None:
        super().__init__(diagnostics, status, text)
        self.diagnostics: list[Diagnostic] = list(diagnostics)
        self.status = status  # nacre_status of <nacre/nacre.h>.
        self._text = text

    def __str__(self) -> str:
        return self._text or "\n".join(map(str, self.diagnostics))


class DiagnosticWarning(UserWarning):
    """A warning of the library's, in `diagnostic`."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic)
        self.diagnostic = diagnostic

    def __str__(self) -> str:
        return self.diagnostic.text


def say(diagnostic: Diagnostic) -> None:
    """Warns as the caller of the package, wherever in it this was called."""
    if diagnostic.severity == Severity.NOTE:
        logging.getLogger("nacre").info("%s", diagnostic)
        return
    warnings.warn(DiagnosticWarning(diagnostic), stacklevel=_frames_of_ours())


def refusal(code: str, name: str, message: str, expected: str, found: str) -> Error:
    """The Error for what a caller gave that is not right."""
    text = f"error: {message}; expected {expected}, found {found} [{code}] ({name})"
    return Error([Diagnostic(Severity.ERROR, code, path=name, message=message, expected=expected,
                             found=found, text=text)], status=2)


def _frames_of_ours() -> int:
    """The stack level, of warnings.warn in say(), of the first frame outside the package."""
    import sys

    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    return level
