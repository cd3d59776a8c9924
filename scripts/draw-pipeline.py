#!/usr/bin/env python3
"""Draws docs/images/pipeline.svg: the stages of the pipeline, and the share of pairs that leaves at each, as the program counts them.

    scripts/draw-pipeline.py build/apps/onset NAME=A,B [NAME=A,B ...] > docs/images/pipeline.svg

A and B are the mesh files of a step. For each scene the program runs four times, and what it prints is all that is drawn:

    onset bench A B --repeats 0 --certainty conservative --json -   an active set that asks no exact arithmetic, and the swept pairs
    onset bench A B --repeats 0 --json -                            the active set as it is by default
    onset active-set A B --csv -                                    how many contacts are proved to be real
    onset step A B --threads 1 --json -                             the step: what is left of the pairs after the boxes have shrunk

One thread, because the pairs that a step drops on the way depend on how soon another thread finds an earlier contact (the step
itself does not).
"""

import csv
import json
import subprocess
import sys
from xml.sax.saxutils import escape

WIDTH, MARGIN = 1000, 20
STAGE, COLUMN, GAP = 330, 200, 10  # widths: the boxes of the stages, the columns of the scenes, what is between
ROW, BOX = 66, 46                  # heights
INK, FAINT, GOES_ON, LEAVES, PANEL = "#1b2733", "#5d6b78", "#2f6fb5", "#c9dcf0", "#eef3f8"


def run(program, *arguments):
    return subprocess.run([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True, text=True).stdout


def ask(program, *arguments):
    return json.loads(run(program, *arguments, "--json", "-"))


def total(stats, stage):
    return sum(stats[stage].values())


class Scene:
    """What the program says about one scene."""

    def __init__(self, program, name, a, b):
        bench = ["bench", a, b, "--repeats", "0"]
        unasked = ask(program, *bench, "--certainty", "conservative")["scenes"][0]
        scene = ask(program, *bench)["scenes"][0]
        step = ask(program, "step", a, b, "--threads", "1")
        stats = scene["stats"]
        self.name = name
        self.faces = scene["faces"]
        self.instruction_set = stats["kernel"]
        self.pairs = [total(stats, "swept"), total(stats, "candidates"), total(stats, "after_culls"),
                      total(unasked["stats"], "contacts"), total(stats, "contacts")]
        rows = csv.DictReader(run(program, "active-set", a, b, "--csv", "-").splitlines())
        self.proved = sum(row["certain"] != "within_tolerance" for row in rows)
        self.searched = total(stats, "inclusion")
        self.checks = stats["checks"] / max(1, self.pairs[2])
        self.step = step["step"]
        self.whole, self.second = self.pairs[1], total(step["stats"], "candidates")
        self.after_culls = total(step["stats"], "after_culls")


class Drawing:
    def __init__(self):
        self.parts = []

    def add(self, text):
        self.parts.append(text)

    def text(self, x, y, words, size=13, colour=INK, anchor="start", weight="normal"):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" text-anchor="{anchor}" '
                 f'font-weight="{weight}">{escape(words)}</text>')

    def box(self, x, y, width, height, fill, stroke="none"):
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{max(width, 0):.1f}" height="{height:.1f}" rx="4" fill="{fill}" stroke="{stroke}"/>')

    def line(self, points, marker=True):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        end = ' marker-end="url(#arrow)"' if marker else ""
        self.add(f'<polyline points="{path}" fill="none" stroke="{FAINT}" stroke-width="1.5"{end}/>')

    def stage(self, x, y, width, title, where):
        self.box(x, y, width, BOX, "#ffffff", INK)
        self.text(x + 10, y + 19, title, 13, weight="bold")
        self.text(x + 10, y + 37, where, 11, FAINT)

    def svg(self, height):
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height:.0f}" viewBox="0 0 {WIDTH} {height:.0f}" '
            'font-family="DejaVu Sans, Verdana, Helvetica, sans-serif">',
            f'<defs><marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
            f'<path d="M0,0 L8,4 L0,8 z" fill="{FAINT}"/></marker></defs>',
            f'<rect width="{WIDTH}" height="{height:.0f}" fill="#ffffff"/>', *self.parts, "</svg>", ""])


def share(part, whole):
    """In percent, never rounded to all or nothing where it is neither."""
    if whole == 0 or part == 0:
        return "0 %"
    percent = 100 * part / whole
    if part == whole:
        return "100 %"
    return f"{min(max(percent, 0.01), 99.99):.2f} %" if percent > 99.9 or percent < 0.1 else f"{percent:.1f} %"


def column(index):
    return MARGIN + STAGE + GAP + index * (COLUMN + GAP)


# What removes pairs, and where; then what is left is called.
STAGES = [
    ("boxes at both ends, or moving", "broadphase/: box_test, motion_box, bvh/", "candidates"),
    ("culls, eight pairs in floats", "narrowphase/kernel/cull.inl", "left by the culls"),
    ("advancement and certificates, doubles", "kernel/advance.inl, interval_certificate, inclusion", "not certified free"),
    ("exact decision and proof, integers", "decide_exactly, kernel/contact_certificate, exact/", "contacts"),
]


