#!/usr/bin/env python3
"""Tables and plots of docs/accuracy-and-speed.md from what scripts/measure-trade.sh has measured.

    report_trade.py MEASURED DOCS

MEASURED: trade-<subject>.json of `onset trade`, baselines-<set>.json of onset_baselines, ipctk-<set>.json of ask_ipctk.py, where
set is handmade, scenes, stability; separation-<set>-<d>.json and tolerance-<set>-<delta>.json of onset_baselines. DOCS: plots go to DOCS/images; in
DOCS/accuracy-and-speed.md what stands between <!-- measured: NAME --> and <!-- end --> is replaced.
"""

import json
import sys
from pathlib import Path

import plot_trade
from fill_measured import fill, table
from plot_trade import axis as of_axis

QUERIES = ["hand-made queries", "pairs of the scenes"]
SETS = {"handmade": QUERIES[0], "scenes": QUERIES[1]}
KINDS = {"vf": "vertex-face", "ee": "edge-edge"}

# Wang, Ferguson et al. 2021, table 1: us, false positives, false negatives; AMD EPYC 7452.
PAPER = {
    ("handmade", "vf"): "IRF 14942.40 87 0|UIRF 124242.00 146 0|FPRF 2.18 9 70|TightCCD 0.38 903 0|RP 1.41 3 5|RRP 928.08 0 5|"
    "BSC 176.17 11 13|MSRF 12.90 16 386|inclusion (theirs) 1532.54 108 0",
    ("handmade", "ee"): "IRF 12452.60 141 0|UIRF 18755.80 268 0|FPRF 0.48 5 147|TightCCD 0.33 404 0|RP 2.33 3 8|RRP 1271.32 0 8|"
    "BSC 121.80 28 47|MSRF 2.72 14 335|inclusion (theirs) 3029.83 214 0",
    ("scenes", "vf"): "IRF 115.89 2 0|UIRF 6191.98 18 0|FPRF 7.53 0 5184|TightCCD 0.24 95638 0|RP 0.25 0 0|RRP 1085.13 0 0|"
    "BSC 34.21 23015 0|MSRF 51.07 75 0|inclusion (theirs) 0.74 2 0",
    ("scenes", "ee"): "IRF 215.80 71 0|UIRF 846.57 16781 0|FPRF 0.23 0 2317|TightCCD 0.23 82277 0|RP 0.37 0 7|RRP 1468.70 0 7|"
    "BSC 12.87 4593 27|MSRF 10.39 228 1|inclusion (theirs) 0.78 17 0",
}
PAPER_QUERIES = {"vf": {"handmade": "12K", "scenes": "18M"}, "ee": {"handmade": "15K", "scenes": "41M"}}

# Table 2: d, then MSRF and theirs, each us, false positives, false negatives.
PAPER_SEPARATION = {
    ("handmade", "vf"): ["12.89 854 114|18.86K 2.6K 0", "15.05 216 2|1.60K 159 0", "13.90 151 35|1.51K 108 0",
                         "13.59 87 141|1.39K 108 0", "14.45 16 384|1.43K 108 0"],
    ("handmade", "ee"): ["3.84 774 189|9.64K 4.8K 0", "2.89 230 18|3.42K 309 0", "2.90 231 21|2.92K 214 0",
                         "2.89 118 157|2.79K 214 0", "3.05 14 335|2.82K 214 0"],
    ("scenes", "vf"): ["55.47 156.8K 18.3K|12.04 8.1M 0", "55.26 75 0|0.72 8 0", "54.83 4 3.8K|0.71 2 0",
                       "53.73 0 10.2K|0.66 2 0", "53.53 0 18.6K|0.66 2 0"],
    ("scenes", "ee"): ["14.42 354.1K 7.0K|19.12 8.3M 0", "11.12 228 1|0.73 40 0", "10.70 10 4|0.72 17 0",
                       "10.68 0 1.7K|0.67 17 0", "10.59 0 5.0K|0.68 17 0"],
}
TOLERANCES = [f"1e-{i}" for i in range(1, 9)]  # delta of figure 15
SEPARATIONS = ["1e-2", "1e-8", "1e-16", "1e-30", "1e-100"]


def read(path):
    with open(path) as file:
        return json.load(file)


def add(total, tally):
    for key, value in tally.items():
        if key in ("slowest_us", "latest"):
            total[key] = max(total.get(key, 0), value)
        elif key != "name":
            total[key] = total.get(key, 0) + value


def tallies(reports, keep):
    """{finder: counts} over the files of all reports that `keep` keeps."""
    found = {}
    for report in reports:
        for file in filter(keep, report["files"]):
            for tally in file["finders"]:
                add(found.setdefault(tally["name"], {}), tally)
    return found


