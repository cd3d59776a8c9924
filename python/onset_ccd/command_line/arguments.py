"""The options of the commands, by the names of the native command line."""

import argparse

from ..files.errors import UsageError
from ..trade import AXES
from . import values

MOST = 2**63 - 1
SIGNED = ("--plane",)
FORMATS = "every format of meshio: .msh, .vtk, .vtu, .stl, .obj, .ply, .off, .xdmf, ..."
EXAMPLES = """Examples:
  python -m onset_ccd step before.vtk after.vtk             how far the motion can go
  python -m onset_ccd active-set a.msh b.msh --csv -        what touches, one row a pair
  python -m onset_ccd check before.vtu                      whether a step can start there, and what is in the way
  python -m onset_ccd step a.obj b.obj --screenshot s.png   a picture of it
  python -m onset_ccd trade before.stl after.stl            what each setting costs and gives, on this scene
Exit status: 0 done, whatever the outcome is; 1 bad input, or output that cannot be written; 2 wrong usage; 3 check has found
something."""

STEP_COLUMNS = "outcome,step,kind,a,b,v0,v1,v2,v3,toi,toi_hi,rounding"
ACTIVE_SET_COLUMNS = ("kind,a,b,toi,v0,v1,v2,v3,status,certain,toi_hi,w0,w1,w2,w3,nx,ny,nz,gap,speed,degenerate,step_limit")
START_COLUMNS = "fault,kind,a,b,v0,v1,v2,v3,v4,distance,separation"


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message):
        raise UsageError(f"{message.removeprefix('argument ')} (see {self.prog} --help)")


def add_accuracy(parser):
    group = parser.add_argument_group("accuracy")
    either = group.add_mutually_exclusive_group()
    either.add_argument("--tolerance", type=values.real(False), metavar="LENGTH",
                        help="report a pair once it is closer than the separation plus LENGTH (model length, > 0)")
    either.add_argument("--relative-tolerance", type=values.real(False), metavar="FACTOR",
                        help="the same as FACTOR times the scene's R, the largest corner difference that an overlapping pair can have [1e-6]")
    group.add_argument("--max-checks", type=values.whole(1, MOST), metavar="COUNT",
                       help="checks that one pair may cost; then its time so far counts [10000]")
    group.add_argument("--touching-may-pass-through", action="store_true", default=None,
                       help="what touches at the start may leave in any direction, as if that were the side it came from")
    group.add_argument("--min-separation", type=values.real(True), metavar="LENGTH",
                       help="pairs must stay farther apart than this (model length) [0]")
    group.add_argument("--norm", choices=["euclidean", "maximum"], help="norm of the minimum separation [euclidean]")
    group.add_argument("--certainty", "--exactness", dest="exactness", choices=["conservative", "certify", "exact"],
                       help="how far to tell real contacts from those within the tolerance; exact: until it is known [certify]")


def add_running(parser):
    group = parser.add_argument_group("budgets and how the work is done")
    group.add_argument("--time-limit", type=values.real(True), metavar="SECONDS", help="then the answer is what is certain by then [none]")
    group.add_argument("--check-limit", type=values.whole(0, MOST), metavar="COUNT", help="the same for the checks of all pairs [none]")
    group.add_argument("--memory-limit", type=values.whole(0, MOST), metavar="BYTES", help="the same for what is kept of each pair [none]")
    group.add_argument("--threads", type=values.whole(0, 4096), metavar="COUNT", help="at most COUNT; 0: all cores. The result is the same [0]")
    group.add_argument("--broad-phase", choices=["auto", "bvh", "hash", "brute"], help="how pairs are found")
    group.add_argument("--narrow-phase", choices=["auto", "inclusion"], help="how pairs are decided; inclusion: by the paper's root finder alone")
    group.add_argument("--kernel", dest="instruction_set", choices=["auto", "scalar", "avx2", "avx512"], help="instruction set. The result is the same")


