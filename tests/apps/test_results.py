"""What step, active-set and candidates say: fields, order, numbers, the same bytes each time."""

import json
import unittest

from support import APART, END, FACES, START, AppTest, obj, random_soup

COUNTS, SECONDS = ["vf", "ee"], ["broad", "narrow", "total"]


class Small(AppTest):
    """One vertex falls onto one face and touches it at t = 1/2."""

    def setUp(self):
        super().setUp()
        self.a, self.b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.apart = self.write("apart.obj", obj(APART, FACES))

    def check_toi(self, toi, tolerance=1e-6):
        """Never later than 1/2; earlier by what the tolerance and a speed of 2 explain, with room for four of them."""
        self.assertLessEqual(toi, 0.5)
        self.assertGreater(toi, 0.5 - 4 * tolerance)

    def test_step_json(self):
        result = self.json("step", self.a, self.b, "--tolerance", "1e-6")
        self.assertEqual(list(result)[:5], ["outcome", "step", "limiting", "candidates", "seconds"])
        self.assertEqual(result["outcome"], "contact")
        self.check_toi(result["step"])
        pair = result["limiting"]
        self.assertEqual(list(pair), ["kind", "a", "b", "vertices", "certainty", "toi_hi"])
        self.assertEqual([pair[key] for key in ["kind", "a", "b", "vertices"]], ["vf", 3, 0, [3, 0, 1, 2]])
        self.assertEqual(list(result["candidates"]), COUNTS)
        self.assertGreaterEqual(result["candidates"]["vf"], 1)
        self.assertEqual(list(result["seconds"]), SECONDS)
        self.assertEqual(result["tolerance"], 1e-6)

    def test_free_step(self):
        result = self.json("step", self.a, self.apart)
        self.assertEqual((result["outcome"], result["step"], result["limiting"]), ("free", 1, None))
        self.assertEqual(self.csv("step", self.a, self.apart), "outcome,step,kind,a,b,v0,v1,v2,v3,toi,toi_hi,rounding\nfree,1,,,,,,,,inf,inf,%.17g\n" % result["rounding"])

    def test_step_csv(self):
        header, row = self.csv("step", self.a, self.b).splitlines()
        self.assertEqual(header, "outcome,step,kind,a,b,v0,v1,v2,v3,toi,toi_hi,rounding")
        outcome, step, *pair, toi, toi_hi, rounding = row.split(",")
        self.assertEqual((outcome, pair), ("contact", ["vf", "3", "0", "3", "0", "1", "2"]))
        result = self.json("step", self.a, self.b)
        self.assertEqual([float(x) for x in [step, toi, toi_hi, rounding]],
                         [result["step"], result["toi"], result["limiting"]["toi_hi"], result["rounding"]])

    def test_time_of_impact_beside_the_step(self):
        """The exact motion touches at 1/2; the step ends where what is stored is free, a rounding before at the latest."""
        for certainty in ["conservative", "exact"]:
            result = self.json("step", self.a, self.b, "--certainty", certainty, "--tolerance", "1e-9")
            self.assertLessEqual(result["step"], result["toi"])
            self.check_toi(result["toi"], 1e-9)
            self.assertTrue(0 < result["rounding"] < 1e-12, result["rounding"])
        self.assertIsNone(self.json("step", self.a, self.apart)["toi"])
        self.assertIn("touches     never", self.succeed("step", self.a, self.apart))
        self.assertIn("touches     t = 0.4", self.succeed("step", self.a, self.b))

    def test_active_set_json(self):
        result = self.json("active-set", self.a, self.b, "--tolerance", "1e-6")
        self.assertEqual(list(result)[:4], ["contacts", "earliest", "candidates", "seconds"])
        self.assertEqual(result["contacts"], {"vf": 1, "ee": 0})
        self.check_toi(result["earliest"])
        self.assertEqual(list(result["seconds"]), SECONDS)
        self.assertEqual(result["tolerance"], 1e-6)
        self.assertEqual(result["outcome"], "contact")
        pair = result["earliest_pair"]
        self.assertEqual([pair[key] for key in ["kind", "a", "b", "vertices"]], ["vf", 3, 0, [3, 0, 1, 2]])
        free = self.json("active-set", self.a, self.apart)
        self.assertEqual((free["contacts"], free["earliest"], free["outcome"]), ({"vf": 0, "ee": 0}, None, "free"))

    def test_active_set_csv(self):
        header, row = self.csv("active-set", self.a, self.b, "--tolerance", "1e-6").splitlines()
        self.assertEqual(header, "kind,a,b,toi,v0,v1,v2,v3,status,certain,toi_hi,w0,w1,w2,w3,nx,ny,nz,gap,speed,degenerate,step_limit")
        fields = row.split(",")
        self.assertEqual(fields[:3] + fields[4:9], ["vf", "3", "0", "3", "0", "1", "2", "contact"])
        self.check_toi(float(fields[3]))
        weights, normal, (gap, speed) = [[float(x) for x in fields[i:j]] for i, j in [(11, 15), (15, 18), (18, 20)]]
        self.assertEqual((weights[0], sum(weights)), (1, 0))
        self.assertEqual((normal, speed, fields[20]), ([0, 0, 1], -2, "0"))
        self.assertTrue(0 <= gap <= 1e-6)
        self.assertEqual(fields[21], fields[3])

    def test_certainty(self):
        """The exact time is 1/2; without it the contact is known to be somewhere near."""
        exact = self.json("step", self.a, self.b, "--certainty", "exact")
        self.assertEqual((exact["toi"], exact["limiting"]["certainty"], exact["limiting"]["toi_hi"]), (0.5, "certain", 0.5))
        for level, certain in [("conservative", "within_tolerance"), ("certify", "certain"), ("exact", "certain")]:
            row = self.csv("active-set", self.a, self.b, "--certainty", level).splitlines()[1].split(",")
            self.assertEqual(row[9], certain)
            self.assertEqual(float(row[10]) >= 0.5, True)
            self.assertEqual(row[10] == "inf", level == "conservative")
        pair = self.json("active-set", self.a, self.b, "--certainty", "exact")["earliest_pair"]
        self.assertEqual((pair["toi"], pair["certainty"], pair["toi_hi"]), (0.5, "certain", 0.5))
        plain = self.json("step", self.a, self.b, "--certainty", "conservative")["limiting"]
        self.assertEqual((plain["certainty"], plain["toi_hi"]), ("within_tolerance", None))

    def test_candidates(self):
        result = self.json("candidates", self.a, self.b)
        self.assertEqual(list(result)[:2], ["candidates", "seconds"])
        rows = self.csv("candidates", self.a, self.b).splitlines()
        self.assertEqual(rows[:2], ["kind,a,b", "vf,3,0"])
        counted = {kind: sum(row.startswith(kind + ",") for row in rows) for kind in COUNTS}
        self.assertEqual(result["candidates"], counted)

    def test_options_arrive(self):
        step = lambda *options: self.json("step", self.a, self.b, *options)
        self.check_toi(step("--tolerance", "1e-9")["step"], 1e-9)
        # From z = 1 at speed 2, a separation of 0.5 is reached at t = 1/4.
        near = step("--tolerance", "1e-6", "--min-separation", "0.5")["step"]
        self.assertLessEqual(near, 0.25)
        self.assertGreater(near, 0.2499)
        relative = step("--relative-tolerance", "1e-3")
        self.assertAlmostEqual(relative["tolerance"], 1e-3 * relative["stats"]["extent"], delta=1e-15)
        self.assertGreater(relative["tolerance"], step()["tolerance"])
        self.assertEqual(step("--kernel", "scalar")["stats"]["kernel"], "scalar")
        self.assertEqual(step("--threads", "1")["stats"]["threads"], 1)
        self.assertIn("brute", self.json("candidates", self.a, self.b, "--broad-phase", "brute")["stats"]["broad_phase"])
        self.check_toi(step("--tolerance", "1e-6", "--narrow-phase", "inclusion")["step"])

    def test_summary_for_people(self):
        text = self.succeed("step", self.a, self.b)
        for words in ["6 vertices", "2 faces", "contact", "vertex 3 and face 0"]:
            self.assertIn(words, text)
        self.assertIn("1 vertex-face", self.succeed("active-set", self.a, self.b))
        self.assertIn("candidates", self.succeed("candidates", self.a, self.b))

    def test_what_is_said_where_nothing_was_looked_at(self):
        for command in ["step", "active-set", "candidates"]:
            for limit in ["--time-limit", "--check-limit"]:
                if (command, limit) == ("candidates", "--check-limit"):
                    continue  # which spends none
                said = self.succeed(command, self.a, self.b, limit, "0")
                self.assertIn("outcome     out_of_" + limit[2:].split("-")[0], said)
                self.assertNotIn("t = ", said)
                self.assertNotIn("()", said)
        self.assertIn("touches     not known", self.succeed("step", self.a, self.b, "--time-limit", "0"))
        self.assertIn("outcome     free", self.succeed("candidates", self.a, self.b))

    def test_results_in_files(self):
        shown = self.succeed("active-set", self.a, self.b, "--json", "out.json", "--csv", "out.csv")
        self.assertIn("1 vertex-face", shown)
        self.assertEqual(json.loads((self.folder / "out.json").read_text())["contacts"], {"vf": 1, "ee": 0})
        self.assertEqual((self.folder / "out.csv").read_text(), self.csv("active-set", self.a, self.b))
        rows = self.succeed("active-set", self.a, self.b, "--json", "out.json", "--csv", "-")
        self.assertEqual(rows, self.csv("active-set", self.a, self.b))

    def test_help_and_version(self):
        self.assertRegex(self.succeed("--version"), r"^onset \d+\.\d+\.\d+\n$")
        for command in ["step", "active-set", "candidates", "check", "queries", "demo"]:
            self.assertIn(command, self.succeed("--help"))
            self.assertIn("--relative-tolerance", self.succeed(command, "--help"))


