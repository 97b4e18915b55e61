"""What goes wrong."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearwear.run import Run
    from gearwear.stage import StageRun


class GearwearError(Exception):
    """Anything that goes wrong with a scene or a computation."""


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong with a scene."""

    #: syntax, unknown-key, wrong-type, not-allowed, missing, said-twice, not-available, geometry, stiffness or not-utf8
    kind: str
    #: path of the key, such as ``pair.pinion.teeth``; empty where the scene as a whole is meant
    key: str
    #: what the scene says
    found: str
    #: what it may say
    allowed: str
    #: what to do about it
    help: str | None
    #: line of the scene's text, from 1
    line: int
    #: all of this in one sentence, as the command line prints it
    message: str

    def __str__(self) -> str:
        return self.message if self.help is None else f"{self.message} ({self.help})"


class SceneError(GearwearError, ValueError):
    """A scene that is wrong: everything that is, not only the first thing."""

    def __init__(self, name: str, findings: Iterable[Finding | tuple[Any, ...]]) -> None:
        #: name of the scene's file or text
        self.name = name
        #: at least one
        self.findings = [one if isinstance(one, Finding) else Finding(*one) for one in findings]
        super().__init__("\n".join(f"{name}, line {one.line}: {one}" for one in self.findings))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.name, self.findings)


class RunError(GearwearError, RuntimeError):
    """A computation that failed. Where something was finished, :attr:`run` is what."""

    def __init__(self, message: str, run: Run | None = None, stage: StageRun | None = None) -> None:
        super().__init__(message)
        #: what was finished; None where nothing was
        self.run = run
        #: the same of a planetary stage
        self.stage = stage

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.run, self.stage)


class NotConverged(RunError):
    """The tooth pairs found no equilibrium; :attr:`run` is what was finished before."""


class WornThrough(RunError):
    """The wear came to the thickness of a tooth; :attr:`run` is what was finished before."""
