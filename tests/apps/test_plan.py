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
        self.assertEqual(vf["left_out"], {"masked": 0, "static": 0, "same_body": 0, "adjacent": 108, "excluded": 0})
        self.assertEqual(ee["pairs"], 54 * 53 // 2)
        self.assertEqual(plan["plan"]["edges"], {"moving": 54, "static": 0, "dropped": 0})
        self.assertNotIn("at_rest", plan)

    def test_bodies(self):
        plan = self.json("plan", self.a, self.b, "--bodies", "components", "--static-body", 0, "--rigid-body", 1)
        self.assertEqual((plan["bodies"], plan["at_rest"]), (3, [0]))
        self.assertEqual(plan["plan"]["vf"]["left_out"],
                         {"masked": 0, "static": 96, "same_body": 96, "adjacent": 36, "excluded": 0})
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

    def test_what_is_rigid_does_not_meet_itself(self):
        a, b = self.write("c.obj", obj(START, FACES)), self.write("d.obj", obj(END, FACES))
        self.assertEqual(self.json("step", a, b)["outcome"], "contact")
        self.assertEqual(self.json("step", a, b, "--rigid")["outcome"], "free")
        self.assertEqual(self.json("step", a, b, "--rigid", "--bodies", "components")["outcome"], "contact")


if __name__ == "__main__":
    unittest.main()