def add_bodies(parser):
    group = parser.add_argument_group("what the scene is made of")
    body = values.whole(0, 2**31 - 1)
    group.add_argument("--bodies", choices=["one", "components"], default="one", help="what a body is: all of the mesh, or each connected part")
    group.add_argument("--static-body", type=body, action="append", default=[], metavar="I",
                       help="body I stays where it is and never meets what is static (repeat)")
    group.add_argument("--rigid-body", type=body, action="append", default=[], metavar="I", help="body I never meets itself (repeat)")
    group.add_argument("--rigid", action="store_true", help="no body meets itself")
    group.add_argument("--dim", type=int, choices=[2, 3], default=3, help="2: lines in the plane z = 0, whose vertices meet edges; no faces")
    group.add_argument("--weld", action="store_true", help="vertices at one place at both ends of the step count as one, as at a seam")
    group.add_argument("--rings", type=values.whole(0, 2**31 - 1), default=0, metavar="N",
                       help="pairs joined by at most N edges of the mesh never meet, as those that share a vertex")
    group.add_argument("--body-separation", type=values.body_separation, action="append", default=[], metavar="I,J,LENGTH",
                       help="bodies I and J (or I and itself) keep LENGTH in place of --min-separation (repeat)")
    group.add_argument("--rest", type=values.path, metavar="FILE",
                       help="the same mesh at rest: no pair keeps more than a share of its distance there")
    group.add_argument("--rest-share", type=values.share, metavar="S", help="that share [0.5]")
    group.add_argument("--plane", type=values.plane, action="append", default=[], metavar="NX,NY,NZ,OFFSET",
                       help="a half-space that vertices stay out of: x is free where nx x + ny y + nz z > offset (repeat)")


def add_outputs(parser, columns, picture):
    group = parser.add_argument_group("outputs")
    group.add_argument("--json", type=values.path, metavar="FILE", help="write the result as JSON to FILE, or to stdout for -")
    group.add_argument("--csv", type=values.path, metavar="FILE", help=f"write CSV to FILE, or to stdout for -: {columns}")
    if picture:
        group.add_argument("--show", action="store_true", help="open a window with the mesh and what was found (pyvista)")
        group.add_argument("--screenshot", type=values.path, metavar="FILE.png", help="the same as a picture, without a display")


def add_command(commands, name, summary, columns, picture=True):
    parser = commands.add_parser(name, help=summary, description=summary + ".", allow_abbrev=False)
    second = {} if name != "check" else {"nargs": "?"}
    parser.add_argument("A", type=values.path, help=f"mesh at the start of the step: {FORMATS}")
    parser.add_argument("B", type=values.path, **second, help="the same mesh at its end" + (
        "; tells which copied vertices stay together" if second else ": the same elements in the same order"))
    add_accuracy(parser)
    add_running(parser)
    add_bodies(parser)
    add_outputs(parser, columns, picture)
    return parser


def parser():
    top = Parser(prog="python -m onset_ccd", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=EXAMPLES, allow_abbrev=False,
                 description="Conservative continuous collision detection: when does a moving mesh first touch itself?")
    top.add_argument("--version", action="store_true", help="print the version")
    commands = top.add_subparsers(dest="command", metavar="COMMAND")
    add_command(commands, "step", "the largest step from A towards B that is certainly free of contact", STEP_COLUMNS)
    active = add_command(commands, "active-set", "every pair that comes into contact between A and B, with its time of impact",
                         ACTIVE_SET_COLUMNS)
    active.add_argument("--window", type=values.real(True), metavar="TIME", help="only contacts with toi <= earliest toi + TIME [all]")
    add_command(commands, "check", "whether a step can start at A: intersections, touching pairs, copied vertices and more, exactly",
                START_COLUMNS)
    trade = add_command(commands, "trade", "tries the settings around the given ones: time, false positives and earliness of each",
                        "one row a setting", picture=False)
    trade.add_argument("--axis", type=values.names(AXES), default=list(AXES), metavar="NAME,...",
                       help=f"only these axes around the base setting; all by default: {', '.join(AXES)}")
    trade.add_argument("--repeats", type=values.whole(1, 1000), default=9, metavar="COUNT",
                       help="measurements of each setting, after one to warm up [9]")
    trade.add_argument("--seconds", type=values.real(True), default=5.0, metavar="SECONDS",
                       help="measure a setting again while it has not taken as long [5]")
    return top


OPTIONS = ("tolerance", "relative_tolerance", "max_checks", "touching_may_pass_through", "min_separation", "norm", "exactness", "time_limit",
           "check_limit", "memory_limit", "threads", "broad_phase", "narrow_phase", "instruction_set", "window")


def parse(words):
    """A value may start with a minus sign, which argparse would take for an option."""
    joined = []
    for word in words:
        if joined and joined[-1] in SIGNED:
            joined[-1] += "=" + word
        else:
            joined.append(word)
    top = parser()
    arguments = top.parse_args(joined)
    if arguments.command is None and not arguments.version:
        top.error("a command is required")
    return arguments


def to_options(arguments):
    """What the calls take; an option that was not given is not among them."""
    given = {name: getattr(arguments, name, None) for name in OPTIONS}
    return {name: "automatic" if value == "auto" else value for name, value in given.items() if value is not None}
