"""What plan says, and that bodies given on the command line change what is found."""

import unittest

from support import END, FACES, START, AppTest, obj

CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
CUBE_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
              (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def cubes(count, fall=0):
    """In a column with gaps of 0.5; all but the lowest fall."""
    points = [(x, y, z + 1.5 * i - (fall if i else 0)) for i in range(count) for x, y, z in CUBE]
    return points, [[v + 8 * i for v in f] for i in range(count) for f in CUBE_FACES]


class Plan(AppTest):
    def setUp(self):
        super().setUp()
        self.a = self.write("a.obj", obj(*cubes(3)))
        self.b = self.write("b.obj", obj(*cubes(3, fall=0.75)))

    def test_plain(self):
        plan = self.json("plan", self.a)
        self.assertEqual(plan["bodies"], 1)
        vf, ee = plan["plan"]["vf"], plan["plan"]["ee"]
        self.assertEqual((vf["needed"], vf["pairs"], vf["may_meet"]), (True, 24 * 36, 24 * 36 - 3 * 36))
        self.assertEqual(vf["left_out"], {"masked": 0, "static": 0, "same_body": 0, "adjacent": 108, "excluded": 0, "within_rings": 0})
        self.assertEqual(ee["pairs"], 54 * 53 // 2)
        self.assertEqual(plan["plan"]["edges"], {"moving": 54, "static": 0, "dropped": 0})
        self.assertNotIn("at_rest", plan)

    def test_bodies(self):
        plan = self.json("plan", self.a, self.b, "--bodies", "components", "--static-body", 0, "--rigid-body", 1)
        self.assertEqual((plan["bodies"], plan["at_rest"]), (3, [0]))
        self.assertEqual(plan["plan"]["vf"]["left_out"],
                         {"masked": 0, "static": 96, "same_body": 96, "adjacent": 36, "excluded": 0, "within_rings": 0})
        self.assertEqual(plan["plan"]["faces"], {"moving": 24, "static": 12, "dropped": 0})

    def test_dropped_kinds(self):
        text = self.succeed("plan", self.a, "--rigid")
        self.assertIn("vertex-face dropped: no pair may meet of 864; left out: 864 same body", text)
        self.assertIn("edges       0 moving, 0 static, 54 dropped", text)

    def test_wrong_bodies(self):
        self.must_fail(2, ["--static-body 3", "3 bodies"], "plan", self.a, "--bodies", "components", "--static-body", 3)
        self.must_fail(2, ["--rigid-body 1", "--bodies components"], "plan", self.a, "--rigid-body", 1)
        self.must_fail(1, ["vertex 8 is static"], "step", self.a, self.b, "--bodies", "components", "--static-body", 1)

    def test_contacts_between_bodies_only(self):
        """The second cube falls through the lowest one's top by 0.25; the third keeps its distance to it."""
        plain = self.json("active-set", self.a, self.b, "--tolerance", "1e-6")
        bodies = ["--bodies", "components", "--static-body", 0, "--rigid"]
        told = self.json("active-set", self.a, self.b, "--tolerance", "1e-6", *bodies)
        self.assertGreater(sum(plain["contacts"].values()), 0)
        self.assertEqual(told["contacts"], plain["contacts"])
        self.assertEqual(told["earliest"], plain["earliest"])
        self.assertEqual(told["stats"]["plan"]["vf"]["left_out"]["static"], 96)
        self.assertTrue(told["stats"]["made_fixed_boxes"])
        self.assertFalse(plain["stats"]["made_fixed_boxes"])

    def test_rings(self):
        left_out = self.json("plan", self.a, "--rings", 1)["plan"]["vf"]["left_out"]
        # Of a cube's vertices and faces, two edges lead farthest: only opposite corners can be that far.
        self.assertGreater(left_out["within_rings"], 0)
        self.assertEqual(self.json("plan", self.a, "--rings", 3)["plan"]["vf"]["left_out"]["within_rings"],
                         3 * 8 * 12 - left_out["adjacent"])
        self.must_fail(2, ["--rings"], "plan", self.a, "--rings", "-1")

    def test_separations_of_bodies(self):
        """The second cube falls by 0.75, with the third above it: it keeps 0.25 of the lowest one."""
        bodies = ["--bodies", "components", "--rigid"]
        step = lambda *more: self.json("step", self.a, self.b, *bodies, *more)["step"]
        self.assertAlmostEqual(step(), 2 / 3, 5)
        self.assertAlmostEqual(step("--body-separation", "1,0,0.25"), 1 / 3, 5)
        self.assertAlmostEqual(step("--body-separation", "1,0,0", "--min-separation", "0.25"), 2 / 3, 5)
        self.assertAlmostEqual(step("--body-separation", "0,2,0.25", "--body-separation", "0,1,0.125"), 1 / 2, 5)
        self.must_fail(2, ["--body-separation 3", "3 bodies"], "step", self.a, self.b, *bodies,
                       "--body-separation", "0,3,1")
        for wrong in ("0,1", "0", "0,1,-1", "0,x,1", "a,1,1", "0,1,nan"):
            self.must_fail(2, ["--body-separation"], "step", self.a, self.b, *bodies, "--body-separation", wrong)
        self.must_fail(2, ["--dump"], "step", self.a, self.b, *bodies, "--body-separation", "0,1,0.1", "--dump", "x")

    def test_shape_at_rest(self):
        """With a separation beyond the gaps of 0.5, each pair keeps a share of its gap."""
        separation = ["--rigid", "--bodies", "components", "--min-separation", 1]
        self.assertEqual(self.json("step", self.a, self.b, *separation)["step"], 0)
        step = lambda *more: self.json("step", self.a, self.b, *separation, "--rest", self.a, *more)["step"]
        self.assertAlmostEqual(step(), 1 / 3, 5)
        self.assertAlmostEqual(step("--rest-share", "0.25"), 1 / 2, 5)
        self.must_fail(1, ["24 against 16 vertices"], "step", self.a, self.b, "--rest", self.write("two.obj", obj(*cubes(2))))
        other = obj(*cubes(3)).rstrip("\n").rpartition("\n")[0] + "\n"
        self.must_fail(1, ["other.obj"], "step", self.a, self.b, "--rest", self.write("other.obj", other))
        self.must_fail(2, ["--rest-share"], "step", self.a, self.b, "--rest-share", "0.25")
        for wrong in ("0", "1", "2", "nan"):
            self.must_fail(2, ["--rest-share"], "step", self.a, self.b, "--rest", self.a, "--rest-share", wrong)

    def test_what_is_rigid_does_not_meet_itself(self):
        a, b = self.write("c.obj", obj(START, FACES)), self.write("d.obj", obj(END, FACES))
        self.assertEqual(self.json("step", a, b)["outcome"], "contact")
        self.assertEqual(self.json("step", a, b, "--rigid")["outcome"], "free")
        self.assertEqual(self.json("step", a, b, "--rigid", "--bodies", "components")["outcome"], "contact")


if __name__ == "__main__":
    unittest.main()
