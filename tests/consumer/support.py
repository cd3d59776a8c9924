"""What the tests of the build from outside share: where things are, and how commands are run."""

import os
import pathlib
import shutil
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CMAKE = os.environ.get("CMAKE", "cmake")


def environment(**more):
    """That of the caller, with the compiler, the launcher (ccache or nothing) and the generator of the build that tests."""
    env = {name: value for name, value in os.environ.items() if not name.startswith(("ONSET_", "CMAKE_BUILD_TYPE"))}
    for name in ("CXXFLAGS", "CFLAGS", "LDFLAGS", "CMAKE_PREFIX_PATH", "LAUNCHER"):
        env.pop(name, None)
    if os.environ.get("LAUNCHER"):
        env["CMAKE_CXX_COMPILER_LAUNCHER"] = os.environ["LAUNCHER"]
    return {**env, **more}


class OutsideTest(unittest.TestCase):
    """Each test has a folder of its own in WORK, emptied first."""

    def setUp(self):
        self.work = pathlib.Path(os.environ["WORK"]) / type(self).__name__ / self._testMethodName
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)

    def run_command(self, *command, env=None, cwd=None):
        """Its exit status and all that it says."""
        done = subprocess.run([str(word) for word in command], env=env or environment(), cwd=cwd or self.work,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout
