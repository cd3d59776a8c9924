"""What check() finds, in words, JSON and CSV."""

from dataclasses import dataclass

import numpy as np

import onset_ccd

from .report import KINDS, VP, describe_edge, describe_pair, first_id, outcome_name, pair_json

SHOWN = 10
INTERSECTION_KINDS = {int(kind): kind.name for kind in onset_ccd.IntersectionKind}

# What the command line has for it; the library's text ends with calls.
FLAGS = {
    "intersecting": "no option leaves them out: move them apart",
    "touching": "--touching-may-pass-through, where they touch from the right side",
    "within_separation": "--min-separation, a smaller one",
    "copied_vertices": "--weld, where they are the copies of a seam",
    "faces_without_area": "no option leaves them out: they are taken for the segments that they are",
    "unused_vertices": "lines 'p' of an OBJ file declare points, else they meet faces only",
}


@dataclass
class Copies:
    """Copies of vertices, by whether they are still together at the end of a step."""

    together: list
    parting: list


def at_the_end(copies, x_t1):
    copies = np.asarray(copies).reshape(-1, 2)
    same = (x_t1[copies[:, 0]] == x_t1[copies[:, 1]]).all(axis=1)
    return Copies(copies[same].tolist(), copies[~same].tolist())


@dataclass
class PairRow:
    """A row of a list of pairs, as the calls have a pair."""

    kind: onset_ccd.PairKind
    a: int
    b: int
    vertices: list


def pair_of(row):
    return PairRow(onset_ccd.PairKind(int(row["kind"])), int(row["a"]), int(row["b"]), row["vertices"].tolist())


@dataclass
class Findings:
    scene: object
    report: onset_ccd.StartReport
    copies: "Copies | None" = None  # where the end of a step is known

    def lists(self):
        """By fault, in the order of StartFault."""
        r = self.report
        return {"intersecting": r.intersections, "touching": r.touching, "within_separation": r.within_separation,
                "copied_vertices": r.copied_vertices, "faces_without_area": r.faces_without_area, "unused_vertices": r.unused_vertices}

    def face(self, face):
        return self.scene.ids(self.scene.mesh.faces[face].tolist())


def cure(report, fault):
    """Copies make whole neighbourhoods touch."""
    by_copies = len(report.copied_vertices) and fault in ("intersecting", "touching")
    return FLAGS[fault] + ("; copied vertices make many of these: --weld, where they are the copies of a seam" if by_copies else "")


def intersection_in_words(f, row):
    verb = {"crossing": "goes through", "touching": "touches", "overlapping": "overlaps"}[INTERSECTION_KINDS[int(row["kind"])]]
    v = f.scene.ids(row["vertices"])
    edge = describe_edge(row["edge"], v[0], v[1])
    if v[3] == v[4]:  # two edges in the plane
        return f"{edge} {verb} {describe_edge(row['face'], v[2], v[3])}"
    return f"{edge} {verb} face {row['face']} (vertices {v[2]} {v[3]} {v[4]})"


def copy_in_words(f, copy):
    text = "vertices {} and {} are at one place".format(*f.scene.ids(copy))
    if f.copies is None:
        return text
    return text + (", not at the end of the step" if list(copy) in f.copies.parting else " at both ends of the step")


IN_WORDS = {
    "intersecting": intersection_in_words,
    "touching": lambda f, row: describe_pair(f.scene, pair_of(row)),
    "within_separation": lambda f, row: f"{describe_pair(f.scene, pair_of(row))}: {row['distance']:.6g} apart, {row['separation']:.6g} to be kept",
    "copied_vertices": copy_in_words,
    "faces_without_area": lambda f, face: "face {} (vertices {} {} {})".format(face, *f.face(face)),
    "unused_vertices": lambda f, v: f"vertex {f.scene.vertex(v)}",
}


