#!/usr/bin/env python3
"""Tables and plots of docs/simulation-trade.md from what measure.py has measured.

    report.py MEASURED DOCS

MEASURED: the folder of measure.py. DOCS: plots go to DOCS/images; in DOCS/simulation-trade.md what stands between
<!-- measured: NAME --> and <!-- end --> is replaced.
"""

import json
import math
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "bench/scripts"))
import plot_trade  # noqa: E402
from fill_measured import fill, table  # noqa: E402
from measure import SCENES  # noqa: E402

HARD = "cloth, hard pile"  # does not converge, so that no two of its runs end in the same way: it is left out of means and plots


def read(folder):
    """{scene: runs}, in the order in which they are named."""
    files = [json.loads(path.read_text()) for path in folder.glob("*.json")]
    runs = {file["scene"]: file["runs"] for file in files}
    return {name: runs[name] for name in SCENES if name in runs}


def mean(ratios):
    """Geometric."""
    return math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else None


def times(value):
    return "-" if value is None else f"{value:.2f}"


def share(value):
    return "-" if value is None else f"{100 * value:.2g} %"


def is_ours(run):
    return run["axis"] != "ipctk"


def scene_row(run):
    head = [run["axis"], run["value"]]
    if not run["done"]:
        return [*head, f"ended in step {run['frames']}: {run['error']}", *[""] * 9]
    same = "the same" if run["same_bytes"] else f"{1e3 * run['apart']:.2g} mm"
    return [*head, f"{run['seconds']:.2f}", f"{run['collision']:.2f}, {share(run['collision'] / run['seconds'])}",
            f"{run['iterations']}, {run['converged']}/{run['steps']}", f"{run['smallest_step']:.2g}", run["contacts"],
            f"{1e3 * run['closest']:.2g} mm", same, f"{100 * run['energy_drift']:+.2g} %", run["stalls"],
            f"{run['intersecting']} of {run['frames']}"]


def scene_table(runs):
    head = ["axis", "value", "s", "collision", "iterations, converged", "smallest step", "contacts", "closest", "frames", "energy", "stalls",
            "intersect"]
    return table(head, [scene_row(run) for run in runs])


def settings_of(scenes):
    """Each (axis, value), in order."""
    return list(dict.fromkeys((run["axis"], run["value"]) for runs in scenes.values() for run in runs))


def summary_row(scenes, axis, value):
    pairs = [(run, runs[0]) for runs in scenes.values() for run in runs if (run["axis"], run["value"]) == (axis, value)]
    both = [(run, usual) for run, usual in pairs if run["done"] and usual["done"]]
    ratio = lambda key: times(mean([run[key] / usual[key] for run, usual in both]))
    drift = max((abs(run["energy_drift"]) for run, _ in both), default=None)
    apart = max((1e3 * run["apart"] for run, _ in both), default=None)
    return [axis, value, f"{len(both)} of {len(pairs)}", ratio("seconds"), ratio("collision"), ratio("iterations"),
            f"{min((run['smallest_step'] for run, _ in both), default=math.nan):.2g}", f"{sum(run['same_bytes'] for run, _ in pairs)}",
            "-" if apart is None else f"{apart:.2g} mm", share(drift), sum(run["stalls"] for run, _ in both),
            f"{sum(run['intersecting'] for run, _ in both)} of {sum(run['frames'] for run, _ in pairs)}"]


def summary_table(scenes):
    head = ["axis", "value", "scenes done", "time", "collision", "iterations", "smallest step", "same frames", "apart, most", "energy, most",
            "stalls", "frames that intersect"]
    return table(head, [summary_row(scenes, *setting) for setting in settings_of(scenes)])


def promise(scenes):
    ours = [run for runs in scenes.values() for run in runs if is_ours(run)]
    frames = sum(run["frames"] for run in ours)
    bad = sum(run["intersecting"] for run in ours if run["done"])
    undone = sum(not run["done"] for run in ours)
    return (f"{len(ours)} runs at settings of Onset's own, {frames} frames: {bad} with intersections, "
            f"{sum(run['stalls'] for run in ours if run['done'])} stalls, {undone} runs that did not end.")


def peers(scenes):
    """What befell a peer in the library's place, a line each."""
    lines = []
    for name, runs in scenes.items():
        for run in runs:
            if is_ours(run):
                continue
            where = f"- {name}, {run['value']}: "
            if not run["done"]:
                lines.append(f"{where}{run['error']}, within step {run['frames']}")
            elif run["stalls"] or run["intersecting"]:
                words = [f"{run['stalls']} stalls, the first in {run['stalled']}"] if run["stalls"] else []
                words += [f"{run['intersecting']} frames that intersect, the first in {run['intersection']}"] if run["intersecting"] else []
                lines.append(where + "; ".join(words))
            else:
                lines.append(f"{where}no stall, no intersection")
    return "\n".join(lines) or "ipctk was not asked."


def plot_axis(panels, scenes, axis, number):
    """Time and collision time over the values of an axis, the defaults' among them where they are a value of it."""
    for name, runs in scenes.items():
        for panel, key in zip(panels, ("seconds", "collision", "iterations")):
            plot_trade.draw(panel, [(x, run[key] / runs[0][key]) for run in runs for x in number(run) if run["done"]], name)
    panels[0].set_title(axis)
    panels[-1].set_xlabel(axis)


def plots(scenes, images):
    images.mkdir(parents=True, exist_ok=True)

    def on(axis, usual):
        return lambda run: [usual] if run["axis"] == "defaults" else [float(run["value"].split()[0])] if run["axis"] == axis else []

    axes = {"tolerance": 1e-6, "inclusion alone": None, "gap share": 0.2, "d-hat": 1}
    figure, panels = plot_trade.panels_of(3, len(axes), figsize=(10, 6.5), sharex="col", sharey="row")
    for column, (axis, usual) in enumerate(axes.items()):
        number = on(axis, usual) if usual else lambda run, axis=axis: [float(run["value"])] if run["axis"] == axis else []
        plot_axis([row[column] for row in panels], scenes, axis, number)
        if axis in ("tolerance", "inclusion alone"):
            panels[0][column].set_xscale("log")
    for row, label in zip(panels, ("time, defaults = 1", "collision time, defaults = 1", "iterations, defaults = 1")):
        row[0].set_ylabel(label)
        row[0].set_yscale("linear" if "iterations" in label else "log")
    plot_trade.legend_below(figure, panels[0][0])
    plot_trade.save(figure, images / "simulation-trade.svg")


def main():
    folder, docs = map(Path, sys.argv[1:])
    scenes = read(folder)
    calm = {name: runs for name, runs in scenes.items() if name != HARD}
    plots(calm, docs / "images")
    parts = {"summary": summary_table(calm), "promise": promise(scenes), "peers": peers(scenes)}
    parts |= {name.replace(", ", "-").replace(" ", "-"): scene_table(runs) for name, runs in scenes.items()}
    if (folder / "machine").exists():
        parts["machine"] = (folder / "machine").read_text().strip()
    fill(docs / "simulation-trade.md", parts.get)
    print(promise(scenes))
    print(peers(scenes))


if __name__ == "__main__":
    main()
