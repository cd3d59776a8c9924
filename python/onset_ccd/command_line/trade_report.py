"""What trade() has measured, as a table, JSON and CSV: the words of the native command line, and the step beside them."""

import os
import platform
import statistics

from ..trade import pareto_front, value_of
from .report import time_json

COLUMNS = ("axis,value,us,us_min,us_max,cpu_us,asked,positives,false_positives,false_negatives,early_mean,early_max,budget,tolerance,"
           "achieved_tolerance,on_front,incomplete,step,checks")


def machine():
    return f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}"


def in_words(options):
    """As in Python, what differs from the defaults."""
    return ", ".join(f"{key}={value!r}" for key, value in options.items()) or "the defaults"


def spread_json(times):
    return {"median": 1e6 * statistics.median(times), "min": 1e6 * min(times), "max": 1e6 * max(times)}


def early_json(row):
    return None if row.early_mean is None else {"mean": row.early_mean, "max": row.early_max, "late": row.late}


def row_json(row):
    keys = ("tolerance", "relative_tolerance", "min_separation", "norm", "max_checks", "exactness", "threads")
    numbers = {("certainty" if key == "exactness" else key): value_of(row.options, key) for key in keys}
    return {"axis": row.axis, "value": row.value, "options": in_words(row.options), "numbers": numbers,
            "same_question": row.same_question, "on_front": row.on_front, "us": spread_json(row.times), "wall_us": spread_json(row.times),
            "cpu_us": spread_json(row.cpu_times), "asked": row.candidates, "positives": row.contacts, "certain": row.certain,
            "false_positives": row.false_positives, "false_negatives": row.false_negatives, "early": early_json(row), "budget": row.budget,
            "inclusion": row.inclusion, "checks": row.checks, "tolerance": row.tolerance, "achieved_tolerance": row.achieved_tolerance,
            "earliest": time_json(row.earliest), "incomplete": row.incomplete, "complete_until": time_json(row.complete_until),
            "step": row.step}


def to_json(subject, rows):
    return {"subject": subject, "machine": machine(), "time_of": "wall time of one active set",
            "reference": "the times at relative_tolerance=1e-12, and what exactness='exact' finds", "base_on_front": rows[0].on_front,
            "settings": [row_json(row) for row in rows]}


def or_empty(value, pattern="{}"):
    return "" if value is None else pattern.format(value)


def to_csv(rows):
    lines = [COLUMNS]
    for row in rows:
        fields = [row.axis, f'"{row.value}"', *(f"{1e6 * t:.9g}" for t in (row.median, *row.spread, statistics.median(row.cpu_times))),
                  row.candidates, row.contacts, or_empty(row.false_positives), or_empty(row.false_negatives),
                  or_empty(row.early_mean, "{:.9g}"), or_empty(row.early_max, "{:.9g}"), row.budget, f"{row.tolerance:.9g}",
                  f"{row.achieved_tolerance:.9g}", int(row.on_front), or_empty(row.incomplete), f"{row.step:.17g}", row.checks]
        lines.append(",".join(map(str, fields)))
    return "\n".join(lines) + "\n"


def table(rows):
    def dash(value, pattern="{}"):
        return "-" if value is None else pattern.format(value)

    lines = [f"  {'axis':14} {'value':29} {'us, median':>11} {'[least, most]':24} {'step':>12} {'positives':>9} {'false pos':>9} "
             f"{'false neg':>9} {'early':>9} {'at most':>9} {'budget':>7} {'checks':>9}"]
    for row in rows:
        least, most = row.spread
        lines.append(f"{'*' if row.on_front else ' '} {row.axis:14} {row.value:29} {1e6 * row.median:11.4g} "
                     f"{f'[{1e6 * least:.4g}, {1e6 * most:.4g}]':24} {row.step:12.9g} {row.contacts:9} {dash(row.false_positives):>9} "
                     f"{dash(row.false_negatives):>9} {dash(row.early_mean, '{:.2g}'):>9} {dash(row.early_max, '{:.2g}'):>9} {row.budget:7} "
                     f"{row.checks:9}" + (f"  incomplete: {row.incomplete}" if row.incomplete else ""))
    return "\n".join(lines) + "\n"


LEGEND = """us: wall time of one active set. early: how much sooner than at a relative tolerance of 1e-12 a pair is said to touch, mean and at
most, in units of the step. budget: pairs that spent max_checks. False positives and negatives: against exactness='exact'.
*: on the Pareto front of time, false positives (else positives), earliness and budget.
"""


def words(row):
    text = f"{in_words(row.options)}: {1e6 * row.median:.4g} us, {row.contacts} positives"
    text += "" if row.false_positives is None else f", {row.false_positives} of them false"
    return text + ("" if row.early_mean is None else f", {row.early_mean:.2g} early")


def describe(rows):
    front = "".join(f"  {words(row)}\n" for row in pareto_front(rows))
    missed, late = sum(row.false_negatives or 0 for row in rows), sum(row.late for row in rows)
    base = "The base is on the front." if rows[0].on_front else "The base is NOT on the front."
    return (f"{machine()}\n\n{table(rows)}\n{LEGEND}False negatives in all settings together: {missed}; times later than the exact ones: {late}\n\n"
            f"Pareto front, fastest first\n{front}{base}\n")