def describe_list(f, fault):
    rows = f.lists()[fault]
    text = "".join(f"  {IN_WORDS[fault](f, row)}\n" for row in rows[:SHOWN])
    text += f"  ... {len(rows) - SHOWN} more\n" if len(rows) > SHOWN else ""
    if fault == "copied_vertices" and f.copies:
        text += (f"  {len(f.copies.together)} stay together to the end of the step, which --weld makes one, "
                 f"{len(f.copies.parting)} part\n")
    return text


def describe(f):
    """Of each kind the first ten."""
    r = f.report
    if r.outcome != onset_ccd.Outcome.free:
        text = f"start       not known: {outcome_name(r.outcome)}\n"
    elif r.clean():
        text = "start       clean\n"
    else:
        text = "start       " + ("a step may start here, with what follows in mind\n" if r.acceptable() else "a step cannot start here\n")
    if r.vertex >= 0:
        text += f"vertex      {f.scene.vertex(r.vertex)}\n"
    for finding in r.findings:
        fault = finding.fault.name
        text += f"\n{finding.text.split(': ')[0]}\n{describe_list(f, fault)}  on the command line: {cure(r, fault)}\n"
    return text + f"\nseconds     {r.seconds:.3g}\n"


def intersection_json(f, row):
    return {"edge": int(row["edge"]), "face": int(row["face"]), "kind": INTERSECTION_KINDS[int(row["kind"])],
            "vertices": f.scene.ids(row["vertices"])}


def close_json(f, row):
    return {**pair_json(f.scene, pair_of(row)), "distance": float(row["distance"]), "separation": float(row["separation"])}


def to_json(f):
    r = f.report
    json = {"clean": r.clean(), "acceptable": r.acceptable(), "outcome": outcome_name(r.outcome)}
    if r.vertex >= 0:
        json["vertex"] = f.scene.vertex(r.vertex)
    json["findings"] = [{"fault": finding.fault.name, "count": finding.count, "text": finding.text,
                         "command_line": cure(r, finding.fault.name)} for finding in r.findings]
    json["intersecting"] = [intersection_json(f, row) for row in r.intersections]
    json["touching"] = [pair_json(f.scene, pair_of(row)) for row in r.touching]
    json["within_separation"] = [close_json(f, row) for row in r.within_separation]
    json["copied_vertices"] = [f.scene.ids(copy) for copy in r.copied_vertices]
    if f.copies:
        json["copies_that_stay_together"] = [f.scene.ids(copy) for copy in f.copies.together]
        json["copies_that_part"] = [f.scene.ids(copy) for copy in f.copies.parting]
    json["faces_without_area"] = [int(face) for face in r.faces_without_area]
    json["unused_vertices"] = f.scene.ids(r.unused_vertices)
    json["seconds"] = r.seconds
    return json


def five(ids):
    """The given ids, then empty fields up to five."""
    return [*map(str, ids), *[""] * (5 - len(ids))]


def pair_fields(f, fault, row):
    pair = pair_of(row)
    vertices = f.scene.ids(pair.vertices[: 1 if pair.kind == VP else 4])
    return [fault, KINDS[pair.kind], str(first_id(f.scene, pair)), str(pair.b), *five(vertices)]


def to_csv(f, columns):
    """One row each, empty where there is no such value."""
    r, rows = f.report, []
    for row in r.intersections:
        rows.append(["intersecting", INTERSECTION_KINDS[int(row["kind"])], str(row["edge"]), str(row["face"]),
                     *five(f.scene.ids(row["vertices"])), "", ""])
    for row in r.touching:
        rows.append([*pair_fields(f, "touching", row), "", ""])
    for row in r.within_separation:
        rows.append([*pair_fields(f, "within_separation", row), f"{row['distance']:.17g}", f"{row['separation']:.17g}"])
    for copy in r.copied_vertices:
        rows.append(["copied_vertices", "", "", "", *five(f.scene.ids(copy)), "", ""])
    for face in r.faces_without_area:
        rows.append(["faces_without_area", "", str(face), "", *five(f.face(face)), "", ""])
    for v in r.unused_vertices:
        rows.append(["unused_vertices", "", "", "", *five([f.scene.vertex(v)]), "", ""])
    return "\n".join([columns, *map(",".join, rows)]) + "\n"
