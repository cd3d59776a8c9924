#!/usr/bin/env python3
"""Runs short simulations at many settings, and writes what each cost and gave, one JSON file a scene.

    measure.py OUT --cloth onset_cloth [--elastic onset_elastic] [--ipctk PYTHON] [--quick] [--only SCENE ...] [--jobs 2] [--limit SECONDS]

PYTHON: an interpreter that has ipctk, whose root finders then take the library's place too. A run that is not done after the limit is
ended, and counts as far as its frames go. Every frame is checked for intersections by exact predicates. Seconds are CPU seconds, so that runs
may go side by side.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import time

SERVER = pathlib.Path(__file__).resolve().parent / "ipctk_server.py"

# Name: program, its size, steps, other arguments, and the option with the length that the barrier reaches or the constraints keep, and its
# default.
REACH, SEPARATION = ("--reach", 0.1), ("--separation", 1e-3)
SCENES = {
    "cloth, sphere": ("cloth", 1200, 50, "--scene sphere", REACH),
    "cloth, twist": ("cloth", 1200, 50, "--scene twist", REACH),
    "cloth, pile": ("cloth", 1200, 60, "--scene pile --time-step 0.004", REACH),
    "cloth, hard pile": ("cloth", 400, 15, "--scene pile --time-step 0.02", ("--reach", 1e-4)),
    "torus, barrier": ("elastic", 700, 50, "--scene torus --contact barrier", SEPARATION),
    "torus, active set": ("elastic", 700, 50, "--scene torus --contact active-set", SEPARATION),
    "bars, barrier": ("elastic", 700, 30, "--scene bars --contact barrier --time-step 0.02", SEPARATION),
    "bars, active set": ("elastic", 700, 30, "--scene bars --contact active-set --time-step 0.02", SEPARATION),
}
QUICK = {"cloth, sphere": (100, 4), "torus, barrier": (200, 3)}  # size and steps
SIZE = {"cloth": "--triangles", "elastic": "--tetrahedra"}


def settings(reach, ipctk):
    """(axis, value, arguments), those at the defaults first."""
    option, usual = reach
    yield "defaults", "", []
    for value in ("1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-7", "1e-8"):
        yield "tolerance", value, ["--relative-tolerance", value]
    for value in ("1e-2", "1e-4", "1e-6", "1e-8"):
        yield "inclusion alone", value, ["--narrow-phase", "inclusion", "--relative-tolerance", value]
    for value in ("conservative", "exact"):
        yield "certainty", value, ["--certainty", value]
    for value in ("0.02", "0.5", "0.8"):
        yield "gap share", value, ["--gap-share", value]
    for factor in (0.5, 2):
        yield "d-hat", f"{factor:g} times", [option, f"{factor * usual:g}"]
    yield "step", "per vertex", ["--per-vertex"]
    for peer in ("TightInclusionCCD", "AdditiveCCD") if ipctk else ():
        yield "ipctk", peer, ["--collision-server", f"{shlex.quote(ipctk)} -B {shlex.quote(str(SERVER))} {peer}"]


def positions(frame):
    """The bytes of the positions of a .vtu."""
    arrays = frame.read_bytes().partition(b'<AppendedData encoding="raw">\n_')[2]
    return memoryview(arrays[8 : 8 + int.from_bytes(arrays[:8], "little")]).cast("d")


def farthest(a, b):
    """Between the places of a vertex in two frames."""
    squares = [(x - y) ** 2 for x, y in zip(a, b)]
    return max(map(sum, zip(*[iter(squares)] * 3))) ** 0.5


def found(pattern, text):
    match = re.search(pattern, text, re.M)
    return match and match[1]


def run(program, arguments, folder, limit):
    """A run in an empty folder, and what it says of itself."""
    folder.mkdir(parents=True)
    start = time.monotonic()
    command = [program, *arguments, "--threads", "1", "--check", "--json", str(folder / "steps.json"), "--out", str(folder)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        text, errors = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # with its collision server
        text, errors = process.communicate()
        errors = f"not done after {limit:g} s"
    frames = sorted(folder.glob("frame_*.vtu"))
    result = {"wall": time.monotonic() - start, "frames": len(frames), "error": errors.strip().splitlines()[-1] if errors.strip() else "",
              "bytes": hashlib.sha256(b"".join(f.read_bytes() for f in frames)).hexdigest()}
    if "intersections " not in text:
        return result | {"done": False}
    steps = [json.loads(line) for line in (folder / "steps.json").read_text().splitlines()]
    energies = [s["energy"] for s in steps]
    total = lambda key: sum(s[key] for s in steps)
    return result | {
        "done": True, "steps": len(steps), "converged": total("converged"), "iterations": total("iterations"),
        "seconds": total("seconds"), "collision": total("seconds_collision"), "smallest_step": min(s["smallest_step"] for s in steps),
        "contacts": max(s["contacts"] for s in steps), "closest": min(s["closest"] for s in steps), "stalls": total("stalls"),
        "stalled": found(r"^stalls +\d+, first in (.*)$", text), "intersecting": int(found(r"^intersections +in (\d+)", text)),
        "intersection": found(r"^ +first in (.*)$", text), "height": steps[-1]["height"], "energy": energies[-1],
        "energy_range": max(energies) - min(energies), "behind": max(s["behind"] for s in steps),
    }


def plan(options):
    for name, (program, size, steps, arguments, reach) in SCENES.items():
        if not getattr(options, program) or name not in (options.only or (QUICK if options.quick else SCENES)):
            continue
        if options.quick:
            size, steps = QUICK.get(name, (200, 3))
        for axis, value, chosen in settings(reach, options.ipctk):
            if not options.quick or axis in ("defaults", "step", "ipctk") or value == "1e-1":
                kept = [] if axis == "d-hat" else [reach[0], str(reach[1])]
                whole = [*arguments.split(), SIZE[program], str(size), "--steps", str(steps), *kept, *chosen]
                yield name, axis, value, getattr(options, program), whole


def frame_folder(out, name, axis, value):
    return out / "frames" / re.sub(r"[^a-z0-9.-]+", "-", f"{name} {axis} {value}".lower())


def measure(options, plans):
    """Of each plan its run, in their order, with a line of progress for each."""
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        asked = [pool.submit(run, program, arguments, frame_folder(options.out, name, axis, value), options.limit)
                 for name, axis, value, program, arguments in plans]
        start, done = time.monotonic(), 0
        for _ in concurrent.futures.as_completed(asked):
            done += 1
            left = (time.monotonic() - start) * (len(asked) - done) / done
            print(f"\r{done} of {len(asked)} runs, {left / 60:.0f} min left ", end="" if done < len(asked) else "\n", file=sys.stderr, flush=True)
    return [future.result() for future in asked]


def compare(out, name, runs):
    """Adds what can be told beside the run at the defaults, the first."""
    last = lambda r: max(frame_folder(out, name, r["axis"], r["value"]).glob("frame_*.vtu"), default=None)
    usual = runs[0]
    for r in runs:
        r["same_bytes"] = r["bytes"] == usual["bytes"]
        both = r["done"] and usual["done"]
        r["apart"] = farthest(positions(last(r)), positions(last(usual))) if both else None
        r["energy_drift"] = (r["energy"] - usual["energy"]) / usual["energy_range"] if both else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--cloth", required=True)
    parser.add_argument("--elastic")
    parser.add_argument("--ipctk")
    parser.add_argument("--quick", action="store_true", help="small scenes, few settings")
    parser.add_argument("--only", nargs="+", choices=SCENES, metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit", type=float, default=300)
    options = parser.parse_args()
    plans = list(plan(options))
    scenes = {}
    for (name, axis, value, _, arguments), result in zip(plans, measure(options, plans)):
        scenes.setdefault(name, []).append({"axis": axis, "value": value, "arguments": arguments} | result)
    for name, runs in scenes.items():
        compare(options.out, name, runs)
        file = options.out / (name.replace(", ", "-").replace(" ", "-") + ".json")
        file.write_text(json.dumps({"scene": name, "runs": runs}, indent=1))
    failed = [f"{name}, {r['axis']} {r['value']}: {r['error']}" for name, runs in scenes.items() for r in runs if not r["done"]]
    print("\n".join(failed), end="\n" if failed else "")


if __name__ == "__main__":
    main()
