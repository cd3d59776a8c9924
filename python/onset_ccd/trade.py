"""What speed costs in accuracy on your own scene, and the other way round.

    from onset_ccd.trade import pareto_front, trade

    rows = trade(mesh, x_t0, x_t1, axes=["tolerance", "certainty"], threads=1)
    for row in pareto_front(rows):
        print(row.axis, row.value, row.median, row.contacts, row.false_positives)
"""

import math
import os
import statistics
import time
from dataclasses import dataclass, field

import numpy as np

import onset_ccd

BRUTE_PRIMITIVES = 20000  # brute force over more than this takes longer than everything else together
SOME_SEPARATION = 1e-4  # at which norms are compared where the base has none, as a share of the extent
FINEST = 1e-12  # relative tolerance of the times that others are compared with

DEFAULTS = {"tolerance": None, "relative_tolerance": 1e-6, "max_checks": 10000, "min_separation": 0.0, "norm": "euclidean",
            "exactness": "certify", "narrow_phase": "automatic", "broad_phase": "automatic", "threads": 0, "instruction_set": "automatic"}


@dataclass
class Row:
    """One setting, and what is known of it. Times are of one active set, in seconds; lengths in model length."""

    axis: str  # "base" for the base itself
    value: str
    options: dict  # keyword arguments of the calls
    same_question: bool = True  # the separation and norm of the base: its answers can be compared with those
    times: list = field(default_factory=list)  # wall
    cpu_times: list = field(default_factory=list)
    step: float = 0.0  # of compute_collision_free_stepsize
    candidates: int = 0
    contacts: int = 0
    certain: int = 0  # of the contacts: known to be real
    false_positives: "int | None" = None  # contacts that are none; where the separation is 0
    false_negatives: "int | None" = None  # contacts that were not found
    early_mean: "float | None" = None  # how much sooner than the finest times a pair is said to touch, in units of the step
    early_max: "float | None" = None
    late: int = 0  # times later than the exact ones
    budget: int = 0  # pairs that spent max_checks
    inclusion: int = 0  # pairs that needed the inclusion root finder
    checks: int = 0
    tolerance: float = 0.0
    achieved_tolerance: float = 0.0  # the largest distance beyond the separation at which a pair was reported
    earliest: float = math.inf  # time of impact of all
    incomplete: "str | None" = None  # the outcome of a call that a budget cut off, and until when all contacts are there
    complete_until: float = math.inf
    on_front: bool = False

    @property
    def median(self):
        return statistics.median(self.times)

    @property
    def spread(self):
        """The least and the most of the times."""
        return min(self.times), max(self.times)

    def middle(self):
        """Quartiles and median: unlike the extremes the middle half does not widen with the number of measurements."""
        times = sorted(self.times)
        last = len(times) - 1
        return times[last // 4], self.median, times[last - last // 4]

    def wrong(self):
        return self.contacts if self.false_positives is None else self.false_positives

    def early(self):
        return self.early_mean or 0.0


def named(options):
    """Enumerators by their names, so that options can be compared and printed."""
    return {key: getattr(value, "name", value) for key, value in options.items()}


def value_of(options, key):
    return options.get(key, DEFAULTS[key])


class Axis:
    """Settings around the base that differ in one thing. `extent`: model length that separations are a share of."""

    def __init__(self, base, extent, primitives):
        self.base, self.extent, self.primitives = base, extent, primitives

    def get(self, key):
        return value_of(self.base, key)

    def changed(self, factor):
        """The base with its tolerance times a factor, and the words for it."""
        key = "tolerance" if self.get("tolerance") is not None else "relative_tolerance"
        value = self.get(key) * factor
        return f"{value:.3g}" + ("" if key == "tolerance" else " relative"), {key: value}

    def tolerance(self):
        yield from (self.changed(factor) for factor in (1e5, 1e4, 1e3, 1e2, 1e1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6))

    def max_checks(self):
        yield from ((str(n), {"max_checks": n}) for n in (1, 3, 10, 30, 100, 1000, 10000, 100000, 1000000))

    def min_separation(self):
        for share in (0.0, 1e-16, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3):
            yield f"{share * self.extent:.3g}", {"min_separation": share * self.extent}

    def norm(self):
        d = self.get("min_separation") or SOME_SEPARATION * self.extent
        yield from ((f"{norm}, separation {d:.3g}", {"norm": norm, "min_separation": d}) for norm in ("euclidean", "maximum"))

    def certainty(self):
        yield from ((level, {"exactness": level}) for level in ("conservative", "certify", "exact"))

    def narrow_phase(self):
        """The paper's root finder alone, for which the tolerance decides how fine its boxes get."""
        for factor in (1e4, 1e2, 1e0, 1e-2):
            words, change = self.changed(factor)
            yield f"inclusion, {words}", {**change, "narrow_phase": "inclusion"}
        yield "automatic", {"narrow_phase": "automatic"}

    def broad_phase(self):
        for method in ("automatic", "bvh", "hash", "brute"):
            if method != "brute" or self.primitives <= BRUTE_PRIMITIVES:
                yield method, {"broad_phase": method}

    def threads(self):
        yield from ((str(2**k), {"threads": 2**k}) for k in range((os.cpu_count() or 1).bit_length()))

    def kernel(self):
        yield "scalar", {"instruction_set": "scalar"}


AXES = {"tolerance": Axis.tolerance, "max-checks": Axis.max_checks, "min-separation": Axis.min_separation, "norm": Axis.norm,
        "certainty": Axis.certainty, "narrow-phase": Axis.narrow_phase, "broad-phase": Axis.broad_phase, "threads": Axis.threads,
        "kernel": Axis.kernel}


def same_question(a, b):
    """Whether two settings ask for the same distance."""
    separation = value_of(a, "min_separation")
    return separation == value_of(b, "min_separation") and (separation == 0 or value_of(a, "norm") == value_of(b, "norm"))


def settings(base, axes, extent, primitives):
    """The base first, then every axis; values equal to the base's are left out."""
    rows = [Row("base", "", dict(base))]
    axis = Axis(base, extent, primitives)
    for name, values in AXES.items():
        for value, change in values(axis) if name in axes else ():
            if any(value_of(base, key) != to for key, to in change.items()):
                options = {**base, **change}
                rows.append(Row(name, value, options, same_question(options, base)))
    return rows


class Subject:
    """The scene that settings are tried on, and what is known of it."""

    def __init__(self, mesh, x_t0, x_t1, base):
        self.mesh, self.x_t0, self.x_t1 = mesh, x_t0, x_t1
        finest = {key: value for key, value in base.items() if key not in ("tolerance", "time_limit", "check_limit", "narrow_phase")}
        finest.update(relative_tolerance=FINEST, max_checks=max(value_of(base, "max_checks"), 1000000))
        self.exact = self.active_set({**finest, "min_separation": 0.0, "exactness": "exact"})
        self.base = base
        self.reference = self.exact if value_of(base, "min_separation") == 0 else self.active_set({**finest, "exactness": "conservative"})

    def active_set(self, options):
        return onset_ccd.construct_active_set(self.mesh, self.x_t0, self.x_t1, **options)

    def answer(self, row):
        found = self.active_set(row.options)
        row.step = onset_ccd.compute_collision_free_stepsize(self.mesh, self.x_t0, self.x_t1, **row.options).step
        stats, contacts = found.stats, found.contacts
        row.candidates, row.contacts = stats.candidates.total(), len(found)
        row.certain = int((contacts["certainty"] != int(onset_ccd.Certainty.within_tolerance)).sum())
        row.budget, row.inclusion, row.checks = stats.gave_up.total(), stats.inclusion.total(), stats.checks
        row.tolerance, row.achieved_tolerance = stats.tolerance, stats.achieved_tolerance
        row.earliest = float(contacts["toi"].min(initial=math.inf))
        self.note_end(row, found)
        self.compare_with_truth(row, found)
        if row.same_question:
            self.compare_times(row, found)

    @staticmethod
    def note_end(row, found):
        """Of several calls the one that a clock cut off soonest counts."""
        if found.outcome.name not in ("free", "contact") and found.complete_until <= row.complete_until:
            row.incomplete, row.complete_until = found.outcome.name, found.complete_until

    def compare_with_truth(self, row, found):
        """Whoever touches comes within any separation too, so that missing it is wrong for any. A set that is complete until some time has
        all that touch for certain by then."""
        if self.exact.complete_until < math.inf:
            return
        matches = onset_ccd.match(self.exact, found)
        missing = np.asarray(matches.to_of_from) < 0
        row.false_negatives = int((missing & (self.exact.contacts["toi_hi"] < row.complete_until)).sum())
        if row.complete_until == math.inf:
            row.false_negatives = int(missing.sum())
        if value_of(row.options, "min_separation") == 0:
            row.false_positives = len(found) - int(matches.count)

    def compare_times(self, row, found):
        rows = np.asarray(onset_ccd.match(self.reference, found).from_of_to)
        mine, truth = found.contacts[rows >= 0], self.reference.contacts[rows[rows >= 0]]
        early = np.maximum(truth["toi"] - mine["toi"], 0)
        row.early_mean, row.early_max = (float(early.mean()), float(early.max())) if len(early) else (0.0, 0.0)
        row.late = int((mine["toi"] > truth["toi_hi"]).sum())

    def time(self, row):
        wall, cpu = time.perf_counter(), time.process_time()
        found = self.active_set(row.options)
        row.times.append(time.perf_counter() - wall)
        row.cpu_times.append(time.process_time() - cpu)
        self.note_end(row, found)


def earlier(x, y):
    """Beyond a tenth, and beyond a billionth of the step, which no simulator can tell."""
    return x > 1.1 * y + 1e-9


def same_work(a, b):
    """Whether they did the same, check by check: any difference in time is the machine's."""
    keys = ("threads", "instruction_set", "broad_phase", "narrow_phase", "exactness")
    return all(value_of(a.options, key) == value_of(b.options, key) for key in keys) and (
        (a.checks, a.inclusion, a.contacts, a.budget) == (b.checks, b.inclusion, b.contacts, b.budget))


def dominates(b, a):
    """Whether `b` is to be preferred to `a` whatever counts: no less accurate in any respect (false positives, or all contacts where the
    truth is not known; mean earliness; spent budgets) and faster, the middle halves of both measurements apart, or more accurate in one and
    not slower, its median at most the other's lower quartile."""
    if b.wrong() > a.wrong() or b.budget > a.budget or earlier(b.early(), a.early()) or same_work(a, b):
        return False
    mine, theirs = b.middle(), a.middle()
    better = b.wrong() < a.wrong() or b.budget < a.budget or earlier(a.early(), b.early())
    return mine[2] < theirs[0] or (better and mine[1] <= theirs[0])


def alike(a, b):
    """Nothing tells them apart."""
    s, t = a.middle(), b.middle()
    return (a.wrong() == b.wrong() and a.budget == b.budget and not earlier(a.early(), b.early()) and not earlier(b.early(), a.early()) and
            (same_work(a, b) or (s[0] <= t[2] and t[0] <= s[2])))


def pareto_front(rows):
    """Those that no other dominates, fastest first; of those that nothing tells apart the first, so the base before others. Only those that
    ask the same question as the base and answer the whole of it."""
    asked = [row for row in rows if row.same_question and row.incomplete is None]
    front = []
    for row in asked:
        # Not one that did the same work only: that was measured several times, and once may be slow.
        twins = [other for other in asked if same_work(other, row)]
        beaten = any(all(dominates(other, twin) for twin in twins) for other in asked)
        if not beaten and not any(alike(other, row) for other in front):
            front.append(row)
    return sorted(front, key=lambda row: row.median)


def trade(mesh, x_t0, x_t1, axes=None, repeats=9, seconds=5.0, **base_options):
    """Measures every setting around `base_options`, those of construct_active_set, and returns the rows, the base first.

    axes: names of AXES; None: all. repeats: rounds of measurements after one to warm up; a setting is measured once, and again as long as
    `seconds` are not spent on it. Rounds go over all settings in turn, so that what drifts on the machine meets them all.
    What a contact is, exactness="exact" says, at separation 0; times are compared with those of a relative tolerance of 1e-12.
    Raises ValueError for an axis that there is not, options out of range and wrong shapes, as the calls do.
    """
    axes = list(AXES) if axes is None else list(axes)
    for name in axes:
        if name not in AXES:
            raise ValueError(f"axis '{name}' is none of {', '.join(AXES)}")
    if repeats < 1:
        raise ValueError(f"repeats is {repeats}; it must be at least 1")
    base = named({key: value for key, value in base_options.items() if key != "window"})
    subject = Subject(mesh, x_t0, x_t1, base)
    rows = settings(base, axes, subject.exact.stats.extent, mesh.num_vertices + mesh.num_edges + mesh.num_faces)
    warm_up = []
    for row in rows:
        began = time.perf_counter()
        subject.answer(row)
        warm_up.append(time.perf_counter() - began)
    for turn in range(repeats):
        for row, once in zip(rows, warm_up):
            if turn == 0 or (turn + 1) * once < seconds:
                subject.time(row)
    for row in pareto_front(rows):
        row.on_front = True
    return rows
