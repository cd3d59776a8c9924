"""scripts/draw-pipeline.py on a small step: an SVG that is well formed, with the counts that the program prints."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "draw-pipeline.py"
BINARY = os.environ["ONSET_BINARY"]


def sheets(lift, side=16):
    """Two square sheets of triangles above one another, as OBJ."""
    lines = []
    for sheet in range(2):
        z = 0.25 if sheet == 0 else lift
        lines += [f"v {i} {j} {z + 0.01 * ((7 * i + 3 * j) % 5)}" for i in range(side) for j in range(side)]
        for i in range(side - 1):
            for j in range(side - 1):
                a = sheet * side * side + i * side + j + 1
                lines += [f"f {a} {a + side} {a + 1}", f"f {a + 1} {a + side} {a + side + 1}"]
    return "\n".join(lines) + "\n"


class DrawPipeline(unittest.TestCase):
    def test_counts_are_those_that_the_program_prints(self):
        with tempfile.TemporaryDirectory() as folder:
            a, b = pathlib.Path(folder, "a.obj"), pathlib.Path(folder, "b.obj")
            a.write_text(sheets(1))
            b.write_text(sheets(-1))
            svg = subprocess.run([sys.executable, "-B", SCRIPT, BINARY, f"sheets={a},{b}"], stdout=subprocess.PIPE, check=True, text=True).stdout
            asked = [BINARY, "bench", a, b, "--repeats", "0", "--json", "-"]
            scene = json.loads(subprocess.run(asked, stdout=subprocess.PIPE, check=True).stdout)["scenes"][0]
        words = [text.firstChild.data for text in xml.dom.minidom.parseString(svg).getElementsByTagName("text")]
        self.assertIn("sheets", words)
        stats = {stage: sum(scene["stats"][stage].values()) for stage in ["swept", "candidates", "after_culls", "contacts"]}
        self.assertGreater(stats["contacts"], 0)
        for said in [f"{stats['swept']:,} pairs", f"{stats['candidates']:,} candidates", f"{stats['after_culls']:,} left by the culls",
                     f"{stats['contacts']:,} contacts", f"{scene['faces']:,} triangles"]:
            self.assertIn(said, words)


unittest.main()
