"""scripts/check-tree.py on small trees: silent where all is well, and one line for each thing that is not."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check-tree.py"

PAGE = """# Architecture

## The folders

| folder | what may happen in it |
|---|---|
| `base/` | What knows no geometry is here. |
| `base/threads/` | Loops run on threads. |
| `scene/` | What can touch is said here. |

## Who may include whom

| who | may include |
|---|---|
| `base/` | nothing else |
| `base/threads/` | `base/` |
| `scene/` | `base/` |

## The end
"""
GOOD = {"docs/architecture.md": PAGE, "README.md": "See `base/clock.hpp`.\n", "CONTRIBUTING.md": "", "base/clock.hpp": "struct Clock {};\n",
        "base/threads/parallel_tbb.cpp": "#include <tbb/task_arena.h>\n", "scene/mesh.hpp": '#include "base/clock.hpp"\n#include <vector>\n'}


def said_about(changes):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**GOOD, **changes}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run([sys.executable, "-B", SCRIPT, root], stdout=subprocess.PIPE, text=True)
        lines = done.stdout.splitlines()
        assert done.returncode == (1 if lines else 0), done
        return lines


class CheckTree(unittest.TestCase):
    def says(self, words, changes):
        lines = said_about(changes)
        self.assertEqual(len(lines), 1, lines)
        for word in words:
            self.assertIn(word, lines[0])

    def test_silent_where_all_is_well(self):
        self.assertEqual(said_about({}), [])

    def test_folder_without_a_sentence(self):
        self.says(["base/odd/", "no sentence"], {"base/odd/x.hpp": ""})
        self.says(["base/", "no sentence"], {"docs/architecture.md": PAGE.replace("What knows no geometry is here.", "Clocks")})

    def test_folder_and_file_that_are_not_there(self):
        self.says(["src/", "not there"], {"docs/architecture.md": PAGE.replace("| `scene/` | What", "| `src/` | Calls are joined here. |\n| `scene/` | What")})
        self.says(["README.md", "base/gone.hpp"], {"README.md": "See `base/gone.hpp`.\n"})

    def test_crowded_folder_and_long_file(self):
        self.says(["scene/", "25 files"], {f"scene/x{i}.hpp": "" for i in range(24)})
        self.assertEqual(said_about({f"scene/x{i}.hpp": "" for i in range(17)} | {"scene/CMakeLists.txt": ""}), [])
        self.says(["scene/mesh.hpp", "401 lines"], {"scene/mesh.hpp": "\n" * 401})
        self.assertEqual(said_about({"scene/mesh.hpp": "\n" * 400}), [])

    def test_include_that_goes_up(self):
        self.says(["base/clock.hpp", "scene/mesh.hpp", "may not"], {"base/clock.hpp": '#include "scene/mesh.hpp"\n'})
        self.says(["scene/mesh.hpp", "tbb/parallel_for.h"], {"scene/mesh.hpp": "#include <tbb/parallel_for.h>\n"})
        self.says(["scene/mesh.hpp", "immintrin.h"], {"scene/mesh.hpp": "#include <immintrin.h>\n"})

    def test_old_words(self):
        for text in ["double horizon;", "run_pass();", "class Pass {", "BoxTest::passing", "HeldPairs held;", "contact_frame(x);",
                     "enum class CertaintyLevel {", "#define ONSET_KERNEL avx2", "mesh.plan()", "FixedCache cache;", "Outcome::budget"]:
            with self.subTest(text):
                self.says(["scene/mesh.hpp:1", "old word"], {"scene/mesh.hpp": text + "\n"})
        for text in ["// a pass over all items", 'getenv("ONSET_KERNEL");', "void keep(Box b);", "double gap_share;", "settle_doubtful();"]:
            with self.subTest(text):
                self.assertEqual(said_about({"scene/mesh.hpp": text + "\n"}), [])


unittest.main()