def draw_active_set(d, scenes, y):
    d.text(MARGIN, y, "Active set: every pair that comes into contact in the whole step", 15, weight="bold")
    y += 26
    for i, s in enumerate(scenes):
        d.text(column(i), y, s.name, 13, weight="bold")
        d.text(column(i), y + 16, f"{s.faces:,} triangles", 11, FAINT)
    y += 30
    d.stage(MARGIN, y, STAGE, "boxes of the whole motion overlap", "onset candidates; not stored on the way to contacts")
    for i, s in enumerate(scenes):
        d.box(column(i), y + 24, COLUMN, 12, GOES_ON)
        d.text(column(i), y + 18, f"{s.pairs[0]:,} pairs", 12)
    for k, (title, where, left) in enumerate(STAGES):
        above, y = y + BOX, y + ROW
        d.line([(MARGIN + STAGE / 2, above), (MARGIN + STAGE / 2, y)])
        d.stage(MARGIN, y, STAGE, title, where)
        for i, s in enumerate(scenes):
            came, remain = s.pairs[k], s.pairs[k + 1]
            d.text(column(i), y + 18, f"{remain:,} {left}", 12)
            d.box(column(i), y + 24, COLUMN, 12, LEAVES)
            d.box(column(i), y + 24, COLUMN * remain / max(came, 1), 12, GOES_ON)
            d.text(column(i), y + 50, f"{share(came - remain, came)} of {came:,} leave", 11, FAINT)
            if k + 1 == len(STAGES):
                d.text(column(i), y + 65, f"{s.proved:,} are proved to be real", 11, FAINT)
    y += BOX + 42
    d.text(MARGIN, y, "checks a pair that the culls leave", 11, FAINT)
    d.text(MARGIN, y + 16, "pairs that the inclusion root finder was asked about", 11, FAINT)
    for i, s in enumerate(scenes):
        d.text(column(i), y, f"{s.checks:.1f}", 11, FAINT)
        d.text(column(i), y + 16, f"{s.searched:,}", 11, FAINT)
    return y + 16


LOOP = [
    ("sample", "one block of pairs in 64, or in 256", "src/shared/find_contacts.cpp"),
    ("t_max", "the earliest contact it has found", "decided as above"),
    ("shrink", "boxes of [0, t_max] instead of [0, 1]", "BroadPhase::refit"),
    ("second traversal", "every pair of the smaller boxes", "src/shared/pair_traversal.cpp"),
    ("step", "the smallest limit of all pairs", "limit_step"),
]


def draw_step(d, scenes, y):
    d.text(MARGIN, y, "Step: only the earliest contact matters", 15, weight="bold")
    y += 30
    gap = 22
    width = (WIDTH - 2 * MARGIN - gap * (len(LOOP) - 1)) / len(LOOP)
    for k, (title, what, where) in enumerate(LOOP):
        x = MARGIN + k * (width + gap)
        d.box(x, y, width, 62, "#ffffff", INK)
        d.text(x + 8, y + 19, title, 13, weight="bold")
        d.text(x + 8, y + 36, what, 9, INK)
        d.text(x + 8, y + 52, where, 9, FAINT)
        if k + 1 < len(LOOP):
            d.line([(x + width, y + 31), (x + width + gap, y + 31)])
    middle = [MARGIN + k * (width + gap) + width / 2 for k in range(len(LOOP))]
    d.line([(middle[3], y + 62), (middle[3], y + 84), (middle[1], y + 84), (middle[1], y + 62)])
    d.text((middle[1] + middle[3]) / 2, y + 98, "each contact found lowers t_max; boxes stay, and pairs that are certified beyond it are dropped",
           10, FAINT, "middle")
    y += 126
    rows = [("candidates of the whole step", lambda s: f"{s.whole:,}"),
            ("candidates of the second traversal", lambda s: f"{s.second:,} ({share(s.second, s.whole)})" if s.second < s.whole
             else f"{s.second:,}, not shrunk"),
            ("of these left by the culls", lambda s: f"{s.after_culls:,}"),
            ("step", lambda s: f"{s.step:.6g}")]
    for words, value in rows:
        d.text(MARGIN, y, words, 12)
        for i, s in enumerate(scenes):
            d.text(column(i), y, value(s), 12)
        y += 19
    return y


def main(program, *scenes):
    asked = []
    for scene in scenes:
        name, _, files = scene.partition("=")
        asked.append(Scene(program, name, *files.split(",")))
    if not 1 <= len(asked) <= 3:
        sys.exit(__doc__)
    d = Drawing()
    y = draw_active_set(d, asked, 34)
    y = draw_step(d, asked, y + 48)
    d.text(MARGIN, y + 14, f"Counts as printed by onset bench and onset step ({asked[0].instruction_set}); dark: what goes on, light: what leaves. "
           "Made by scripts/draw-pipeline.py.", 10, FAINT)
    sys.stdout.write(d.svg(y + 30))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
