"""What bench prints: the same result however it is computed, pairs that grow with the scene, costs."""

import unittest

from support import END, FACES, START, AppTest, obj


class Bench(AppTest):
    def scenes(self, *arguments):
        return self.json("bench", "--repeats", "1", *arguments)["scenes"]

    def test_same_result_in_every_way(self):
        ways = [["--kernel", "scalar"], ["--threads", "1"], ["--threads", "2"], ["--broad-phase", "hash"]]
        results = [self.scenes("--cloth", "1000", *way)[0] for way in ways]
        for result in results:
            self.assertEqual((result["hash"], result["step_size"]), (results[0]["hash"], results[0]["step_size"]))
        finer, = self.scenes("--cloth", "1000", "--relative-tolerance", "1e-13")
        self.assertNotEqual(finer["hash"], results[0]["hash"])

    def test_generated_cloths_grow(self):
        small, large = self.scenes("--cloth", "1000,16000")
        for count in ["faces", "vertices", "edges"]:
            self.assertGreater(large[count], 10 * small[count])
        for stage in ["swept", "candidates", "contacts"]:
            few, many = (sum(scene["stats"][stage].values()) for scene in (small, large))
            self.assertGreater(few, 0)
            self.assertTrue(8 < many / few < 32, (stage, few, many))

    def test_plates_that_rest(self):
        apart, = self.scenes("--resting", "1000")
        self.assertGreater(sum(apart["stats"]["contacts"].values()), 100)
        within, = self.scenes("--resting", "1000", "--min-separation", "1e-4")
        self.assertGreater(sum(within["stats"]["contacts"].values()), sum(apart["stats"]["contacts"].values()))
        scalar, = self.scenes("--resting", "1000", "--min-separation", "1e-4", "--kernel", "scalar")
        self.assertEqual((within["hash"], within["step_size"]), (scalar["hash"], scalar["step_size"]))

    def test_small_meshes_at_rest(self):
        few, many = self.scenes("--small")
        self.assertEqual((few["faces"], many["faces"]), (196, 1936))
        for scene in (few, many):
            self.assertEqual((sum(scene["stats"]["contacts"].values()), scene["step_size"]), (0, 1))

    def test_stages_and_costs(self):
        scene, = self.scenes("--cloth", "1000")
        stats = scene["stats"]
        for kind in ["vf", "ee"]:
            counts = [stats[stage][kind] for stage in ["swept", "candidates", "after_culls", "contacts"]]
            self.assertEqual(counts, sorted(counts, reverse=True))
        for call in ["active_set", "step", "pairs"]:
            for clock in ["wall", "cpu"]:
                spread = scene[call][clock]
                self.assertTrue(0 < spread["min"] <= spread["median"] <= spread["max"])

    def test_kernels_in_turns(self):
        scene, = self.scenes("--cloth", "1000", "--kernels", "2")
        sets = [kernel["instruction_set"] for kernel in scene["kernels"]]
        self.assertEqual(sets, ["scalar", "avx2", "avx512"][:len(sets)])
        for kernel in scene["kernels"]:
            for call in ["active_set", "step"]:
                self.assertGreater(kernel[call]["cpu"]["min"], 0)
                self.assertGreater(kernel[call]["times"]["min"], 0)
        self.assertEqual(scene["kernels"][0]["step"]["times"]["max"], 1)

    def test_first_runs_timed(self):
        first, = self.json("bench", "--cloth", "1000", "--repeats", "0")["scenes"]
        later, = self.scenes("--cloth", "1000")
        self.assertEqual(first["hash"], later["hash"])
        for call in ["active_set", "step", "pairs"]:
            self.assertGreater(first[call]["cpu"]["median"], 0)
            self.assertEqual(first[call]["cpu"]["min"], first[call]["cpu"]["max"])

    def test_refined_files(self):
        a, b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        once, twice = self.scenes(a, b, "--refine", "1")
        self.assertEqual(twice["faces"], 4 * once["faces"])
        self.assertEqual(twice["vertices"], once["vertices"] + once["edges"])
        # The same motion: the vertex meets the face at the same time, up to the tolerance.
        self.assertAlmostEqual(once["step_size"], twice["step_size"], delta=1e-5)

    def test_csv_has_a_row_a_scene(self):
        rows = self.csv("bench", "--cloth", "100,200", "--repeats", "1").splitlines()
        self.assertEqual(len(rows), 3)
        self.assertEqual({row.count(",") for row in rows[1:]} - {rows[0].count(",") + 1}, set())  # a comma in the name

    def test_wrong_usage(self):
        self.must_fail(2, ["--cloth"], "bench")
        self.must_fail(2, ["B"], "bench", "a.obj")
        self.must_fail(2, ["--cloth"], "bench", "--cloth", "1")


if __name__ == "__main__":
    unittest.main()
