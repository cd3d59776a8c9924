"""The pieces that the results of the commands share, as JSON, CSV and words: those of the native command line (docs/command-line.md)."""

import math

import onset_ccd

KINDS = {onset_ccd.PairKind.vertex_face: "vf", onset_ccd.PairKind.edge_edge: "ee", onset_ccd.PairKind.vertex_edge: "ve",
         onset_ccd.PairKind.vertex_plane: "vp"}
VF, EE, VE, VP = (onset_ccd.PairKind[name] for name in ("vertex_face", "edge_edge", "vertex_edge", "vertex_plane"))


def outcome_name(outcome):
    return "budget" if outcome.name == "max_checks" else outcome.name


def time_json(time):
    return time if math.isfinite(time) else None


def finite(value):
    """The same without what JSON has no word for."""
    if isinstance(value, dict):
        return {key: finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def counts_json(counts):
    json = {"vf": counts.vertex_face, "ee": counts.edge_edge}
    if counts.vertex_edge > 0:
        json["ve"] = counts.vertex_edge
    if counts.vertex_plane > 0:
        json["vp"] = counts.vertex_plane
    return json


def first_id(scene, pair):
    """`a` of a pair, which is a vertex of the file or an edge."""
    return int(pair.a) if pair.kind == EE else scene.vertex(pair.a)


def pair_json(scene, pair):
    if pair is None:
        return None
    return {"kind": KINDS[pair.kind], "a": first_id(scene, pair), "b": int(pair.b), "vertices": scene.ids(pair.vertices)}


def filter_json(counts):
    def of_kind(p):
        return {"needed": p.may_meet() > 0, "pairs": p.pairs, "may_meet": p.may_meet(),
                "left_out": {"masked": p.masked, "static": p.both_static, "same_body": p.same_body, "adjacent": p.adjacent,
                             "excluded": p.excluded, "within_rings": p.within_rings}}

    def of_primitive(p):
        return {"moving": p.moving, "static": p.statics, "dropped": p.dropped}

    json = {"vf": of_kind(counts.vertex_face), "ee": of_kind(counts.edge_edge), "vertices": of_primitive(counts.vertices),
            "edges": of_primitive(counts.edges), "faces": of_primitive(counts.faces)}
    if counts.vertex_edge.pairs > 0:
        json["ve"] = of_kind(counts.vertex_edge)
    return json


def stats_json(scene, s):
    return {"swept": counts_json(s.swept), "candidates": counts_json(s.candidates), "contacts": counts_json(s.contacts),
            "after_culls": counts_json(s.after_culls), "inclusion": counts_json(s.inclusion), "budget": counts_json(s.gave_up),
            "checks": s.checks, "max_checks_of_a_pair": s.max_checks_of_a_pair, "checks_histogram": list(s.checks_histogram),
            "worst": pair_json(scene, s.worst), "looked_at": s.looked_at, "seconds_contacts": s.seconds_contacts,
            "achieved_tolerance": s.achieved_tolerance, "extent": s.extent, "error_bound": list(s.error_bound),
            "plan": filter_json(s.filter_counts), "made_fixed_boxes": s.made_static_boxes, "threads": s.threads,
            "kernel": s.instruction_set, "broad_phase": s.broad_phase}


def seconds_json(s):
    return {"broad": s.seconds_broad, "narrow": s.seconds_narrow, "total": s.seconds_total}


def certainty_json(certainty, toi_hi):
    return {"certainty": certainty.name, "toi_hi": time_json(toi_hi)}


def step_json(scene, r):
    json = {"outcome": outcome_name(r.outcome), "step": r.step, "limiting": pair_json(scene, r.limiting),
            "candidates": counts_json(r.stats.candidates), "seconds": seconds_json(r.stats), "tolerance": r.stats.tolerance,
            "toi": time_json(r.toi), "rounding": r.rounding, "shortest": r.shortest}
    if r.limiting is not None:
        json["limiting"].update(certainty_json(r.certainty, r.toi_hi))
    if r.vertex >= 0:
        json["vertex"] = scene.vertex(r.vertex)
    json["stats"] = stats_json(scene, r.stats)
    return json


def active_set_json(scene, found):
    first = found.earliest()
    pair = None
    if first is not None:
        pair = {**pair_json(scene, first), "toi": first.toi, "status": outcome_name(first.outcome),
                **certainty_json(first.certainty, first.toi_hi)}
    json = {"contacts": counts_json(found.stats.contacts), "earliest": None if first is None else first.toi,
            "candidates": counts_json(found.stats.candidates), "seconds": seconds_json(found.stats), "earliest_pair": pair,
            "outcome": outcome_name(found.outcome), "tolerance": found.stats.tolerance}
    if found.vertex >= 0:
        json["vertex"] = scene.vertex(found.vertex)
    json["complete_until"] = time_json(found.complete_until)
    json["stats"] = stats_json(scene, found.stats)
    return json


def describe_edge(edge, v, w):
    """A point is an edge whose two vertices are the same."""
    return f"point {v} (edge {edge})" if v == w else f"edge {edge} (vertices {v} {w})"


def describe_pair(scene, pair):
    v = scene.ids(pair.vertices)
    if pair.kind == VF:
        return f"vertex {v[0]} and face {pair.b} (vertices {v[1]} {v[2]} {v[3]})"
    if pair.kind == VE:
        return f"vertex {v[0]} and {describe_edge(pair.b, v[1], v[2])}"
    if pair.kind == VP:
        return f"vertex {v[0]} and plane {pair.b}"
    return f"{describe_edge(pair.a, v[0], v[1])} and {describe_edge(pair.b, v[2], v[3])}"


def describe_counts(c):
    text = f"{c.vertex_face} vertex-face, {c.edge_edge} edge-edge" if c.vertex_edge == 0 else f"{c.vertex_edge} vertex-edge"
    return text + (f", {c.vertex_plane} vertex-plane" if c.vertex_plane > 0 else "")


def describe_touch(r):
    """Where the call ended before all pairs were looked at, any of them may touch at any time."""
    if r.outcome.name in ("non_finite", "out_of_range", "out_of_time", "out_of_memory", "out_of_checks", "cancelled"):
        return "touches     not known\n"
    return f"touches     t = {r.toi:.17g}, on the exact motion\n" if math.isfinite(r.toi) else "touches     never\n"


def describe_step(scene, r):
    text = f"outcome     {outcome_name(r.outcome)}\nstep        {r.step:.17g}\n"
    text += f"limited by  {'none' if r.limiting is None else describe_pair(scene, r.limiting)}\n"
    if r.vertex >= 0:
        text += f"vertex      {scene.vertex(r.vertex)}\n"
    return text + describe_touch(r) + f"rounding    {r.rounding:.3g}, what storing the end of the step may change\n"


def describe_active_set(scene, found):
    text = f"outcome     {outcome_name(found.outcome)}\ncontacts    {describe_counts(found.stats.contacts)}\n"
    if found.vertex >= 0:
        text += f"vertex      {scene.vertex(found.vertex)}\n"
    first = found.earliest()
    return text + ("" if first is None else f"earliest    t = {first.toi:.17g}, {describe_pair(scene, first)}\n")


def describe_sizes(scene):
    mesh, points = scene.mesh, scene.mesh.num_points
    text = f"mesh        {mesh.num_vertices} vertices, {mesh.num_edges - points} edges, {mesh.num_faces} faces"
    return text + (f", {points} points (edges of length 0 behind all others)" if points else "") + "\n"


def describe_stats(s):
    return (f"candidates  {describe_counts(s.candidates)}\ntolerance   {s.tolerance:.3g}\n"
            f"seconds     {s.seconds_total:.3g} (broad {s.seconds_broad:.3g}, narrow {s.seconds_narrow:.3g})\n")


def step_csv(scene, r, columns):
    pair = r.limiting
    fields = [""] * 7 if pair is None else [KINDS[pair.kind], first_id(scene, pair), int(pair.b), *scene.ids(pair.vertices)]
    numbers = [f"{value:.17g}" for value in (r.toi, r.toi_hi, r.rounding)]
    return f"{columns}\n" + ",".join(str(field) for field in [outcome_name(r.outcome), f"{r.step:.17g}", *fields, *numbers]) + "\n"


def active_set_csv(scene, found, columns):
    rows = [columns]
    for i in range(len(found)):
        c = found[i]
        head = [KINDS[c.kind], first_id(scene, c), c.b, f"{c.toi:.17g}", *scene.ids(c.vertices), outcome_name(c.outcome), c.certainty.name]
        numbers = [c.toi_hi, *c.weights, *c.normal, c.gap, c.speed]
        rows.append(",".join([*map(str, head), *(f"{value:.17g}" for value in numbers), str(int(c.degenerate)), f"{c.step_limit:.17g}"]))
    return "\n".join(rows) + "\n"
