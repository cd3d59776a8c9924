"""What a call may be told: the keyword arguments that take the place of onset::Options."""

from typing import TYPE_CHECKING, TypedDict

from . import _onset

if TYPE_CHECKING:
    from collections.abc import Callable

    from ._onset import BroadPhaseMethod, Exactness, InstructionSet, NarrowPhaseMethod, Norm


class Options(TypedDict, total=False):
    """Keyword arguments of the calls, by the names of onset::Options; an enumerator may be given by its name, as "exact".

    A dictionary of them can be kept: ``options = Options(min_separation=1e-3)``, ``close_pairs(mesh, x, d_hat, **options)``.
    progress cancels a call by returning what is false, None apart. A call runs handlers of signals while it works, so that KeyboardInterrupt ends it.
    """

    tolerance: "float | None"
    relative_tolerance: float
    min_separation: float
    norm: "Norm | str"
    max_checks: int
    window: float
    check_limit: int
    memory_limit: int
    time_limit: float
    progress: "Callable[[float], object] | None"
    threads: int
    exactness: "Exactness | str"
    touching_may_pass_through: bool
    hold_candidates: bool
    broad_phase: "BroadPhaseMethod | str"
    narrow_phase: "NarrowPhaseMethod | str"
    instruction_set: "InstructionSet | str"


class LineSearchOptions(Options, total=False):
    """Those of a line search."""

    gap_share: float
    d_hat: float


class TruncateOptions(Options, total=False):
    """Those of truncate_step."""

    gap_share: float
    d_hat: "float | None"


_docs = _onset._option_docs()
Options.__doc__ += "\n" + "\n".join(
    f"{name}\n" + "".join(f"    {line}\n" for line in _docs[name].splitlines()) for name in Options.__annotations__ if _docs[name])
