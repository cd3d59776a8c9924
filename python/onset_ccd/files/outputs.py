"""What one run writes: nothing of it is seen before all of it is complete, and none of it replaces an input."""

import os
import stat
import sys

from .errors import InputError, UsageError


def fail(path, error):
    raise InputError(f"{'stdout' if path == '-' else path}: cannot be written: {error.strerror or error}") from None


def same_place(a, b):
    if "-" in (a, b):
        return a == b
    if os.path.exists(a) and os.path.exists(b):
        return os.path.samefile(a, b)
    return os.path.realpath(a) == os.path.realpath(b)


class Outputs:
    """Announced before the work starts, so that a path that cannot be written is known at once; written by finish()."""

    def __init__(self, inputs):
        self.inputs = [path for path in inputs if path]
        self.options = {}  # path: option
        self.contents = {}  # path: bytes

    def announce(self, option, path):
        """`path` may be written, as `option` says. Raises UsageError where it is an input or another output, InputError where it cannot be."""
        for read in self.inputs:
            if path != "-" and os.path.exists(path) and os.path.exists(read) and os.path.samefile(path, read):
                raise UsageError(f"{option}: {path} is the input {read}, which would be overwritten")
        for other, its_option in self.options.items():
            if same_place(path, other):
                raise UsageError(f"{its_option} and {option} cannot both go to {'stdout' if path == '-' else other}")
        self.options[path] = option
        if path != "-":
            self.check_place(path)

    def check_place(self, path):
        folder = os.path.dirname(os.path.realpath(path))
        try:
            if os.path.isdir(path):
                raise IsADirectoryError(21, os.strerror(21))
            os.stat(folder)
            for place, how in ((folder, os.W_OK | os.X_OK), (path, os.W_OK)):
                if os.path.exists(place) and not os.access(place, how):
                    raise PermissionError(13, os.strerror(13))
        except OSError as error:
            fail(path, error)

    def write(self, path, content):
        """Text or bytes, which take their place in finish()."""
        self.contents[path] = content.encode() if isinstance(content, str) else content

    def finish(self):
        """All files take their places together, then what goes to stdout is written."""
        unfinished = []
        try:
            for path, content in self.contents.items():
                if path != "-":
                    self.write_beside(path, content, unfinished)
            while unfinished:
                temporary, target = unfinished[0]
                try:
                    os.replace(temporary, target)
                except OSError as error:
                    fail(target, error)
                unfinished.pop(0)
        finally:
            for temporary, _ in unfinished:
                os.unlink(temporary)
        if "-" in self.contents:
            print_out(self.contents["-"].decode())

    @staticmethod
    def write_beside(path, content, unfinished):
        target = os.path.realpath(path)
        try:
            if os.path.exists(target) and not stat.S_ISREG(os.stat(target).st_mode):
                with open(target, "ab") as device:  # a pipe, /dev/null
                    device.write(content)
                return
            temporary = f"{target}.unfinished-{os.getpid()}"
            with open(temporary, "xb") as file:
                unfinished.append((temporary, target))
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            if os.path.exists(target):
                os.chmod(temporary, stat.S_IMODE(os.stat(target).st_mode))
        except OSError as error:
            fail(path, error)


def print_out(text):
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # else the interpreter complains once more when it ends
        fail("-", error)
