"""What settings cost and give: the function, its Pareto front, and the command."""

import math

import numpy as np
import pytest

import onset_ccd
from onset_ccd import trade
from running import fails, result, run, triangles, two_sheets, write_obj


@pytest.fixture(scope="module")
def scene():
    """Seen from the side, so that boxes overlap and tolerances matter."""
    x, end, quads = two_sheets()
    end[25:, 2] = 0.3 * np.sin(5 * end[25:, 0])
    end[25:, :2] = 0.5 + 0.9 * (end[25:, [1, 0]] - 0.5) * [-1, 1]
    turn = np.linalg.qr(np.array([[1.0, 2, 3], [2, -1, 1], [1, 1, -2]]))[0]
    x, end = x @ turn, end @ turn
    return onset_ccd.Mesh(x, triangles(quads)), x, end


def test_rows(scene):
    mesh, x, end = scene
    rows = trade.trade(mesh, x, end, repeats=2, seconds=0.05, threads=1)
    assert rows[0].axis == "base" and rows[0].options == {"threads": 1}
    assert {row.axis for row in rows} == {"base", *trade.AXES}
    truth = onset_ccd.construct_active_set(mesh, x, end, exactness="exact")
    for row in rows:
        assert len(row.times) in (1, 2) and row.spread[0] <= row.median <= row.spread[1] and row.spread[0] > 0
        found = onset_ccd.construct_active_set(mesh, x, end, **row.options)
        assert (row.contacts, row.checks) == (len(found), found.stats.checks)
        assert row.step == onset_ccd.compute_collision_free_stepsize(mesh, x, end, **row.options).step
        assert row.false_negatives == 0 and row.late == 0
        if row.options.get("min_separation", 0) == 0:
            assert row.false_positives == len(found) - len(truth)
        else:
            assert row.false_positives is None and not row.same_question and not row.on_front
    coarse = [row for row in rows if row.axis == "narrow-phase"]
    assert coarse[0].early_mean > coarse[-1].early_mean
    assert any(row.false_positives for row in rows if row.value == "1"), "one check a pair cannot tell them all apart"


def row(us, contacts=5, early=0.0, checks=0, **more):
    return trade.Row("axis", "value", {}, times=[u / 1e6 for u in us], contacts=contacts, false_positives=contacts - 5, early_mean=early,
                     checks=checks, **more)


def test_front():
    fast_and_wrong, exact, slow = row([1, 1, 1], 9, checks=1), row([2, 2, 2], checks=2), row([3, 3, 3], checks=3)
    assert trade.pareto_front([slow, exact, fast_and_wrong]) == [fast_and_wrong, exact]
    assert trade.pareto_front([exact, row([1, 1, 1], checks=9, same_question=False)]) == [exact]
    assert trade.pareto_front([exact, row([1, 1, 1], checks=9, incomplete="out_of_time")]) == [exact]
    early = row([1, 1, 1], early=0.1, checks=4)
    assert trade.pareto_front([exact, early]) == [early, exact]
    alike = row([2.1, 1.9, 2], checks=5)
    assert trade.pareto_front([exact, alike]) == [exact], "of those that nothing tells apart the first"


def test_a_budget_is_said(scene):
    mesh, x, end = scene
    base = trade.trade(mesh, x, end, axes=[], repeats=1, check_limit=1)[0]
    assert base.incomplete == "out_of_checks" and base.complete_until == 0 and base.false_negatives == 0
    assert base.step == 0 and not base.on_front


def test_bad_arguments(scene):
    with pytest.raises(ValueError, match="axis 'colour' is none of tolerance, max-checks"):
        trade.trade(*scene, axes=["colour"])
    with pytest.raises(ValueError, match="repeats is 0; it must be at least 1"):
        trade.trade(*scene, repeats=0)
    with pytest.raises(ValueError, match="tolerance is -1"):
        trade.trade(*scene, tolerance=-1)


def test_the_command(tmp_path):
    x, end, quads = two_sheets()
    write_obj(tmp_path / "a.obj", x, quads)
    write_obj(tmp_path / "b.obj", end, quads)
    words = ["trade", "a.obj", "b.obj", "--axis", "certainty,threads", "--repeats", "2", "--seconds", "0.1", "--certainty", "conservative"]
    done = run(*words, "--csv", "t.csv", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "Pareto front, fastest first" in done.stdout and "False negatives in all settings together: 0" in done.stdout
    assert done.stdout.count("\n* ") == done.stdout.split("fastest first\n")[1].count(" us, ")
    lines = (tmp_path / "t.csv").read_text().splitlines()
    assert lines[0].startswith("axis,value,us,us_min,us_max,cpu_us,asked,positives,false_positives,")
    json = result(*words, cwd=tmp_path)
    assert [row["axis"] for row in json["settings"]][:3] == ["base", "certainty", "certainty"] and len(lines) == 1 + len(json["settings"])
    base = json["settings"][0]
    assert base["numbers"]["certainty"] == "conservative" and base["options"] == "exactness='conservative'"
    assert base["positives"] > 0 and base["false_positives"] is not None and math.isclose(base["step"], 0.5, rel_tol=1e-9)
    assert "'colour' is none of" in fails("trade", "a.obj", "b.obj", "--axis", "colour", code=2, cwd=tmp_path)
