"""onset_bench_server from Python: frames, and calls that are timed where they run."""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile

import numpy as np


class Onset:
    """The server: one process a scene, so that memory is as warm as in a simulator."""

    def __init__(self, binary, a, b):
        self.process = subprocess.Popen([binary, a, b], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        line = self.process.stdout.readline()
        if not line:
            sys.exit("the server ended")
        return json.loads(line)

    def dumped(self, what):
        with tempfile.NamedTemporaryFile() as file:
            self.ask(what, file.name)
            return open(file.name, "rb").read()

    def frames(self):
        """Positions at both ends, edges, faces."""
        raw = self.dumped("dump")
        v, e, f = np.frombuffer(raw, np.int64, 3)
        x = np.frombuffer(raw, np.float64, 6 * v, 24).reshape(2, v, 3)
        ids = np.frombuffer(raw, np.int32, 2 * e + 3 * f, 24 + 48 * v)
        return x[0], x[1], ids[: 2 * e].reshape(e, 2), ids[2 * e :].reshape(f, 3)

    def pairs(self):
        """Vertex-face and edge-edge pairs whose swept boxes overlap."""
        raw = self.dumped("dump-pairs")
        vf, ee = np.frombuffer(raw, np.int64, 2)
        ids = np.frombuffer(raw, np.int32, 2 * (vf + ee), 16).reshape(-1, 2)
        return ids[:vf], ids[vf:]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def timed(call, clock):
    start = clock()
    result = call()
    return clock() - start, result


def spread(values, unit=1, digits=1):
    median, least, most = (f"{unit * x:.{digits}f}" for x in (statistics.median(values), min(values), max(values)))
    return f"{median} [{least}, {most}]"


def scene_parser(description):
    """Of a command line with scenes, as scene_frames takes them, and the server's binary."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="NAME=A,B")
    parser.add_argument("--server", required=True)
    return parser


def scene_frames(scenes):
    """{NAME: (A, B)} of arguments NAME=A,B."""
    named = (scene.partition("=") for scene in scenes)
    return {name: tuple(frames.split(",", 1)) for name, _, frames in named}