def number(x):
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def time(us):
    return f"{us:.3g} us" if us < 1000 else f"{us / 1000:.3g} ms" if us < 1e6 else f"{us / 1e6:.3g} s"


class Measured:
    def __init__(self, folder):
        self.trades = {p.stem.removeprefix("trade-"): read(p) for p in sorted(folder.glob("trade-*.json"))}
        self.asked = {
            name: [read(folder / f"baselines-{name}.json"), read(folder / f"ipctk-{name}.json")]
            for name in (*SETS, "stability")
        }
        self.load = (folder / "load").read_text().strip()
        self.separations = {(name, d): read(folder / f"separation-{name}-{d}.json") for name in SETS for d in SEPARATIONS}
        self.tolerances = {
            name: {d: tallies([read(folder / f"tolerance-{name}-{d}.json")], lambda file: True) for d in TOLERANCES} for name in SETS
        }

    def group(self, name, kind):
        return tallies(self.asked[name], lambda file: file["kind"] == kind)

    def stability(self):
        series = {"scale": {}, "offset": {}}
        for report in self.asked["stability"]:
            for file in report["files"]:
                what, value = Path(file["file"]).parts[-4:-2]
                for tally in file["finders"]:
                    add(series[what].setdefault(tally["name"], {}).setdefault(float(value), {}), tally)
        return {what: {name: sorted(at.items()) for name, at in finders.items()} for what, finders in series.items()}


# ---- tables

def paper_table(measured, name, kind):
    rows = []
    for finder, t in measured.group(name, kind).items():
        early = t["early_sum"] / max(1, t["positives"] - t["false_positives"])
        rows.append([finder, mean_us(t), t["false_positives"], t["false_negatives"], time(t["slowest_us"]),
                     f"{early:.2g}", t["late"], t["zero"], t["cut"]])
    queries = max(t["queries"] for t in measured.group(name, kind).values())
    head = [f"{SETS[name]}, {KINDS[kind]}: {queries}", "t, us", "FP", "FN", "slowest", "early", "late", "zero", "cut"]
    quoted = [[f"*{who}*", t, fp, fn, *[""] * 5] for who, t, fp, fn in (x.rsplit(" ", 3) for x in PAPER[name, kind].split("|"))]
    return table(head, rows + [[f"*the paper, its {PAPER_QUERIES[kind][name]} queries:*", *[""] * 8]] + quoted)


def separation_table(measured, name, kind):
    rows = []
    for d, quoted in zip(SEPARATIONS, PAPER_SEPARATION[name, kind]):
        found = tallies([measured.separations[name, d]], lambda file: file["kind"] == kind)
        cells = [f"{mean_us(t)} / {t['false_positives']} / {t['false_negatives']}" for t in found.values()]
        rows.append([d, *cells, *(f"*{' / '.join(x.split())}*" for x in quoted.split("|"))])
    return table([f"{SETS[name]}, {KINDS[kind]}: d", *found, "*MSRF (paper)*", "*inclusion (paper)*"], rows)


def mean_us(t):
    return number(t["total_us"] / t["queries"])


def certainty_table(trades):
    rows = []
    for name, trade in trades.items():
        levels = {s["numbers"]["certainty"]: s for s in [trade["settings"][0], *of_axis(trade, "certainty")]}
        for level in ("conservative", "certify", "exact"):
            s = levels[level]
            ratio = s["us"]["median"] / levels["conservative"]["us"]["median"]
            rows.append([name, level, spread_cell(s["us"]), f"{ratio:.2f}", s["positives"], s["certain"], shown(s["false_positives"]),
                         "-" if s["early"] is None else f"{s['early']['mean']:.2g}"])
    head = ["scene", "certainty", "time, median [least, most]", "times conservative", "positives", "certain", "false pos", "early, mean"]
    return table(head, rows)


def tolerance_table(name, at):
    """at: {delta: {finder: counts}}."""
    finders = list(next(iter(at.values())))
    queries = next(iter(at[TOLERANCES[0]].values()))["queries"]
    rows = [[d, *(f"{mean_us(t)} / {t['false_positives']} / {t['cut']}" for t in found.values())] for d, found in at.items()]
    return table([f"{SETS[name]}, {queries}: delta", *finders], rows)


def spread_cell(us):
    return f"{time(us['median'])} [{time(us['min'])}, {time(us['max'])}]"


def shown(x):
    return "-" if x is None else x


def trade_row(s):
    us, early = s["us"], s["early"] or {"mean": None, "max": None}
    return [("**yes**" if s["on_front"] else ""), s["axis"], s["value"], spread_cell(us),
            s["positives"], shown(s["false_positives"]), shown(s["false_negatives"]),
            *("-" if early[k] is None else f"{early[k]:.2g}" for k in ("mean", "max")), s["budget"],
            f"{s['achieved_tolerance']:.2g}", "-" if s["peak_bytes"] is None else f"{s['peak_bytes'] / 2**20:.1f}"]


