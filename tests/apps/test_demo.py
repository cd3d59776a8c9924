"""The demo: what it prints, and the coloured mesh that it writes."""

import unittest

from support import AppTest


class Demo(AppTest):
    def test_prints_and_writes(self):
        text = self.succeed("demo")
        path = str(self.folder / "demo.ply")
        for words in ["5040 triangles", "1280 triangles", "outcome     contact", "limited by  ", "candidates", path]:
            self.assertIn(words, text)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["demo.ply"])

    def test_result(self):
        result = self.json("demo")
        step, contacts, taken = result["step"], result["active_set"], result["taken"]
        self.assertEqual(step["outcome"], "contact")
        # The lower layer is 0.05 over the sphere, ripples of 0.01 aside, and falls by 0.12.
        self.assertTrue(0.3 < step["step"] < 0.55, step["step"])
        self.assertEqual(contacts["earliest"], step["toi"])
        self.assertTrue(step["toi"] - 1e-9 < step["step"] <= step["toi"])
        self.assertGreater(contacts["contacts"]["vf"], 0)
        self.assertGreater(contacts["contacts"]["ee"], 0)
        self.assertLess(taken["step"], step["step"])
        self.assertEqual(taken["active_set"]["contacts"], {"vf": 0, "ee": 0})

    def test_the_written_mesh(self):
        self.succeed("demo", "--output", "out.ply")
        header, body = (self.folder / "out.ply").read_text().split("end_header\n")
        lines = body.splitlines()
        self.assertIn("element vertex 3269\n", header)
        self.assertIn("element face 6320\n", header)
        self.assertEqual(len(lines), 3269 + 6320)
        colours = {tuple(map(int, line.split()[3:])) for line in lines[:3269]}
        self.assertIn((200, 200, 200), colours)
        self.assertIn((255, 0, 0), colours)
        self.assertGreater(len(colours), 20)
        # It is a mesh that the command line itself reads, and from the demo's start nothing touches on the way to it.
        self.assertEqual(self.json("step", "out.ply", "out.ply")["outcome"], "free")

    def test_rows(self):
        self.assertEqual(self.csv("demo", "--threads", "1"), self.csv("demo", "--threads", "2"))

    def test_cannot_be_written(self):
        self.must_fail(1, ["gone/demo.ply", "No such file"], "demo", "--output", "gone/demo.ply")
        self.must_fail(1, ["/dev/full", "No space left"], "demo", "--output", "/dev/full")


if __name__ == "__main__":
    unittest.main()
