"""The real frames and queries of ONSET_DATA against their truth. Skipped, by name, without it."""

import json
import os
import pathlib
import sys
import time
import unittest

from support import AppTest

if "ONSET_DATA" not in os.environ:
    print("skipped: test_scenes needs ONSET_DATA, the folder of the real data")
    sys.exit(77)
DATA = pathlib.Path(os.environ["ONSET_DATA"])

# name: frames, prefix of the truth files, #V, #E, swept-box overlaps vf and ee
SCENES = {
    "cloth-ball": (("cloth_ball92", "cloth_ball93"), "92", 46598, 138825, 1655541, 5197332),
    "armadillo-rollers": (("326", "327"), "326", 12135, 36363, 2031902, 5068080),
    "cloth-funnel": (("227", "228"), "227", 9450, 27930, 7319, 33770),
}


def frames(name):
    return [DATA / "scenes" / name / "frames" / f"{frame}.ply" for frame in SCENES[name][0]]


def truth(name):
    """{kind: {(a, b): collides}} with ids within their kind: vertex and face, edge and edge."""
    _, prefix, vertices, edges, *_ = SCENES[name]
    folder = DATA / "scenes" / name
    result = {}
    for kind in ["vf", "ee"]:
        pairs = json.loads((folder / "boxes" / f"{prefix}{kind}.json").read_text())
        collides = json.loads((folder / "mma_bool" / f"{prefix}{kind}_mma_bool.json").read_text())
        assert len(pairs) == len(collides)
        first, second = (0, vertices + edges) if kind == "vf" else (vertices, vertices)
        ordered = [(min(p), max(p)) for p in pairs]
        result[kind] = {(a - first, b - second): hit for (a, b), hit in zip(ordered, collides)}
    return result


class Scenes(AppTest):
    def active_set(self, name):
        start = time.monotonic()
        text = self.csv("active-set", *frames(name), "--tolerance", "1e-6")
        print(f"{name}: active set in {time.monotonic() - start:.1f} s")
        return text

    def check_active_set(self, name):
        """No false negative, and no more positives than the pairs that the data list."""
        found = {"vf": set(), "ee": set()}
        for row in self.active_set(name).splitlines()[1:]:
            kind, a, b, *_ = row.split(",")
            found[kind].add((int(a), int(b)))
        for kind, listed in truth(name).items():
            missed = {pair for pair, collides in listed.items() if collides} - found[kind]
            self.assertEqual(missed, set(), f"{name} {kind}: {len(missed)} missed")
            self.assertLessEqual(len(found[kind]), len(listed), f"{name} {kind}")
            print(f"{name} {kind}: {len(found[kind])} found, {sum(listed.values())} collide, {len(listed)} listed, "
                  f"{len(found[kind] - set(listed))} not listed")

    def test_active_sets(self):
        for name in SCENES:
            with self.subTest(name):
                self.check_active_set(name)

    def test_steps(self):
        for name in SCENES:
            with self.subTest(name):
                result = self.json("step", *frames(name))
                self.assertIn(result["outcome"], ["contact", "initial_contact", "initial_separating"])
                contacts = self.json("active-set", *frames(name))
                print(f"{name}: {result['outcome']} at {result['step']}, "
                      f"{result['seconds']['total']:.2f} s; active set {contacts['seconds']['total']:.2f} s")
                self.assertEqual(result["toi"], contacts["earliest"])
                self.assertLessEqual(result["step"], result["toi"])
                self.assertGreater(result["step"], 0)
                self.assertLess(result["step"], 1)

    def test_exact_active_sets(self):
        """Neither a false negative nor a false positive, at any tolerance, so the same set at each."""
        for name in SCENES:
            expected = {kind: {pair for pair, hit in listed.items() if hit} for kind, listed in truth(name).items()}
            tolerances = ["1e-3", "1e-6", "1e-8", "1e-10"] if name == "cloth-funnel" else ["1e-3", "1e-10"]
            for tolerance in tolerances:
                with self.subTest(name, tolerance=tolerance):
                    text = self.csv("active-set", *frames(name), "--certainty", "exact", "--relative-tolerance", tolerance)
                    rows = [row.split(",") for row in text.splitlines()[1:]]
                    found = {kind: {(int(r[1]), int(r[2])) for r in rows if r[0] == kind} for kind in expected}
                    self.assertEqual(found, expected)
                    self.assertEqual({r[9] for r in rows} - {"certain", "touching_at_start"}, set())
                    self.assertTrue(all(float(r[3]) <= float(r[10]) <= 1 for r in rows))

    def test_exact_steps(self):
        for name in SCENES:
            with self.subTest(name):
                steps = [self.json("step", *frames(name), "--certainty", "exact", "--relative-tolerance", tolerance)
                         for tolerance in ["1e-3", "1e-10"]]
                times = {(s["toi"], json.dumps(s["limiting"])) for s in steps}
                self.assertEqual(len(times), 1)
                pair = self.json("active-set", *frames(name), "--certainty", "exact")["earliest_pair"]
                self.assertEqual(pair["toi"], steps[0]["toi"])
                self.assertTrue(0 < steps[0]["step"] <= pair["toi"])
                self.assertLessEqual(steps[0]["limiting"]["toi_hi"] - pair["toi"], 2 ** -52)

    def test_candidate_counts(self):
        for name, (*_, vf, ee) in SCENES.items():
            with self.subTest(name):
                self.assertEqual(self.json("candidates", *frames(name))["candidates"], {"vf": vf, "ee": ee})

    def test_broad_phases_find_the_same(self):
        expected = self.csv("candidates", *frames("cloth-funnel"), "--broad-phase", "brute")
        for method in ["bvh", "auto"]:
            self.assertEqual(self.csv("candidates", *frames("cloth-funnel"), "--broad-phase", method), expected)

    def test_same_bytes(self):
        for name in SCENES:
            with self.subTest(name):
                first = self.csv("active-set", *frames(name), "--threads", "1")
                self.assertEqual(self.csv("active-set", *frames(name), "--threads", "2"), first)
                self.assertEqual(self.csv("active-set", *frames(name), "--threads", "2"), first)


class Trade(AppTest):
    def test_no_setting_misses(self):
        """Every setting, with the truth in the form of the data."""
        name, folder = "cloth-funnel", DATA / "scenes" / "cloth-funnel"
        files = [f"{folder}/boxes/227{kind}.json,{folder}/mma_bool/227{kind}_mma_bool.json" for kind in ["vf", "ee"]]
        result = self.json("trade", *frames(name), "--truth", *files, "--repeats", "1", "--seconds", "0")
        collide = sum(sum(listed.values()) for listed in truth(name).values())
        self.assertGreater(len(result["settings"]), 30)
        for s in result["settings"]:
            self.assertEqual(s["false_negatives"], 0, s)
            if s["false_positives"] is not None:
                self.assertEqual(s["positives"], collide + s["false_positives"])


class Queries(AppTest):
    def ask(self, files, *options):
        total = self.json("queries", *files, *options)["total"]
        print(f"queries {' '.join(options)}: {total}")
        self.assertGreater(total["queries"], 0)
        self.assertEqual(total["false_negatives"], 0)

    def test_no_false_negatives(self):
        files = sorted((DATA / "queries").glob("*/*/*.csv"))
        self.assertEqual(len(files), 20)
        for options in [(), ("--tolerance", "1e-6"), ("--relative-tolerance", "1e-12"), ("--max-checks", "10")]:
            self.ask(files, *options)

    def test_queries_of_the_scenes(self):
        """These files have no truth of their own: it is that of the listed pairs, in their order."""
        files = []
        for name, (_, prefix, *_) in SCENES.items():
            for path in sorted((DATA / "scenes" / name / "queries").glob("*.csv")):
                rows = path.read_text().split()
                hits = list(truth(name)[path.stem.removeprefix(prefix)].values())
                self.assertEqual(len(rows), 8 * len(hits))
                files.append(f"{name}-{path.name}")
                self.write(files[-1], "".join(f"{row},{int(hits[i // 8])}\n" for i, row in enumerate(rows)))
        self.assertEqual(len(files), 3)
        self.ask(files, "--tolerance", "1e-6")


if __name__ == "__main__":
    unittest.main(verbosity=2)
