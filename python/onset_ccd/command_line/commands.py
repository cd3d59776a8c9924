"""What each command does: read, ask the library, write."""

import json
import sys
import time

import onset_ccd

from ..files.errors import InputError
from ..files.outputs import Outputs, print_out
from ..files.places import copies_together
from ..files.scene import read_scene
from . import report, start_report
from .arguments import ACTIVE_SET_COLUMNS, START_COLUMNS, STEP_COLUMNS, to_options
from .bodies import set_bodies

EXIT_NOT_CLEAN = 3


class Run:
    """One command: its scene, its options, and where its results go."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.options = to_options(arguments)
        self.scene = read_scene(arguments.A, arguments.B)
        set_bodies(arguments, self.scene)
        self.outputs = Outputs([arguments.A, arguments.B, arguments.rest])
        self.notes = list(self.scene.notes)
        for option in ("json", "csv", "screenshot"):
            if getattr(arguments, option, None):
                self.outputs.announce(f"--{option}", getattr(arguments, option))
        if getattr(arguments, "show", False) or getattr(arguments, "screenshot", None):
            check_pictures(arguments)

    def call(self, function, *positions, **more):
        """A call of the library, which says what it refuses."""
        try:
            return function(self.scene.mesh, *positions, **{**self.options, **more})
        except ValueError as error:
            raise InputError(str(error)) from None

    def finish(self, result, csv, summary):
        """The summary goes to stdout unless another output does."""
        a, said = self.arguments, "".join(f"note        {note}\n" for note in self.notes)
        if self.notes:
            result["notes"] = self.notes
        if a.json:
            self.outputs.write(a.json, json.dumps(report.finite(result), indent=2, ensure_ascii=False) + "\n")
        if a.csv:
            self.outputs.write(a.csv, csv())
        self.outputs.finish()
        if "-" not in (a.json, a.csv):
            print_out(said + summary)
        elif not a.json:
            sys.stderr.write(said)

    def picture(self, draw):
        """`draw` makes a picture of what was found, where one is asked for, before anything is written."""
        a = self.arguments
        if a.screenshot:
            from ..show import png

            self.outputs.write(a.screenshot, png(draw))

    def show(self, draw):
        if self.arguments.show:
            from ..show import window

            window(draw)


def check_pictures(arguments):
    """What is missing for one is known before the work starts."""
    from ..show import check_picture_name, choose_window

    if arguments.screenshot:
        check_picture_name(arguments.screenshot)
        choose_window(True)
    if arguments.show:
        choose_window(False)


def seam_hint(scene, shown=3):
    """What makes seams touch from the start, and the flag for it; empty where nothing does."""
    copies = [] if scene.welded else copies_together(scene.x_t0, scene.x_t1)
    if not copies:
        return ""
    named = ", ".join("{} and {}".format(*scene.ids(copy)) for copy in copies[:shown])
    more = f" and {len(copies) - shown} more pairs" if len(copies) > shown else ""
    return f"; vertices {named}{more} are at one place: --weld counts them as one"


def note_start(run, in_contact):
    """One line where the start intersects or touches itself, which no step can mend. `in_contact`: the result says that a pair touches at
    t = 0, or is closer than the separation."""
    limit = run.options.get("time_limit", float("inf"))
    names = ("threads", "broad_phase", "instruction_set", "time_limit")
    began = time.monotonic()
    options = {name: run.options[name] for name in names if name in run.options}
    may_meet = onset_ccd.has_intersections(run.scene.mesh, run.scene.start(), **options)
    out_of_time = time.monotonic() - began >= limit
    if may_meet and out_of_time:
        run.notes.append("whether the start intersects itself was not found out within the time limit")
    meets = may_meet and not out_of_time
    if not meets and not in_contact:
        return
    apart = not meets and run.options.get("min_separation", 0) > 0
    run.notes.append("the start " + ("intersects or touches itself" if meets else "touches itself") +
                     (", or is closer than the separation" if apart else "") +
                     f": see 'python -m onset_ccd check {run.scene.path}'{seam_hint(run.scene)}")


def step(arguments):
    run = Run(arguments)
    scene = run.scene
    result = run.call(onset_ccd.compute_collision_free_stepsize, scene.start(), scene.end())
    if result.vertex < 0:
        note_start(run, result.outcome == onset_ccd.Outcome.initial_contact)

    def draw(plotter):
        from ..show import draw_step

        draw_step(plotter, scene.mesh, scene.start(), scene.end(), result)

    run.picture(draw)
    run.finish(report.step_json(scene, result), lambda: report.step_csv(scene, result, STEP_COLUMNS),
               report.describe_sizes(scene) + report.describe_step(scene, result) + report.describe_stats(result.stats))
    run.show(draw)
    return 0


def active_set(arguments):
    run = Run(arguments)
    scene = run.scene
    found = run.call(onset_ccd.construct_active_set, scene.start(), scene.end())
    if found.vertex < 0:
        note_start(run, bool((found.contacts["outcome"] == int(onset_ccd.PairOutcome.initial_contact)).any()))

    def draw(plotter):
        from ..show import draw_active_set

        draw_active_set(plotter, scene.mesh, scene.start(), scene.end(), found)

    run.picture(draw)
    run.finish(report.active_set_json(scene, found), lambda: report.active_set_csv(scene, found, ACTIVE_SET_COLUMNS),
               report.describe_sizes(scene) + report.describe_active_set(scene, found) + report.describe_stats(found.stats))
    run.show(draw)
    return 0


def join_copies(run):
    """With the end of a step, --weld makes one only of what is together there too, as it does in a step."""
    scene = run.scene
    if not run.arguments.weld or run.arguments.B is None:
        return
    if copies_together(scene.x_t0, scene.x_t1) == copies_together(scene.x_t0, scene.x_t0):
        return
    rules = scene.mesh.rules
    rules.weld = False
    rules.excluded_vertices = start_report.at_the_end(onset_ccd.duplicate_vertices(scene.x_t0), scene.x_t1).together
    scene.mesh.rules = rules


def check(arguments):
    run = Run(arguments)
    scene = run.scene
    join_copies(run)
    found = run.call(onset_ccd.check, scene.start())
    copies = None if arguments.B is None else start_report.at_the_end(found.copied_vertices, scene.x_t1)
    findings = start_report.Findings(scene, found, copies)

    def draw(plotter):
        from ..show import draw_start

        draw_start(plotter, scene.mesh, scene.start(), found)

    run.picture(draw)
    run.finish(start_report.to_json(findings), lambda: start_report.to_csv(findings, START_COLUMNS),
               report.describe_sizes(scene) + start_report.describe(findings))
    run.show(draw)
    return 0 if found.clean() else EXIT_NOT_CLEAN


def trade(arguments):
    from . import trade_report
    from ..trade import trade as measure

    run = Run(arguments)
    scene = run.scene
    try:
        rows = measure(scene.mesh, scene.start(), scene.end(), axes=arguments.axis, repeats=arguments.repeats, seconds=arguments.seconds,
                       **run.options)
    except ValueError as error:
        raise InputError(str(error)) from None
    subject = f"{arguments.A} {arguments.B}: {report.describe_sizes(scene)[12:]}"
    run.finish(trade_report.to_json(subject, rows), lambda: trade_report.to_csv(rows), subject + trade_report.describe(rows))
    return 0


COMMANDS = {"step": step, "active-set": active_set, "check": check, "trade": trade}

