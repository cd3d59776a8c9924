"""The comments of the public headers, as docs/site/ takes them apart and marks them."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/site"))

from comment_text import inline, parts  # noqa: E402
from doxygen_filter import filtered  # noqa: E402
from python_reference import marked, markup_of, module_of  # noqa: E402

HEADER = """// What the file is about.
#pragma once

namespace onset {

// Speaks of what follows in general.

struct Result {
  // A length < 2^10, as Options::x_y says.
  double length = 0;
  int plain = 0;
  int f() const {
    // Inside.
    return 1;
  }
};

// Computes `it`.
//
// Guarantee: never late,
// in any case. Throws std::bad_alloc where it must.
//
// x_t0, x_t1: #V x 3.
//
// Example:
//   f(1);
//
// Source: a & b.
ONSET_API int compute(const P& x_t0, const P& x_t1);
ONSET_API int compute_more(const P& x_t0);

}  // namespace onset
"""


class CommentText(unittest.TestCase):
    def test_names_stand_out_of_words(self):
        found = list(inline("As `a b`, Options::tolerance, x_t0, check() and ClosePair say: 2^-53 of NaN."))
        self.assertEqual([text for kind, text in found if kind == "code"], ["a b", "Options::tolerance", "x_t0", "check()", "ClosePair"])
        self.assertEqual([text for kind, text in found if kind == "power"], ["2^-53"])
        self.assertEqual("".join(text for _, text in found).replace("a b", "`a b`"),
                         "As `a b`, Options::tolerance, x_t0, check() and ClosePair say: 2^-53 of NaN.")

    def test_parts(self):
        lines = ["It does.", "Throws std::a for b.", "Returns c.", "", "n: a number,", "any.", "Guarantee: d.", "Example, of it:", "  e();", "", "  f = 1", "g"]
        self.assertEqual([(kind, name) for kind, name, _ in parts(lines, ["n"])],
                         [("paragraph", ""), ("throws", ""), ("returns", ""), ("parameter", "n"), ("head", "Guarantee"), ("example", "of it"),
                          ("paragraph", "")])

    def test_a_header_for_doxygen(self):
        lines = filtered(HEADER).splitlines()
        text = "\n".join(lines)
        for line in ["/// \\file", "/// What the file is about.", "/// Speaks of what follows in general.",
                     "  /// A length \\< 2<sup>10</sup>, as <code>Options\\::x_y</code> says.", "/// Computes <code>it</code>.",
                     "/// <b>Guarantee:</b> never late,", "/// \\throws std::bad_alloc where it must.", "/// \\param x_t0,x_t1 \\#V x 3.", "/// f(1);",
                     "/// <b>Source:</b> a \\& b.", "/// As <code>compute</code>."]:
            self.assertIn(line, lines)
        self.assertLess(lines.index("/// Speaks of what follows in general."), lines.index("#pragma once"))
        self.assertIn("    // Inside.", lines)
        self.assertIn("  int plain = 0;", text)

    def test_every_header_keeps_its_code(self):
        for header in [*(ROOT / "include/onset").rglob("*.hpp"), *(ROOT / "mpi/include").rglob("*.hpp")]:
            code = lambda text: [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("//")]
            self.assertEqual(code(filtered(header.read_text())), code(header.read_text()), header)

    def test_python(self):
        self.assertEqual(marked("x_t0(v) is `it`s 2^3 *a* |b| c_"), "``x_t0``\\ (v) is ``it``\\ s 2\\ :sup:`3` \\*a\\* \\|b\\| c\\_")
        self.assertEqual([line for line in markup_of(["It.", "x: y", "z.", "Throws std::invalid_argument for all."], ["x"]) if line],
                         ["It.", ":param x: y", "    z.", ":raises ValueError: for all."])

    def test_overloads_share_a_function(self):
        stub = "from typing import overload\n@overload\ndef f(a: int) -> int:\n    '''One.'''\n@overload\ndef f(b: str, **c: int) -> int:\n    '''Two.'''\n"
        names = {}
        exec(module_of(stub), names)
        self.assertEqual(names["f"].__doc__, "`f(a)`: One.\n\n`f(b, **c)`: Two.")


if __name__ == "__main__":
    unittest.main()