class Soup(AppTest):
    """Many contacts: the same bytes for any number of threads, kernel and run; sorted; numbers that round-trip."""

    def setUp(self):
        super().setUp()
        faces, t0, t1 = random_soup(1, 400)
        self.frames = self.write("a.obj", obj(t0, faces)), self.write("b.obj", obj(t1, faces))

    def same_bytes(self, command):
        first = self.csv(command, *self.frames, "--threads", "1")
        for options in [("--threads", "1"), ("--threads", "2"), (), ("--kernel", "scalar"), ("--broad-phase", "brute")]:
            with self.subTest(options=options):
                self.assertEqual(self.csv(command, *self.frames, *options), first)
        return first

    def test_active_set(self):
        rows = [row.split(",") for row in self.same_bytes("active-set").splitlines()[1:]]
        self.assertGreater(len(rows), 1000)
        order = [(row[0] == "ee", int(row[1]), int(row[2])) for row in rows]
        self.assertEqual(order, sorted(set(order)))
        for row in rows:
            self.assertEqual("%.17g" % float(row[3]), row[3])

    def test_candidates(self):
        rows = [row.split(",") for row in self.same_bytes("candidates").splitlines()[1:]]
        order = [(row[0] == "ee", int(row[1]), int(row[2])) for row in rows]
        self.assertEqual(order, sorted(set(order)))
        self.assertEqual({"vf", "ee"}, {row[0] for row in rows})

    def test_the_earliest_of_the_active_set_ends_the_step(self):
        """At its time, or by what storing changes before it: at speeds of about 1, some 1e-15 / 0.001 of the step."""
        self.same_bytes("step")
        earliest, step = self.json("active-set", *self.frames)["earliest"], self.json("step", *self.frames)
        self.assertEqual(step["toi"], earliest)
        self.assertTrue(earliest - 1e-11 < step["step"] <= earliest, (step["step"], earliest))


if __name__ == "__main__":
    unittest.main()