def trade_table(trade):
    head = ["front", "axis", "value", "time, median [least, most]", "positives", "false pos", "false neg", "early, mean", "early, most",
            "budget", "reached", "MiB"]
    return table(head, [trade_row(s) for s in trade["settings"]])


def front_table(trades):
    rows = []
    for name, trade in trades.items():
        front = sorted((s for s in trade["settings"] if s["on_front"]), key=lambda s: s["us"]["median"])
        words = "; ".join(f"{s['options']} ({time(s['us']['median'])}, {shown(s['false_positives'])} false)" for s in front)
        rows.append([name, "yes" if trade["base_on_front"] else "**no**", words])
    return table(["scene", "defaults on the front", "the front, fastest first"], rows)


def missed_line(measured):
    settings = [s for trade in measured.trades.values() for s in trade["settings"]]
    missed = sum(s["false_negatives"] or 0 for s in settings)
    late = sum(s["early"]["late"] for s in settings if s["early"])
    return (f"{len(settings)} settings on {len(measured.trades)} scenes and sets of queries: {missed} false negatives, "
            f"{late} times of impact later than the exact ones.")


def stability_table(measured):
    series, rows = measured.stability(), []
    queries = {what: sum(tally["queries"] for _, tally in next(iter(series[what].values()))) for what in series}
    head = ["finder", *(f"{what}, {n} queries: FN / zero / FP / late / cut" for what, n in queries.items())]
    for finder in series["scale"]:
        cells = []
        for what in ("scale", "offset"):
            total = {}
            for _, tally in series[what][finder]:
                add(total, tally)
            cells.append(" / ".join(str(total[k]) for k in ("false_negatives", "zero", "false_positives", "late", "cut")))
        rows.append([finder, *cells])
    return table(head, rows)


def machine_text(measured):
    cpp, peer = measured.asked["handmade"]
    return (f"Machine: {cpp['machine']}, load average {measured.load} before. Root finders: boxes narrower than {cpp['width']:g} accepted, at most {cpp['boxes']} boxes a "
            f"query. ipctk {peer['ipctk']}: at most {peer['checks']} iterations, {peer['limit']:g} s a query; its times hold the call "
            f"from Python, {peer['call_us']:.1f} us for one that does nothing.")


def sections(measured):
    parts = {"machine": machine_text(measured), "fronts": front_table(measured.trades), "missed": missed_line(measured),
             "certainty": certainty_table(measured.trades), "stability": stability_table(measured)}
    parts["paper-table-1"] = "\n\n".join(paper_table(measured, name, kind) for name in SETS for kind in KINDS)
    parts["paper-table-2"] = "\n\n".join(separation_table(measured, name, kind) for name in SETS for kind in KINDS)
    parts["paper-figure-15"] = "\n\n".join(tolerance_table(name, at) for name, at in measured.tolerances.items())
    for name, trade in measured.trades.items():
        parts[f"trade-{name}"] = f"{trade['machine']}. Early: against {trade['reference']}.\n\n{trade_table(trade)}"
    return parts


def part_of(parts, name):
    if name not in parts:
        sys.exit(f"nothing was measured for {name}")
    return parts[name]


def plots(measured, images):
    images.mkdir(parents=True, exist_ok=True)
    trades = measured.trades
    plot_trade.tolerance(trades, images / "tolerance.svg")
    plot_trade.finders_over_tolerance({SETS[name]: at for name, at in measured.tolerances.items()}, images / "delta.svg")
    plot_trade.earliness(trades, images / "earliness.svg")
    plot_trade.max_checks(trades, images / "max-checks.svg")
    plot_trade.separation(trades, images / "separation.svg")
    queries = {name: t for name, t in trades.items() if t["settings"][0]["histogram"]}
    plot_trade.histogram(queries, images / "histogram.svg")
    groups = {f"{SETS[name]}\n{KINDS[kind]}": measured.group(name, kind) for name in SETS for kind in KINDS}
    plot_trade.positives(groups, images / "positives.svg")
    plot_trade.stability(measured.stability(), images / "stability.svg")


def main():
    folder, docs = map(Path, sys.argv[1:])
    measured = Measured(folder)
    plots(measured, docs / "images")
    parts = sections(measured)
    fill(docs / "accuracy-and-speed.md", lambda name: part_of(parts, name))
    print(missed_line(measured))
    for name, trade in measured.trades.items():
        print(f"{name}: defaults {'on' if trade['base_on_front'] else 'NOT on'} the Pareto front")


if __name__ == "__main__":
    main()
