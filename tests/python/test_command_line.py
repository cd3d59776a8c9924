"""python -m onset_ccd answers as the native program does: its JSON, its CSV, its exit codes."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from running import fails, native, result, run, two_sheets, without_times, write_obj


@pytest.fixture
def frames(tmp_path):
    """Quads, a wire and a point, which fall through a sheet; `touch.obj` is where the sheets meet."""
    x, end, quads = two_sheets()
    more = np.array([[0.5, 0.5, 0.8], [0.6, 0.6, 0.8], [0.3, 0.3, 1.0]])
    write_obj(tmp_path / "a.obj", np.vstack([x, more]), quads, "l 42 43\np 44\n")
    write_obj(tmp_path / "b.obj", np.vstack([end, more - [0, 0, 1.4]]), quads, "l 42 43\np 44\n")
    write_obj(tmp_path / "touch.obj", (x + end) / 2, quads)
    write_obj(tmp_path / "copies.obj", np.vstack([x, x[25:30]]), quads)
    return tmp_path


WORDS = [
    ["step", "a.obj", "b.obj"],
    ["step", "a.obj", "a.obj"],
    ["step", "touch.obj", "touch.obj"],
    ["step", "a.obj", "b.obj", "--time-limit", "0"],
    ["active-set", "a.obj", "b.obj"],
    ["active-set", "a.obj", "b.obj", "--bodies", "components", "--static-body", "0", "--min-separation", "1e-3", "--norm", "maximum",
     "--plane", "0,0,1,-0.2", "--rings", "1", "--certainty", "exact", "--window", "0.1"],
    ["active-set", "a.obj", "b.obj", "--bodies", "components", "--body-separation", "0,1,0.02", "--rigid-body", "1", "--rest", "a.obj",
     "--rest-share", "0.25", "--kernel", "scalar", "--broad-phase", "hash", "--tolerance", "1e-4", "--max-checks", "7"],
    ["active-set", "a.obj", "b.obj", "--rigid"],
    ["active-set", "line.obj", "line_end.obj", "--dim", "2"],
    ["check", "a.obj"],
    ["check", "touch.obj"],
    ["check", "touch.obj", "--plane", "0,0,1,0"],
    ["check", "copies.obj"],
    ["check", "copies.obj", "copies.obj"],
    ["check", "copies.obj", "copies.obj", "--weld"],
    ["check", "a.obj", "--min-separation", "0.6"],
]


@pytest.mark.parametrize("words", WORDS, ids=" ".join)
def test_as_the_native_program(frames, words):
    (frames / "line.obj").write_text("v 0 0\nv 1 0\nv 2 0.25\nv 0.5 1\nv 1.5 1\nl 1 2 3\nl 4 5\n")
    (frames / "line_end.obj").write_text("v 0 0\nv 1 0\nv 2 0.25\nv 0.5 -1\nv 1.5 -1\nl 1 2 3\nl 4 5\n")
    theirs = subprocess.run([native(), *words, "--json", "n.json", "--csv", "n.csv"], cwd=frames, capture_output=True, text=True)
    ours = run(*words, "--json", "p.json", "--csv", "p.csv", cwd=frames)
    assert ours.returncode == theirs.returncode, ours.stderr + theirs.stderr
    assert (frames / "p.csv").read_text() == (frames / "n.csv").read_text()
    p, n = (json.loads((frames / name).read_text()) for name in ("p.json", "n.json"))
    assert without_times(p) == without_times(n)
    assert list(p) == list(n)

    def summary(text):
        return [line for line in without_times(text).splitlines() if not line.startswith("seconds")]

    assert summary(ours.stdout) == summary(theirs.stdout)


FAULTS = [
    (["step", "a.obj", "none.obj"], 1, "none.obj: No such file or directory"),
    (["step", "a.obj", "touch.obj"], 1, "a.obj and touch.obj: different topology: 44 against 41 vertices"),
    (["step", "a.obj", "b.obj", "--static-body", "3"], 2, "--static-body 3: there are 1 bodies, numbered from 0 (see --bodies components)"),
    (["step", "a.obj", "b.obj", "--static-body", "0"], 1, "vertex 25 is static, but its positions at the two ends differ"),
    (["step", "a.obj", "b.obj", "--tolerance", "0"], 2, "--tolerance: a finite number > 0 expected, not '0'"),
    (["step", "a.obj", "b.obj", "--plane", "0,0,0,1"], 2, "four finite numbers nx,ny,nz,offset and a normal other than 0 expected, not '0,0,0,1'"),
    (["step", "a.obj", "b.obj", "--rest-share", "0.5"], 2, "--rest-share needs --rest"),
    (["step", "a.obj", "b.obj", "--dim", "2"], 1, "a.obj with --dim 2: there are 50 faces, and lines alone lie in the plane"),
    (["step", "a.obj", "b.obj", "--json", "a.obj"], 2, "--json: a.obj is the input a.obj, which would be overwritten"),
    (["step", "a.obj", "b.obj", "--json", "x", "--csv", "./x"], 2, "--json and --csv cannot both go to x"),
    (["step", "a.obj", "b.obj", "--json", "none/x"], 1, "none/x: cannot be written: No such file or directory"),
    (["step", "a.obj", "b.obj", "--screenshot", "x.jpg"], 2, "--screenshot x.jpg: a name that ends in .png expected"),
    (["step", "a.obj"], 2, "the following arguments are required: B"),
    ([], 2, "a command is required"),
    (["steps"], 2, "invalid choice: 'steps'"),
]


@pytest.mark.parametrize("words, code, says", FAULTS, ids=[" ".join(words) or "no command" for words, _, _ in FAULTS])
def test_one_line_and_a_code_for_what_is_wrong(frames, words, code, says):
    assert says in fails(*words, code=code, cwd=frames)
    assert not list(frames.glob("*unfinished*"))


@pytest.mark.parametrize("words, code, says", FAULTS, ids=[" ".join(words) or "no command" for words, _, _ in FAULTS])
def test_the_native_program_ends_with_the_same_code(frames, words, code, says):
    if "--screenshot" in words:
        pytest.skip("the native program draws no pictures")
    assert subprocess.run([native(), *words], cwd=frames, capture_output=True).returncode == (code if words != [] else 2)


def test_outcomes_are_no_errors(frames):
    """NaN and too large positions are what a running simulator may write."""
    text = (frames / "b.obj").read_text().splitlines()
    for value, outcome in (("nan", "non_finite"), ("inf", "non_finite"), ("1e308", "out_of_range")):
        (frames / "bad.obj").write_text("\n".join([*text[:7], f"v 0 {value} 0", *text[8:]]) + "\n")
        json = result("step", "a.obj", "bad.obj", cwd=frames)
        assert (json["outcome"], json["step"], json["vertex"]) == (outcome, 0, 7)
    assert result("check", "bad.obj", code=3, cwd=frames)["outcome"] == "out_of_range"


def test_a_value_may_be_negative(frames):
    assert result("step", "a.obj", "b.obj", "--plane", "-1,0,0,-0.9", cwd=frames)["outcome"] == "initial_contact"
    assert result("step", "a.obj", "b.obj", "--plane", "-1,0,0,-9", cwd=frames)["outcome"] == "contact"


def test_hexadecimal_numbers(frames):
    json = result("active-set", "a.obj", "b.obj", "--min-separation", "0x1p-10", cwd=frames)
    assert json == {**json, "contacts": result("active-set", "a.obj", "b.obj", "--min-separation", "0.0009765625", cwd=frames)["contacts"]}


def test_files_take_their_places_together(frames):
    """Those that cannot be written leave the others as they were."""
    (frames / "x.json").write_text("old")
    (frames / "x.json").chmod(0o640)
    assert "cannot be written" in fails("step", "a.obj", "b.obj", "--json", "x.json", "--csv", "none/x.csv", cwd=frames)
    assert (frames / "x.json").read_text() == "old"
    assert run("step", "a.obj", "b.obj", "--json", "x.json", "--csv", "x.csv", cwd=frames).returncode == 0
    assert json.loads((frames / "x.json").read_text())["outcome"] == "contact"
    assert (frames / "x.json").stat().st_mode & 0o777 == 0o640
    assert (frames / "x.csv").read_text().startswith("outcome,step,kind,a,b,")
    assert sorted(path.name for path in frames.glob("*unfinished*")) == []


def test_stdout_has_one_thing(frames):
    done = run("active-set", "a.obj", "b.obj", "--csv", "-", cwd=frames)
    assert done.stdout.startswith("kind,a,b,toi,")
    assert done.stderr.startswith("note        a.obj: triangulated 25 polygons")
    assert json.loads(run("step", "a.obj", "b.obj", "--json", "-", cwd=frames).stdout)["outcome"] == "contact"


def test_an_interrupt_leaves_no_files(frames):
    words = ["trade", "a.obj", "b.obj", "--repeats", "1000", "--seconds", "1000", "--json", "t.json"]
    program = "import onset_ccd.command_line.commands, onset_ccd.__main__ as m, sys; print('begins', flush=True); sys.exit(m.main())"
    running = subprocess.Popen([sys.executable, "-c", program, *words], cwd=frames, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert running.stdout.readline() == "begins\n"
    time.sleep(1)
    running.send_signal(signal.SIGINT)
    assert running.communicate(timeout=60)[1] == "onset_ccd: interrupted; nothing is written\n"
    assert running.returncode == 130
    assert not (frames / "t.json").exists() and not list(frames.glob("*unfinished*"))


def test_help_and_version():
    assert run("--version").stdout == "onset_ccd 0.1.0\n"
    for command in ("step", "active-set", "check", "trade"):
        assert "--relative-tolerance" in run(command, "--help").stdout
    assert "Exit status" in run("--help").stdout


def test_recorded_steps(tmp_path):
    """As the native program answers, on real frames; a step's counts of pairs that are dropped on the way may differ."""
    if "ONSET_DATA" not in os.environ:
        pytest.skip("ONSET_DATA, a folder with recorded steps, is not set")
    folders = sorted(pathlib.Path(os.environ["ONSET_DATA"], "scenes").glob("*/frames"))
    assert folders
    for folder in folders:
        frames = sorted(folder.glob("*.ply"))[:2]
        theirs = subprocess.run([native(), "active-set", *frames, "--json", "-", "--csv", tmp_path / "n"], capture_output=True, text=True)
        ours = run("active-set", *frames, "--json", "-", "--csv", tmp_path / "p")
        assert ours.returncode == theirs.returncode, ours.stderr + theirs.stderr
        assert without_times(json.loads(ours.stdout)) == without_times(json.loads(theirs.stdout)), folder
        assert (tmp_path / "p").read_text() == (tmp_path / "n").read_text()
