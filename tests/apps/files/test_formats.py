"""Every format that meshes are read from gives the same numbers in the same order."""

import unittest

from support import AppTest, as_float, obj, off, ply, random_soup

ENCODINGS = ["ascii", "binary_little_endian", "binary_big_endian"]


class Formats(AppTest):
    def active_set(self, name, write, frames, faces):
        paths = [self.write(f"{i}_{name}", write(points, faces)) for i, points in enumerate(frames)]
        return self.csv("active-set", *paths)

    def compare(self, rounded, reals):
        """The times of impact have all bits of the positions in them, the ids their order."""
        faces, *frames = random_soup(7, 80, rounded)
        expected = self.active_set("mesh.obj", obj, frames, faces)
        self.assertGreater(expected.count("\n"), 50)
        self.assertEqual(self.active_set("mesh.OFF", off, frames, faces), expected)
        for encoding in ENCODINGS:
            for real in reals:
                with self.subTest(encoding=encoding, real=real):
                    write = lambda points, faces: ply(points, faces, encoding, real)
                    self.assertEqual(self.active_set("mesh.ply", write, frames, faces), expected)

    def test_doubles(self):
        self.compare(lambda x: x, ["double"])

    def test_floats(self):
        self.compare(as_float, ["float", "double"])

    def test_obj_with_normals_groups_and_relative_indices(self):
        faces, *frames = random_soup(8, 20)
        def rich(points, faces):
            n = len(points)
            lines = ["# a comment", "mtllib none.mtl", "o thing"] + ["v %r %r %r" % tuple(p) for p in points]
            lines += ["vn 0 0 1", "vt 0 0", "g group", "s off"]
            lines += ["f " + " ".join(f"{i + 1}/1/1" for i in f) for f in faces[:10]]
            lines += ["f " + " ".join(f"{i - n}//1" for i in f) for f in faces[10:]]
            return "\r\n".join(lines) + "\r\n"
        expected = self.active_set("plain.obj", obj, frames, faces)
        self.assertEqual(self.active_set("rich.obj", rich, frames, faces), expected)

    def test_ply_with_other_properties_and_elements(self):
        faces, *frames = random_soup(9, 20)
        def rich(points, faces):
            header = ("ply\nformat ascii 1.0\nobj_info none\n"
                      f"element vertex {len(points)}\nproperty float quality\nproperty double x\nproperty double y\n"
                      "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                      f"element face {len(faces)}\nproperty list uint8 uint32 vertex_index\nproperty int flags\n"
                      "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n")
            rows = ["0.5 %r %r %r 1 2 3" % tuple(p) for p in points] + ["3 %d %d %d 7" % tuple(f) for f in faces]
            return header + "\n".join(rows) + "\n0 1\n"
        expected = self.active_set("plain.obj", obj, frames, faces)
        self.assertEqual(self.active_set("rich.ply", rich, frames, faces), expected)


if __name__ == "__main__":
    unittest.main()
