"""The plots of docs/accuracy-and-speed.md, from what report_trade.py has read."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams |= {"font.size": 8, "svg.hashsalt": "onset", "svg.fonttype": "none", "axes.grid": True, "grid.alpha": 0.3}
SHARE_FLOOR = 1e-8  # where a logarithmic axis shows zero


def panels_of(*shape, **options):
    return plt.subplots(*shape, layout="constrained", **options)


def legend_below(figure, panel):
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=6)


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def axis(trade, name):
    return [s for s in trade["settings"] if s["axis"] == name]


def relative(setting):
    return setting["numbers"]["relative_tolerance"]


def draw(axes, points, label, style="o-"):
    """points: (x, y), y None where it is not known."""
    points = sorted((x, y) for x, y in points if y is not None)
    axes.plot([x for x, _ in points], [y for _, y in points], style, markersize=3, label=label)


def base_and(trade, name):
    return [trade["settings"][0], *axis(trade, name)]


def both_narrow_phases(axes, trades, value):
    for index, (name, trade) in enumerate(trades.items()):
        draw(axes, [(relative(s), value(s)) for s in base_and(trade, "tolerance")], name, f"C{index}o-")
        draw(axes, [(relative(s), value(s)) for s in axis(trade, "narrow-phase")], f"{name}, inclusion alone", f"C{index}s--")
    axes.set_xscale("log")
    axes.set_xlabel("relative tolerance")


def tolerance(trades, path):
    figure, (left, right) = panels_of(1, 2, figsize=(9, 3.6))
    both_narrow_phases(left, trades, lambda s: s["us"]["median"])
    left.set_yscale("log")
    left.set_ylabel("us: an active set, a query")
    both_narrow_phases(right, trades, lambda s: s["false_positives"])
    right.set_yscale("symlog", linthresh=1)
    right.set_ylim(bottom=-0.5)
    right.set_ylabel("false positives")
    legend_below(figure, right)
    save(figure, path)


def finders_over_tolerance(sets, path):
    """sets: {name: {delta: {finder: tally}}}; figure 15 of the paper."""
    figure, panels = panels_of(2, len(sets), figsize=(4.5 * len(sets), 5.5), sharex=True, squeeze=False)
    for (time, wrong), (name, at) in zip(zip(*panels), sets.items()):
        for finder in next(iter(at.values())):
            tallies = [(float(delta), found[finder]) for delta, found in at.items()]
            draw(time, [(delta, t["total_us"] / t["queries"]) for delta, t in tallies], finder)
            draw(wrong, [(delta, t["false_positives"]) for delta, t in tallies], finder)
        time.set_title(name)
        time.set_xscale("log")
        time.set_yscale("log")
        wrong.set_yscale("symlog", linthresh=1)
        wrong.set_ylim(bottom=-0.5)
        wrong.set_xlabel("delta")
    panels[0][0].set_ylabel("us a query")
    panels[1][0].set_ylabel("false positives")
    legend_below(figure, panels[0][0])
    save(figure, path)


def earliness(trades, path):
    figure, panels = panels_of(1, 2, figsize=(9, 3.6), sharey=True)
    for panel, key in zip(panels, ("mean", "max")):
        both_narrow_phases(panel, trades, lambda s: max(s["early"][key], 1e-17) if s["early"] else None)
        panel.set_yscale("log")
        panel.set_title(f"{key}")
    panels[0].set_ylabel("time of impact before the exact one (step = 1)")
    legend_below(figure, panels[1])
    save(figure, path)


def max_checks(trades, path):
    figure, (left, right) = panels_of(1, 2, figsize=(9, 3.6))
    for name, trade in trades.items():
        points = [(s["numbers"]["max_checks"], s) for s in base_and(trade, "max-checks")]
        draw(left, [(x, max(s["budget"] / s["asked"], SHARE_FLOOR)) for x, s in points], name)
        draw(right, [(x, s["us"]["median"] / trade["settings"][0]["us"]["median"]) for x, s in points], name)
    for panel in (left, right):
        panel.set_xscale("log")
        panel.set_xlabel("max_checks")
    left.set_yscale("log")
    left.set_ylabel("share of pairs ended early")
    right.set_ylabel("time, default = 1")
    legend_below(figure, right)
    save(figure, path)


def separation(trades, path):
    figure, (left, right) = panels_of(1, 2, figsize=(9, 3.6))
    for name, trade in trades.items():
        settings = [s for s in axis(trade, "min-separation") if s["numbers"]["min_separation"] > 0]
        base = trade["settings"][0]
        draw(left, [(s["numbers"]["min_separation"], s["us"]["median"] / base["us"]["median"]) for s in settings], name)
        draw(right, [(s["numbers"]["min_separation"], s["positives"]) for s in settings], name)
    for panel in (left, right):
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_xlabel("min_separation (model length)")
    left.set_ylabel("time, no separation = 1")
    right.set_ylabel("positives")
    legend_below(figure, right)
    save(figure, path)


def histogram(trades, path):
    figure, panels = panels_of(1, len(trades), figsize=(4.5 * len(trades), 3.2), squeeze=False)
    for panel, (name, trade) in zip(panels[0], trades.items()):
        h = trade["settings"][0]["histogram"]
        for key, colour in (("negative", "C0"), ("positive", "C3")):
            edges = [h["first_us"] * 10 ** (i / h["bins_a_decade"]) for i in range(len(h[key]) + 1)]
            panel.stairs(h[key], edges, fill=True, alpha=0.5, color=colour, label=key)
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_xlabel("us a query")
        panel.set_title(name)
        panel.legend()
    panels[0][0].set_ylabel("queries")
    save(figure, path)


def positives(groups, path):
    """groups: {name: {finder: tally}}: what each finder reports, against what collides."""
    figure, panels = panels_of(1, len(groups), figsize=(3 * len(groups), 3.6))
    for panel, (name, tallies) in zip(panels, groups.items()):
        first = next(iter(tallies.values()))
        truth = first["positives"] - first["false_positives"] + first["false_negatives"]
        panel.barh(list(tallies), [t["positives"] / t["queries"] * first["queries"] for t in tallies.values()])
        panel.axvline(truth, color="k", label=f"collide: {truth:.0f}")
        panel.set_xlabel(f"positives of {first['queries']} queries")
        panel.set_title(name)
        panel.invert_yaxis()
        panel.legend(fontsize=6)
        if panel is not panels[0]:
            panel.set_yticklabels([])
    save(figure, path)


def stability(series, path):
    """series: {"scale": {finder: [(x, tally)]}, "offset": ...}."""
    counts = [("false_negatives", "false negatives"), ("zero", "toi 0, exact one later"), ("false_positives", "false positives")]
    figure, panels = panels_of(len(counts), 2, figsize=(9, 7), sharex="col")
    for column, (what, finders) in enumerate(series.items()):
        for row, (key, label) in enumerate(counts):
            panel = panels[row][column]
            for index, (finder, points) in enumerate(finders.items()):
                style = f"C{index}o-" if finder.startswith("onset") else f"C{index}x--"
                draw(panel, [(x, tally[key] / tally["queries"]) for x, tally in points], finder, style)
            if what == "offset":
                panel.set_xscale("symlog", linthresh=1)
            else:
                panel.set_xscale("log")
            panel.set_ylim(-0.03, None)
            if column == 0:
                panel.set_ylabel(f"{label}, share")
        panels[-1][column].set_xlabel(what)
    legend_below(figure, panels[0][1])
    save(figure, path)
