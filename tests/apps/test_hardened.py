"""The programs are built as docs/building.md says: position independent, bound before they run, with checks of the stack, of copies
and of containers."""

import os
import subprocess
import sys
import unittest

from support import BINARY

READELF = os.environ.get("READELF") or "readelf"


def elf(program, *options):
    return subprocess.run([READELF, "--wide", *options, program], stdout=subprocess.PIPE, text=True, check=True).stdout


class Hardened(unittest.TestCase):
    def test_programs(self):
        for program in (BINARY, os.environ["ONSET_CLOTH"]):
            with self.subTest(os.path.basename(program)):
                self.assertIn("DYN (", elf(program, "--file-header"))
                segments = elf(program, "--program-headers")
                self.assertIn("GNU_RELRO", segments)
                self.assertRegex(segments, r"GNU_STACK .* RW ")
                self.assertRegex(elf(program, "--dynamic"), r"BIND_NOW|FLAGS.* NOW")
                symbols = elf(program, "--dyn-syms")
                self.assertIn("__stack_chk_fail", symbols)
                self.assertIn("glibcxx_assert_fail", symbols)

    @unittest.skipIf(os.environ["CONFIG"] == "Debug", "copies are checked in optimised builds")
    def test_copies(self):
        self.assertRegex(elf(BINARY, "--dyn-syms"), r"__\w+_chk@")


if __name__ == "__main__":
    if sys.platform != "linux":
        sys.exit(77)
    unittest.main()
