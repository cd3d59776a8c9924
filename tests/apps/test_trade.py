"""What trade prints: truth found again, a front that nothing dominates, targets that are met."""

import csv
import io
import json
import unittest

from support import END, FACES, START, AppTest, obj, random_soup
from test_queries import edge_edge, rows, vertex_face


class Trade(AppTest):
    QUICK = ["--repeats", "2", "--seconds", "0"]

    def trade(self, *arguments):
        return self.json("trade", *arguments, *self.QUICK)

    def soup(self):
        """Two frames of a soup with many contacts, and its active set at a fine tolerance as truth."""
        faces, t0, t1 = random_soup(3, 100)
        a, b = self.write("a.obj", obj(t0, faces)), self.write("b.obj", obj(t1, faces))
        found = list(csv.DictReader(io.StringIO(self.csv("active-set", a, b, "--relative-tolerance", "1e-12"))))
        self.assertGreater(len(found), 10)
        return a, b, found

    def truth(self, found):
        lines = ["kind,a,b,toi_lo,toi_hi"]
        lines += [",".join([r["kind"], r["a"], r["b"], r["toi"], r["toi"] if r["toi"] == "0" else "1"]) for r in found]
        return self.write("truth.csv", "\n".join(lines) + "\n")

    def test_scene_with_truth(self):
        a, b, found = self.soup()
        result = self.trade(a, b, "--truth", self.truth(found), "--axis", "tolerance,max-checks,min-separation")
        self.assertEqual(result["settings"][0]["axis"], "base")
        self.assertEqual({s["axis"] for s in result["settings"]}, {"base", "tolerance", "max-checks", "min-separation"})
        for s in result["settings"]:
            self.assertEqual(s["false_negatives"], 0, s)
            self.assertEqual(s["early"]["late"], 0, s)
            self.assertEqual(s["early"]["pairs"], len(found))
            if s["numbers"]["min_separation"] == 0:
                self.assertEqual(s["false_positives"], s["positives"] - len(found))
            else:
                self.assertIsNone(s["false_positives"])
                self.assertFalse(s["on_front"])
        few = next(s for s in result["settings"] if s["axis"] == "max-checks" and s["value"] == "1")
        self.assertGreater(few["budget"], 0)
        self.assertGreater(few["early"]["mean"], 0)

    def test_certainty(self):
        """Each level marks at least as many contacts certain as the one before, exact all of them."""
        a, b, found = self.soup()
        base, *others = self.trade(a, b, "--axis", "certainty")["settings"]
        levels = {s["numbers"]["certainty"]: s for s in [base, *others]}
        self.assertEqual([s["value"] for s in others], ["conservative", "exact"])
        self.assertEqual(base["numbers"]["certainty"], "certify")
        self.assertEqual(levels["conservative"]["certain"], 0)
        self.assertGreater(levels["certify"]["certain"], 0)
        self.assertEqual(levels["exact"]["certain"], levels["exact"]["positives"])
        self.assertLessEqual(levels["exact"]["positives"], levels["conservative"]["positives"])

    def test_what_is_missed_is_counted(self):
        """A truth that names a pair which never meets: one false negative in every setting."""
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        truth = self.write("truth.csv", "kind,a,b,toi_lo,toi_hi\nvf,3,0,0.5,0.5\nvf,4,0,,\n")
        result = self.trade(a, b, "--truth", truth, "--axis", "max-checks")
        for s in result["settings"]:
            self.assertEqual((s["false_negatives"], s["early"]["late"], s["early"]["pairs"]), (1, 0, 1))
        early = self.write("early.csv", "kind,a,b,toi_lo,toi_hi\nvf,3,0,0.25,0.25\n")
        base = self.trade(a, b, "--truth", early, "--axis", "kernel")["settings"][0]
        self.assertEqual(base["early"]["late"], 1)

    def test_what_a_budget_cuts_off_is_not_missed(self):
        """Sets that say that they are not complete, and until when they are."""
        a, b, found = self.soup()
        truth, limits = self.truth(found), [("--check-limit", "0", "out_of_checks"), ("--time-limit", "0", "out_of_time"),
                                            ("--memory-limit", "0", "out_of_memory"), ("--memory-limit", "2000", "out_of_memory")]
        whole = self.trade(a, b, "--truth", truth, "--axis", "threads,kernel")
        self.assertEqual([(s["incomplete"], s["complete_until"]) for s in whole["settings"]], [(None, None)] * len(whole["settings"]))
        for option, value, outcome in limits:
            with self.subTest(option=option, value=value):
                options = ["--truth", truth, "--axis", "threads,kernel", option, value]
                result = self.trade(a, b, *options, "--target-budget", "1000")
                self.assertGreater(len(result["settings"]), 1)
                for s in result["settings"]:
                    self.assertEqual((s["incomplete"], s["false_negatives"], s["on_front"]), (outcome, 0, False))
                    self.assertLess(s["positives"], len(found))
                    self.assertLessEqual(s["complete_until"], 1)
                self.assertEqual((result["recommended"], result["base_on_front"]), (None, False))
                text = self.succeed("trade", a, b, *options, *self.QUICK)
                self.assertEqual(text.count(f"incomplete: {outcome}"), len(result["settings"]))
                self.assertIn("False negatives in all settings together: 0;", text)
                table = list(csv.DictReader(io.StringIO(self.csv("trade", a, b, *options, *self.QUICK))))
                self.assertEqual({row["incomplete"] for row in table}, {outcome})
        self.assertGreater(result["settings"][0]["complete_until"], 0)  # of the last: the earliest contacts are kept
        # What should be there by then is missed, and what is known to be later, or by no time, is not.
        pairs = self.write("more.csv", "kind,a,b,toi_lo,toi_hi\nvf,0,50,1e-9,1e-9\nvf,0,60,0.999,0.999\nvf,0,70,,\n")
        base = self.trade(a, b, "--truth", pairs, "--axis", "kernel", "--memory-limit", "2000")["settings"][0]
        self.assertEqual((base["incomplete"], base["false_negatives"]), ("out_of_memory", 1))

    def test_references_are_not_cut_off(self):
        faces, t0, t1 = random_soup(3, 1000)
        a, b = self.write("a.obj", obj(t0, faces)), self.write("b.obj", obj(t1, faces))
        options = ["--axis", "kernel", "--max-checks", "1", "--certainty", "conservative"]
        base = self.trade(a, b, *options)["settings"][0]
        cut = self.trade(a, b, *options, "--check-limit", base["checks"] + 1)["settings"][0]
        self.assertEqual((cut["incomplete"], cut["early"]), (None, base["early"]))

    def test_listed_pairs(self):
        """Ids that run over vertices, edges and faces, as the public data have them."""
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        first_face = 6 + 6
        pairs = self.write("pairs.json", json.dumps([[3, first_face], [first_face, 4], [6, 11]]))
        collides = self.write("collides.json", "[true, false, false]")
        base = self.trade(a, b, "--truth", f"{pairs},{collides}", "--axis", "kernel")["settings"][0]
        self.assertEqual((base["positives"], base["false_positives"], base["false_negatives"]), (1, 0, 0))

    def test_without_truth(self):
        a, b, found = self.soup()
        result = self.trade(a, b, "--axis", "max-checks")
        self.assertIn("1e-12", result["reference"])
        for s in result["settings"]:
            self.assertIsNone(s["false_negatives"])
            self.assertEqual(s["early"]["pairs"], len(found))

    def test_front(self):
        a, b, _ = self.soup()
        settings = self.trade(a, b)["settings"]
        front = [s for s in settings if s["on_front"]]
        self.assertTrue(front)

        def clearly_better(x, y):
            return (x["us"]["max"] < y["us"]["min"] and x["checks"] != y["checks"] and x["positives"] <= y["positives"] and
                    x["budget"] <= y["budget"] and x["early"]["mean"] <= y["early"]["mean"])

        def same_work(x, y):  # then they are beaten together
            return {x["axis"], y["axis"]} <= {"base", "tolerance", "max-checks"} and all(
                x[key] == y[key] for key in ("checks", "positives", "budget", "inclusion"))

        for s in front:
            self.assertTrue(s["same_question"])
            group = [s] + [x for x in settings if same_work(x, s)]
            self.assertFalse(any(all(clearly_better(x, y) for y in group) for x in settings if x["same_question"]), s)

    def test_targets(self):
        a, b, found = self.soup()
        truth = self.truth(found)
        text = self.succeed("trade", a, b, "--truth", truth, *self.QUICK, "--target-false-positives", "0")
        self.assertRegex(text, r"Recommended: .* 0 of them false")
        result = self.trade(a, b, "--truth", truth, "--target-time-us", "1e9")
        self.assertIn(result["recommended"], [s["options"] for s in result["settings"] if s["on_front"]])
        self.assertIsNone(self.trade(a, b, "--target-time-us", "1e-3")["recommended"])
        self.assertIn("none of these", self.succeed("trade", a, b, *self.QUICK, "--target-positives", "0"))

    def test_queries(self):
        (self.folder / "vf").mkdir()
        queries = [(1, -1, 1), (1, 0.25, 0), (0.5, -0.5, 1)]
        path = self.write("vf/data.csv", "".join(rows(vertex_face(x, y), hit) for x, y, hit in queries))
        self.assertIn("1e-12", self.trade("--queries", path)["reference"])
        self.write("vf/toi.csv", "0x1p-1,0x1p-1\ninf,inf\n0x1p-1,0x1p-1\n")
        other = self.write("ee.csv", rows(edge_edge(1, 2), 0))
        result = self.trade("--queries", path)
        self.assertEqual(result["reference"], "the exact times")
        for s in result["settings"]:
            self.assertEqual((s["asked"], s["false_negatives"], s["early"]["late"], s["early"]["pairs"]), (3, 0, 0, 2))
            histogram = s["histogram"]
            self.assertEqual(sum(histogram["positive"]) + sum(histogram["negative"]), 3)
        self.assertEqual(self.trade("--queries", other)["settings"][0]["positives"], 0)

    def test_tolerances_at_the_ends_of_doubles(self):
        """Settings around the base that are no tolerances are left out."""
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        query = self.write("vf.csv", rows(vertex_face(1, -1), 1))
        for option, key in [("--tolerance", "tolerance"), ("--relative-tolerance", "relative_tolerance")]:
            for value in ["5e-324", "1e-320", "1e305", "1.7e308"]:
                for subject in [(a, b), ("--queries", query)]:
                    with self.subTest(option=option, value=value, subject=subject):
                        settings = self.trade(*subject, option, value, "--axis", "tolerance,narrow-phase")["settings"]
                        values = [s["numbers"][key] for s in settings if s["axis"] == "tolerance"]
                        self.assertEqual(settings[0]["numbers"][key], float(value))
                        self.assertTrue(values and all(0 < v < float("inf") for v in values))
                        self.assertLess(len(values), 10)
                        self.assertIn("narrow-phase", {s["axis"] for s in settings})

    def test_csv(self):
        a, b, _ = self.soup()
        table = list(csv.DictReader(io.StringIO(self.csv("trade", a, b, *self.QUICK, "--axis", "norm,threads"))))
        self.assertEqual(table[0]["axis"], "base")
        self.assertTrue(all(None not in row and None not in row.values() for row in table))

    def test_wrong_usage(self):
        self.must_fail(2, ["--queries"], "trade")
        self.must_fail(2, ["B"], "trade", "a.obj")
        self.must_fail(2, ["--truth"], "trade", "--queries", "vf.csv", "--truth", "t.csv")
        self.must_fail(2, ["--axis"], "trade", "a.obj", "b.obj", "--axis", "colour")
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.must_fail(1, ["t.csv"], "trade", a, b, "--truth", "t.csv")
        bad = self.write("t.csv", "kind,a,b,toi_lo,toi_hi\nvf,3,9,,\n")
        self.must_fail(1, ["t.csv:2"], "trade", a, b, "--truth", bad)
        pairs, short = self.write("p.json", "[[0, 1]]"), self.write("c.json", "[]")
        self.must_fail(1, ["c.json"], "trade", a, b, "--truth", f"{pairs},{short}")


if __name__ == "__main__":
    unittest.main()
