#!/usr/bin/env python3
"""A step far too long, as Newton's method may propose one: time and memory of our calls, and of ipctk's broad phases alone.

    huge_step.py --onset onset --server onset_bench_server NAME=A,B ... [--factor 10] [--limit SECONDS] [--memory GIB]

The displacements from A to B are multiplied so that the largest is FACTOR times the longest side of the scene's box; nearly
everything then meets everything. Our active set and step, which list no candidates, stand beside the time that each of ipctk's
broad phases takes to list its own; one that exceeds the limits is ended. One thread, CPU time. Prints Markdown.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from onset_server import Onset, scene_frames

BROAD_PHASES = ["LBVH", "HashGrid", "SpatialHash", "SweepAndPrune"]
TOO_LONG, TOO_LARGE = "too long", "too large"


def lengthened(x_t0, x_t1, factor):
    displacement = x_t1 - x_t0
    size = np.ptp(x_t0, axis=0).max()
    return x_t0 + displacement * (factor * size / np.linalg.norm(displacement, axis=1).max())


def write_ply(path, x, faces):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(x)}\nproperty double x\nproperty double y\n"
              f"property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = np.empty(len(faces), [("corners", "u1"), ("ids", "<i4", 3)])
    rows["corners"], rows["ids"] = 3, faces
    path.write_bytes(header.encode() + x.astype("<f8").tobytes() + rows.tobytes())


# ---- ipctk, in a process of its own

def status_bytes(name):
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(f"{name}:"):
            return 1024 * int(line.split()[1])
    raise KeyError(name)


def list_candidates(frames, broad_phase, limit, memory):
    """What the process prints: its CPU seconds, peak bytes and number of candidates."""
    import ipctk

    ipctk.set_num_threads(1)
    arrays = np.load(frames)
    x = [np.asfortranarray(arrays[name]) for name in ("x_t0", "x_t1")]
    mesh = ipctk.CollisionMesh(x[0], arrays["edges"], arrays["faces"])
    before = status_bytes("VmRSS")
    resource.setrlimit(resource.RLIMIT_DATA, (before + memory,) * 2)
    resource.setrlimit(resource.RLIMIT_CPU, (int(time.process_time() + limit + 1),) * 2)
    candidates = ipctk.Candidates()
    start = time.process_time()
    candidates.build(mesh, *x, 0.0, getattr(ipctk, broad_phase)())
    seconds = time.process_time() - start
    print(json.dumps({"cpu": seconds, "peak": status_bytes("VmHWM") - before, "pairs": len(candidates)}))


def ask_peer(frames, broad_phase, limit, memory):
    """What list_candidates prints, or None and why it did not get so far."""
    command = [sys.executable, __file__, "--child", broad_phase, "--limit", str(limit), "--memory", str(memory), str(frames)]
    start = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    if done.returncode == 0:
        return json.loads(done.stdout), None
    used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start.ru_utime
    return None, TOO_LONG if used >= limit else TOO_LARGE


# ---- the table

def mebibytes(x):
    return "-" if x is None else f"{x / 2**20:.1f}"


def our_rows(binary, frames):
    """frames: {what: (A, B)}, the long step last: once, as that of the peers is."""
    for repeats, (what, (a, b)) in zip((5, 0), frames.items()):
        command = [binary, "bench", a, b, "--threads", "1", "--repeats", str(repeats), "--json", "-"]
        [scene] = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["scenes"]
        stats = scene["stats"]
        swept, contacts = (sum(stats[key].values()) for key in ("swept", "contacts"))
        for call, name in (("active_set", f"active set, {contacts} contacts"), ("step", f"step, {scene['step_size']:.3g}")):
            cost = scene[call]
            yield [what, f"onset, {name}", f"{1e3 * cost['cpu']['median']:.4g}", mebibytes(cost["peak_bytes"]), swept]


def peer_rows(frames, limit, memory):
    for what, path in frames.items():
        for broad_phase in BROAD_PHASES:
            found, why = ask_peer(path, broad_phase, limit, memory)
            cells = {TOO_LONG: [f"> {1e3 * limit:g}", "-"], TOO_LARGE: ["-", f"> {mebibytes(memory)}"]}.get(why)
            cells = cells or [f"{1e3 * found['cpu']:.4g}", mebibytes(found["peak"])]
            yield [what, f"ipctk, candidates, {broad_phase}", *cells, found["pairs"] if found else "-"]


def compare(name, scene, options, folder):
    onset = Onset(options.server, *scene)
    x_t0, x_t1, edges, faces = onset.frames()
    onset.close()
    ours, theirs = {}, {}
    for what, end in (("as recorded", x_t1), (f"{options.factor:g} times the scene", lengthened(x_t0, x_t1, options.factor))):
        stem = folder / f"{len(ours)}"
        ours[what] = stem.with_suffix(".a.ply"), stem.with_suffix(".b.ply")
        for path, x in zip(ours[what], (x_t0, end)):
            write_ply(path, x, faces)
        theirs[what] = stem.with_suffix(".npz")
        np.savez(theirs[what], x_t0=x_t0, x_t1=end, edges=edges, faces=faces)
    for rows in (our_rows(options.onset, ours), peer_rows(theirs, options.limit, int(options.memory * 2**30))):
        for row in rows:
            print("| " + " | ".join(map(str, [name, *row])) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=A,B")
    parser.add_argument("--onset")
    parser.add_argument("--server")
    parser.add_argument("--factor", type=float, default=10)
    parser.add_argument("--limit", type=float, default=30, help="CPU seconds")
    parser.add_argument("--memory", type=float, default=10, help="GiB, in bytes for --child")
    parser.add_argument("--child", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        return list_candidates(options.scenes[0], options.child, options.limit, int(options.memory))
    print("| scene | displacement | call | CPU ms | peak MiB | swept pairs |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, scene in scene_frames(options.scenes).items():
            compare(name, scene, options, Path(folder))


if __name__ == "__main__":
    main()
