"""The hostile files of ONSET_DATA: each an error that names the file and the line, or the element where there are no lines,
within a second and 64 MiB; prints the time and memory of each. Skipped, by name, without the data."""

import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import unittest

from support import BINARY

if "ONSET_DATA" not in os.environ or not (pathlib.Path(os.environ["ONSET_DATA"]) / "reports" / "hostile").is_dir():
    print("skipped: test_hostile_data needs ONSET_DATA, the folder of the real data, with reports/hostile")
    sys.exit(77)
FILES = sorted((pathlib.Path(os.environ["ONSET_DATA"]) / "reports" / "hostile").iterdir())
MOST_SECONDS, MOST_BYTES = 1, 64 << 20
TIME = shutil.which("time")  # GNU's; without it the memory is at least that of this script, from which the program is started


def measured(path):
    """The answer of one run, its seconds of computing, and its most memory in MiB; 64 MiB of addresses are all that it may ask for."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # The limit binds what is started; the shell and GNU time need less.
    command = [TIME, "-q", "-f", "%M", BINARY] if TIME else [BINARY]
    done = subprocess.run([*command, "step", path, path], capture_output=True, timeout=60, preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = done.stderr.decode(errors="replace").splitlines()
    kilobytes = int(lines.pop()) if TIME else after.ru_maxrss
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done, lines, seconds, kilobytes / 1024


class Hostile(unittest.TestCase):
    def test_each(self):
        print(f"| file | bytes | ms | MiB{'' if TIME else ' at most'} | answer |\n|---|---|---|---|---|")
        for path in FILES:
            done, lines, seconds, mebibytes = measured(path)
            self.assertEqual((done.returncode, done.stdout, len(lines)), (1, b"", 1), (path.name, done.stderr[-1000:]))
            answer = lines[0].replace(str(path), path.name)
            print(f"| {path.name} | {path.stat().st_size} | {1e3 * seconds:.0f} | {mebibytes:.1f} | {answer[7:]} |", flush=True)
            self.assertTrue(answer.startswith("onset: " + path.name + ":"), answer)
            self.assertTrue(re.search(r"\.(ply|off):\d+: |: (vertex|face) \d+ ", answer), answer)
            self.assertLess(seconds, MOST_SECONDS, path.name)
            self.assertLess(mebibytes, 64, path.name)
        self.assertGreaterEqual(len(FILES), 10)


if __name__ == "__main__":
    unittest.main()
