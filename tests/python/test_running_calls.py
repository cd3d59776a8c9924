"""The lock is released, callbacks cancel, signals and exceptions leave a call, and meshes may change meanwhile."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import bits, grid

import onset_ccd


@pytest.fixture(scope="module")
def slow():
    """All in one place: every pair is a candidate."""
    random = np.random.default_rng(3)
    x, faces = grid(60)
    return onset_ccd.Mesh(x, faces), random.uniform(-1, 1, x.shape), random.uniform(-1, 1, x.shape)


def test_other_threads_run_meanwhile(slow):
    mesh, x_t0, x_t1 = slow
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    started = time.perf_counter()
    onset_ccd.construct_active_set(mesh, x_t0, x_t1, time_limit=0.5, threads=1)
    ended = time.perf_counter()
    done.set()
    thread.join()
    during = [t for t in ticks if started < t < ended]
    assert ended - started > 0.1 and len(during) > 10


def test_many_threads_on_one_mesh_whose_rules_change(crumpled):
    mesh = onset_ccd.Mesh(crumpled.x_t0, crumpled.faces)
    expected = bits(onset_ccd.construct_active_set(mesh, crumpled.x_t0, crumpled.x_t1).contacts)
    thin = onset_ccd.CollisionRules()
    thick = onset_ccd.CollisionRules(thickness=np.full(len(crumpled.x_t0), 0.01))
    mesh.rules = thick
    other = bits(onset_ccd.construct_active_set(mesh, crumpled.x_t0, crumpled.x_t1).contacts)
    found, done = [], threading.Event()

    def call():
        while not done.is_set():
            found.append(bits(onset_ccd.construct_active_set(mesh, crumpled.x_t0, crumpled.x_t1, threads=1).contacts))

    threads = [threading.Thread(target=call) for _ in range(4)]
    for thread in threads:
        thread.start()
    for _ in range(200):
        mesh.rules = thin
        mesh.rules = thick
        time.sleep(0.002)
    done.set()
    for thread in threads:
        thread.join()
    assert expected != other and len(found) > 10 and set(found) <= {expected, other}


def test_progress_is_told_and_cancels(slow):
    mesh, x_t0, x_t1 = slow
    shares = []
    r = onset_ccd.construct_active_set(mesh, x_t0, x_t1, progress=lambda share: shares.append(share) or len(shares) < 5)
    assert r.outcome == onset_ccd.Outcome.cancelled and shares[0] == 0 and len(shares) == 5 and max(shares) <= 1
    r = onset_ccd.construct_active_set(mesh, x_t0, x_t1, progress=lambda share: np.float64(share) < 1e-9)
    assert r.outcome == onset_ccd.Outcome.cancelled
    shares.clear()
    r = onset_ccd.compute_collision_free_stepsize(mesh, x_t0, x_t1, progress=shares.append, time_limit=1)
    assert r.outcome != onset_ccd.Outcome.cancelled and len(shares) > 1


@pytest.mark.parametrize("threads", [1, 2])
def test_what_progress_raises_leaves_the_call(slow, threads):
    mesh, x_t0, x_t1 = slow

    def progress(share):
        if share > 0:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        onset_ccd.construct_active_set(mesh, x_t0, x_t1, progress=progress, threads=threads)


def test_a_call_inside_progress(slow, falling):
    mesh, x_t0, x_t1 = slow
    small = onset_ccd.Mesh(falling.x_t0, falling.faces)
    steps = []

    def progress(share):
        steps.append(onset_ccd.compute_collision_free_stepsize(small, falling.x_t0, falling.x_t1).step)
        return len(steps) < 4

    onset_ccd.construct_active_set(mesh, x_t0, x_t1, progress=progress)
    assert len(steps) == 4 and len(set(steps)) == 1


ENDING = """
import threading, time
import numpy as np, onset_ccd
x = np.random.default_rng(1).uniform(-1, 1, (6000, 3))
mesh = onset_ccd.Mesh(6000, np.arange(6000).reshape(-1, 3))

class Still(onset_ccd.Trajectory):
    def num_vertices(self): return 6000
    def body(self, vertex): return self.kFree
    def positions(self, t, vertices): return x[vertices]
    def straying(self, t0, t1, vertices): return np.full(len(vertices), 1e-3)

def work():
    while True:
        CALL
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
print("ends", flush=True)
"""


@pytest.mark.parametrize("call", [
    "onset_ccd.construct_active_set(mesh, x, -x, time_limit=0.5, progress=lambda share: True)",
    "onset_ccd.visit_candidates(mesh, x, x, lambda kind, pairs: None)",
    "onset_ccd.compute_collision_free_stepsize(mesh, Still(), time_limit=0.5)",
])
def test_the_interpreter_ends_while_calls_run(call):
    done = subprocess.run([sys.executable, "-c", ENDING.replace("CALL", call)], capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.returncode) == ("ends\n", 0), done.stderr


INTERRUPTED = """
import numpy as np, onset_ccd, sys, time
n = 300
x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
faces = np.vstack([np.column_stack([a, a + n, a + 1]), np.column_stack([a + 1, a + n, a + n + 1])])
random = np.random.default_rng(1)
mesh = onset_ccd.Mesh(n * n, faces)
x_t0, x_t1 = random.uniform(-1, 1, (n * n, 3)), random.uniform(-1, 1, (n * n, 3))
print("ready", flush=True)
try:
    CALL
    print("not interrupted")
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("call", [
    "onset_ccd.construct_active_set(mesh, x_t0, x_t1, threads=1)",
    "onset_ccd.compute_candidates(mesh, x_t0, x_t1, threads=0)",
    "onset_ccd.check(mesh, x_t0, threads=2, progress=lambda share: True)",
    "onset_ccd.LineSearch(mesh, x_t0, x_t1 - x_t0, d_hat=1.0)",
])
def test_ctrl_c_ends_a_call(call):
    process = subprocess.Popen([sys.executable, "-c", INTERRUPTED.replace("CALL", call)], stdout=subprocess.PIPE, text=True, env=os.environ)
    try:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert out == "interrupted\n" and process.returncode == 0
