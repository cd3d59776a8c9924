"""Outputs: what stood at a path is there until all of a run is complete, and whatever ends the run before leaves nothing."""

import contextlib
import itertools
import json
import os
import resource
import signal
import stat
import subprocess
import time
import unittest

from support import BINARY, END, FACES, START, AppTest, obj, random_soup
from test_queries import rows, vertex_face

BAD, USAGE = 1, 2
OLD = "of an earlier run\n"


class OutputTest(AppTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.write("a.obj", obj(START, FACES)), self.write("b.obj", obj(END, FACES))
        self.query = self.write("vf.csv", rows(vertex_face(1, -1), 1))

    def soup(self):
        faces, vertices, moved = random_soup(7, 40)
        return self.write("s0.obj", obj(vertices, faces)), self.write("s1.obj", obj(moved, faces))

    @contextlib.contextmanager
    def all_kept(self, *outputs):
        """The outputs stay as they were, and no file is added."""
        for name in outputs:
            self.write(name, OLD)
        before = sorted(os.listdir(self.folder))
        yield
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        for name in outputs:
            self.assertEqual((self.folder / name).read_text(), OLD, name)

    def start(self, *arguments, **options):
        return subprocess.Popen([BINARY, *map(str, arguments)], cwd=self.folder, stderr=subprocess.PIPE, **options)

    def wait_for(self, happens):
        deadline = time.monotonic() + 60
        while not happens():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def unfinished(self):
        return [name for name in os.listdir(self.folder) if name.startswith(".onset-")]


class Failures(OutputTest):
    def test_bad_input_touches_no_output(self):
        bad, truth = self.write("bad.obj", obj(START, FACES) + "f 1 2 9\n"), self.write("t.csv", "kind,a,b\nvf,9,9\n")
        for command in [("step", bad, self.b), ("step", self.a, bad), ("active-set", self.a, bad), ("candidates", self.a, bad),
                        ("check", bad), ("filters", bad), ("queries", self.query, "vf-gone.csv"), ("replay", self.query, "vf-gone.csv"),
                        ("trade", self.a, bad), ("trade", self.a, self.b, "--truth", truth), ("trade", "--queries", "vf-gone.csv"),
                        ("bench", self.a, bad), ("bench", bad, bad), ("bench", self.a, self.b, "--refine", "0", "--static-body", "x")]:
            with self.all_kept("out.json", "out.csv"):
                done = self.run_app(*command, "--json", "out.json", *(["--csv", "out.csv"] if command[0] != "filters" else []))
                self.assertIn(done.returncode, (BAD, USAGE), done.args)
        wrong = self.write("vf-wrong.csv", rows(vertex_face(1, -1), 1) + "x\n")
        for command in ["queries", "replay"]:
            with self.all_kept("out.json", "out.csv"):  # the first file is good
                self.must_fail(BAD, ["vf-wrong.csv:9"], command, self.query, wrong, "--json", "out.json", "--csv", "out.csv")

    def test_places_that_cannot_be_written_are_known_before_the_work(self):
        (self.folder / "folder").mkdir()
        options = ["--csv", "--json", "--dump", "--export"]
        for option, (path, word) in itertools.product(options, [("gone/out", "No such file"), ("a.obj/out", "Not a directory"),
                                                                ("/proc/out", "/proc/out")]):
            with self.all_kept("out.json"):
                others = [] if option == "--json" else ["--json", "out.json"]
                self.must_fail(BAD, [path, word], "step", self.a, self.b, option, path, *others, "--max-checks", "1")
        for option in ["--csv", "--json"]:
            self.must_fail(BAD, ["folder", "Is a directory"], "step", self.a, self.b, option, "folder")
        for name in ["d-vf.csv", "d-ee.json"]:
            (self.folder / name).mkdir()
            with self.all_kept("out.json"):
                self.must_fail(BAD, [name, "Is a directory"], "step", self.a, self.b, "--dump", "d", "--json", "out.json")
            (self.folder / name).rmdir()

    def test_folders_without_permission(self):
        """The file that is there could be written, and a crash would lose it: it is not."""
        as_nobody = (lambda: os.setuid(65534)) if os.geteuid() == 0 else None
        self.folder.chmod(0o755)
        if as_nobody and subprocess.run(["true"], preexec_fn=as_nobody).returncode + subprocess.run(
                ["test", "-x", BINARY], preexec_fn=as_nobody).returncode:
            self.skipTest("another user cannot run the program here")
        inner = self.folder / "inner"
        inner.mkdir()
        kept = inner / "out.csv"
        kept.write_text(OLD)
        for folder_mode, file_mode in [(0o555, 0o666), (0o777, 0o444)]:
            inner.chmod(folder_mode), kept.chmod(file_mode)
            done = self.start("step", self.a, self.b, "--csv", kept, "--json", inner / "new.json", stdout=subprocess.PIPE,
                              preexec_fn=as_nobody)
            out, err = done.communicate(timeout=60)
            inner.chmod(0o755)
            self.assertEqual((done.returncode, out), (BAD, b""))
            self.assertIn(b"Permission denied", err)
            self.assertEqual((kept.read_text(), os.listdir(inner)), (OLD, ["out.csv"]))

    def test_full_disks(self):
        a, b = self.soup()
        # A program that ignores SIGXFSZ is told by write(); one that did not would die of it.
        limit = lambda size: lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        files = ["out.csv", "out.json", "e-contacts.ply", "e-swept.ply", "e-candidates.ply", "d-vf.csv", "d-vf.json", "d-ee.csv",
                 "d-ee.json"]
        sizes = {}
        self.succeed("active-set", a, b, "--csv", "out.csv", "--json", "out.json", "--export", "e", "--dump", "d")
        for name in files:
            sizes[name] = (self.folder / name).stat().st_size
        self.assertGreater(min(sizes.values()), 0)
        for size in [0, 1, min(sizes.values()), max(sizes.values()) - 1]:
            with self.all_kept(*files):
                done = self.start("active-set", a, b, "--csv", "out.csv", "--json", "out.json", "--export", "e", "--dump", "d",
                                  stdout=subprocess.PIPE, preexec_fn=limit(size))
                out, err = done.communicate(timeout=60)
                self.assertEqual((done.returncode, out), (BAD, b""), err)
                self.assertIn(b"File too large", err)
        for option in ["--csv", "--json"]:
            self.must_fail(BAD, ["/dev/full", "No space left"], "active-set", a, b, option, "/dev/full")
        for arguments in [("step", a, b), ("step", a, b, "--csv", "-"), ("step", a, b, "--json", "-"), ("--help",), ("step", "--help"),
                          ("--version",)]:
            with open("/dev/full", "w") as full:
                done = subprocess.run([BINARY, *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, timeout=60)
            self.assertEqual((done.returncode, done.stderr.count(b"\n")), (BAD, 1), done.stderr)
            self.assertIn(b"stdout", done.stderr)

    def test_full_devices_keep_the_files(self):
        """What goes to a device has to be there before any file takes its place; only the summary may fail later."""
        a, b = self.soup()
        for command in [("step", a, b), ("active-set", a, b), ("candidates", a, b), ("queries", self.query)]:
            for one, other in [("--csv", "--json"), ("--json", "--csv")]:
                with self.all_kept("out"):
                    self.must_fail(BAD, ["/dev/full", "No space left"], *command, one, "/dev/full", other, "out")
                    with open("/dev/full", "w") as full:
                        done = self.start(*command, one, "-", other, "out", stdout=full)
                        error = done.communicate(timeout=60)[1]
                    self.assertEqual((done.returncode, error.count(b"\n")), (BAD, 1), error)
                    self.assertIn(b"stdout: cannot be written: No space left", error)

    def test_closed_standard_files(self):
        """What is opened next must not get the number of stdout, and the summary with it."""
        close = lambda *numbers: lambda: [os.close(n) for n in numbers]
        done = self.start("step", self.a, self.b, "--csv", "out.csv", preexec_fn=close(1))
        self.assertIn(b"stdout: cannot be written", done.communicate(timeout=60)[1])
        self.assertEqual(done.returncode, BAD)
        self.assertEqual((self.folder / "out.csv").read_text().count("\n"), 2)
        done = subprocess.run([BINARY, "step", self.a, self.b, "--csv", "out2.csv"], cwd=self.folder, stdout=subprocess.PIPE,
                              preexec_fn=close(0, 2), timeout=60)
        self.assertEqual(done.returncode, 0)
        self.assertEqual((self.folder / "out2.csv").read_text(), (self.folder / "out.csv").read_text())


class Places(OutputTest):
    """A place that cannot be taken when all is written: the others are as they were, too."""

    FILES = 600  # some seconds

    def publish_late(self, change, *outputs, **options):
        """A run that is stopped while it writes; `change` is made, and it goes on and fails."""
        self.write("vf.csv", rows(vertex_face(1, -1), 1) * 200)
        run = self.start("queries", *["vf.csv"] * self.FILES, "--certainty", "exact", *outputs, stdout=subprocess.PIPE, **options)
        self.wait_for(lambda: self.unfinished())
        run.send_signal(signal.SIGSTOP)
        change()
        run.send_signal(signal.SIGCONT)
        out, error = run.communicate(timeout=60)
        self.assertEqual((run.returncode, out, error.count(b"\n")), (BAD, b"", 1), error)
        return error

    def test_all_is_put_back(self):
        for last, old in itertools.product(["out.csv", "out.json"], [True, False]):
            with self.subTest(last=last, old=old):
                first = "out.json" if last == "out.csv" else "out.csv"
                path, place = self.folder / first, self.folder / last
                before = path.stat() if old and self.write(first, OLD) else None
                error = self.publish_late(place.mkdir, "--csv", "out.csv", "--json", "out.json")
                self.assertIn(last.encode() + b": cannot be written: Is a directory", error)
                self.assertEqual((self.unfinished(), os.listdir(place)), ([], []))
                place.rmdir()
                if not old:
                    self.assertFalse(path.exists())
                else:
                    after = path.stat()
                    self.assertEqual((path.read_text(), after.st_ino, after.st_nlink), (OLD, before.st_ino, 1))
                    path.unlink()

    def as_nobody(self):
        if os.geteuid() != 0:
            self.skipTest("only root can become another user")
        become = lambda: os.setuid(65534)
        self.folder.chmod(0o777)
        if subprocess.run(["test", "-x", BINARY], preexec_fn=become).returncode:
            self.skipTest("another user cannot run the program here")
        return become

    def test_files_that_cannot_be_linked(self):
        """The system lets nobody make another name of a file that he can write, and not read."""
        become = self.as_nobody()
        for name in ["out.csv", "out.json"]:
            with self.subTest(name):
                other = "out.json" if name == "out.csv" else "out.csv"
                path, place = self.write(name, OLD), self.folder / other
                path.chmod(0o222)
                before = path.stat().st_ino
                self.publish_late(place.mkdir, "--csv", "out.csv", "--json", "out.json", preexec_fn=become)
                self.assertEqual((path.read_text(), path.stat().st_ino, self.unfinished()), (OLD, before, []))
                place.rmdir()
                done = self.start("step", self.a, self.b, "--csv", "out.csv", "--json", "out.json", preexec_fn=become,
                                  stdout=subprocess.DEVNULL)
                self.assertEqual((done.communicate(timeout=60)[1], done.returncode), (b"", 0))
                self.assertNotIn(OLD, [(self.folder / n).read_text() for n in ["out.csv", "out.json"]])
                self.assertEqual(self.unfinished(), [])
                path.unlink(), place.unlink()

    def test_what_can_be_seen_is_seen_before_the_work(self):
        """Files that are mount points, that the system keeps as they are, or that are others' in a folder such as /tmp."""

        def refused(words, **options):
            before = sorted(os.listdir(self.folder))
            for first, second in [("kept", "out"), ("out", "kept")]:
                run = self.start("queries", bad, "--json", first, "--csv", second, stdout=subprocess.PIPE, **options)
                out, error = run.communicate(timeout=60)
                self.assertEqual((run.returncode, out, error.count(b"\n")), (BAD, b"", 1))
                for word in ["kept: cannot be written: ", *words]:
                    self.assertIn(word.encode(), error)
            self.assertEqual((kept.read_text(), sorted(os.listdir(self.folder))), (OLD, before))

        kept, bad = self.write("kept", OLD), self.write("vf-bad.csv", "x\n")
        tried = lambda *command: subprocess.run(command, cwd=self.folder, stderr=subprocess.DEVNULL).returncode == 0
        with self.subTest("mount"):
            self.write("outside", OLD)
            if not tried("mount", "--bind", "outside", "kept"):
                self.skipTest("only root may mount")
            try:
                refused(["mount point"])
            finally:
                self.assertTrue(tried("umount", "kept"))
        for attribute in ["i", "a"]:
            with self.subTest(attribute):
                if not tried("chattr", "+" + attribute, "kept"):
                    self.skipTest("this file system has no such attribute")
                try:
                    refused(["Operation not permitted"])
                finally:
                    self.assertTrue(tried("chattr", "-" + attribute, "kept"))
        with self.subTest("sticky"):
            become = self.as_nobody()
            self.folder.chmod(0o1777), kept.chmod(0o666)
            refused(["Operation not permitted"], preexec_fn=become)


class Signals(OutputTest):
    ENDING = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT]

    def setUp(self):
        super().setUp()
        self.no_core = lambda: resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def long_queries(self, **options):
        """Writes its CSV as it goes, for minutes."""
        files = ["vf.csv"] * 20000
        self.write("vf.csv", rows(vertex_face(1, -1), 1) * 200)
        return self.start("queries", *files, "--certainty", "exact", "--csv", "out.csv", "--json", "out.json", **options)

    def test_while_outputs_are_written(self):
        for number in self.ENDING:
            with self.subTest(number), self.all_kept("out.csv", "out.json"):
                run = self.long_queries(preexec_fn=self.no_core)
                self.wait_for(lambda: any((self.folder / name).stat().st_size > 0 for name in self.unfinished()))
                run.send_signal(number)
                self.assertEqual(run.communicate(timeout=60)[1], b"")
                self.assertEqual(run.returncode, -number)

    def test_during_a_long_step(self):
        """Before anything is written, and with threads at work."""
        for number in self.ENDING:
            with self.subTest(number), self.all_kept("out.csv", "out.json"):
                run = self.start("bench", "--cloth", "100000", "--repeats", "1000", "--threads", "2", "--csv", "out.csv", "--json",
                                 "out.json", preexec_fn=self.no_core)
                self.wait_for(lambda: len(os.listdir(f"/proc/{run.pid}/task")) > 1)
                time.sleep(0.2)
                run.send_signal(number)
                self.assertEqual(run.communicate(timeout=60)[1], b"")
                self.assertEqual(run.returncode, -number)

    def test_at_any_moment(self):
        """A short run that is interrupted sooner or later: the old outputs, or all of the new ones."""
        arguments = ["active-set", *self.soup(), "--csv", "out.csv", "--json", "out.json", "--dump", "d", "--export", "e"]
        begin = time.monotonic()
        self.succeed(*arguments)
        length = time.monotonic() - begin
        names = [n for n in os.listdir(self.folder) if n.startswith(("out.", "d-", "e-"))]
        new = {name: (self.folder / name).read_text() for name in names if name != "out.json"}  # which has seconds
        outcomes = set()
        for i in range(40):
            for name in names:
                self.write(name, OLD)
            run = self.start(*arguments, stdout=subprocess.DEVNULL)
            time.sleep(1.2 * length * i / 40)
            run.send_signal(signal.SIGINT)
            run.communicate(timeout=60)
            self.assertIn(run.returncode, (0, -signal.SIGINT))
            self.assertEqual(self.unfinished(), [])
            kept = [(self.folder / name).read_text() == OLD for name in names]
            self.assertIn(kept, ([True] * len(names), [False] * len(names)))
            outcomes.add(kept[0])
            if not kept[0]:
                self.assertEqual({name: (self.folder / name).read_text() for name in new}, new)
        self.assertIn(True, outcomes)

    def test_that_are_ignored_stay_ignored(self):
        run = self.start("active-set", *self.soup(), "--csv", "out.csv", stdout=subprocess.DEVNULL,
                         preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        for _ in range(20):
            run.send_signal(signal.SIGHUP)
            time.sleep(0.001)
        self.assertEqual((run.communicate(timeout=60)[1], run.returncode), (b"", 0))
        self.assertTrue((self.folder / "out.csv").exists())

    def test_readers_that_leave(self):
        """Quietly, by SIGPIPE; where that is ignored, with a word."""
        for arguments, ignored in itertools.product([["--csv", "-", "--json", "out.json"], ["--csv", "-"]], [False, True]):
            self.write("vf.csv", rows(vertex_face(1, -1), 1) * 2000)
            with self.all_kept("out.json"):
                ignore = lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN)
                run = self.start("queries", *["vf.csv"] * 20, *arguments, stdout=subprocess.PIPE,
                                 preexec_fn=ignore if ignored else None)
                self.assertEqual(run.stdout.readline(), b"file,index,kind,outcome,toi\n")
                run.stdout.close()
                error = run.stderr.read()
                run.wait(timeout=60)
                run.stderr.close()
                if ignored:
                    self.assertEqual((run.returncode, error.count(b"\n")), (BAD, 1))
                    self.assertIn(b"stdout: cannot be written: Broken pipe", error)
                else:
                    self.assertEqual((run.returncode, error), (-signal.SIGPIPE, b""))

    def test_files_are_complete_before_the_summary(self):
        read, write = os.pipe()
        os.close(read)
        run = self.start("step", self.a, self.b, "--csv", "out.csv", "--dump", "d", stdout=write)
        os.close(write)
        self.assertEqual((run.communicate(timeout=60)[1], run.returncode), (b"", -signal.SIGPIPE))
        self.assertEqual((self.folder / "out.csv").read_text().count("\n"), 2)
        self.assertTrue((self.folder / "d-vf.json").exists())


class Names(OutputTest):
    def refused(self, output, input_name, *arguments):
        before = {p.name: p.read_bytes() for p in self.folder.iterdir() if p.is_file()}
        self.must_fail(USAGE, [str(output), str(input_name)], *arguments)
        self.assertEqual({p.name: p.read_bytes() for p in self.folder.iterdir() if p.is_file()}, before)

    def test_inputs_are_no_outputs(self):
        os.symlink("a.obj", self.folder / "link.obj")
        os.symlink(".", self.folder / "here")
        os.link(self.a, self.folder / "hard.obj")
        for name in ["a.obj", "./a.obj", "link.obj", "hard.obj", "here/a.obj", "here/./here/link.obj", self.a]:
            for option in ["--csv", "--json"]:
                self.refused(name, "a.obj", "step", "a.obj", "b.obj", option, name)
            self.refused(name, "a.obj", "check", "a.obj", "--export", name)
            self.refused(name, "a.obj", "filters", "a.obj", "--json", name)
            self.refused(name, "a.obj", "bench", "a.obj", "b.obj", "--json", name)
            self.refused(name, "a.obj", "trade", "b.obj", "a.obj", "--json", name)
        self.refused("vf.csv", "vf.csv", "queries", "vf.csv", "--csv", "vf.csv")
        self.refused("b.obj", "b.obj", "check", "a.obj", "b.obj", "--csv", "b.obj")
        self.refused("t.csv", "t.csv", "trade", "a.obj", "b.obj", "--csv", "t.csv", "--truth", self.write("t.csv", "kind\n"))
        self.write("c.json", "[]")
        self.refused("c.json", "c.json", "trade", "a.obj", "b.obj", "--json", "c.json", "--truth", "t.csv,c.json")
        self.write("toi.csv", "0.5,0.5\n")
        self.refused("toi.csv", "toi.csv", "trade", "--queries", "vf.csv", "--json", "toi.csv")
        self.succeed("step", "a.obj", "b.obj", "--dump", "d")
        self.refused("d-vf.json", "d-vf.json", "replay", "d-vf.csv", "--json", "d-vf.json")
        os.link(self.a, self.folder / "x-swept.ply")
        self.refused("x-swept.ply", "a.obj", "step", "a.obj", "b.obj", "--export", "x")
        os.symlink("a.obj", self.folder / "x-ee.json")
        self.refused("x-ee.json", "a.obj", "step", "a.obj", "b.obj", "--dump", "x")

    def test_one_place_for_two_outputs(self):
        os.symlink(".", self.folder / "here")
        self.write("old.csv", OLD)
        os.symlink("old.csv", self.folder / "link.csv")
        os.link(self.folder / "old.csv", self.folder / "hard.csv")
        for one, two in [("-", "-"), ("new", "new"), ("new", "./new"), ("new", "here/new"), ("old.csv", "link.csv"), ("old.csv", "hard.csv"),
                         ("/dev/null", "/dev/null"), ("-", "/dev/stdout")]:
            self.must_fail(USAGE, ["--json", "--csv", "cannot both go to"], "step", self.a, self.b, "--json", one, "--csv", two)
        for option, name in [("--dump", "out-vf.csv"), ("--dump", "out-ee.json"), ("--export", "out-swept.ply")]:
            self.must_fail(USAGE, ["--csv", option, name], "step", self.a, self.b, "--csv", name, option, "out")
        self.must_fail(USAGE, ["--csv", "--output"], "demo", "--output", "x.ply", "--csv", "x.ply")
        self.must_fail(USAGE, ["--dump"], "step", self.a, self.b, "--dump", "-")
        for option in ["--csv", "--json", "--dump", "--export"]:
            self.must_fail(USAGE, [option, "path"], "step", self.a, self.b, option, "")

    def test_links_are_followed_and_kept(self):
        (self.folder / "inner").mkdir()
        expected = self.csv("step", self.a, self.b)
        for target, old in [("real.csv", True), ("new.csv", False), ("inner/new.csv", False), (str(self.folder / "inner" / "real.csv"), True)]:
            path = self.folder / target
            if old:
                path.write_text(OLD)
            for name, to in [("one.csv", target), ("two.csv", "one.csv")]:
                os.symlink(to, self.folder / name)
            self.succeed("step", self.a, self.b, "--csv", "two.csv")
            self.assertEqual((os.readlink(self.folder / "two.csv"), os.readlink(self.folder / "one.csv")), ("one.csv", target))
            self.assertEqual((path.read_text(), path.is_symlink()), (expected, False))
            for name in ["one.csv", "two.csv"]:
                (self.folder / name).unlink()
        os.symlink("loop.csv", self.folder / "loop.csv")
        self.must_fail(BAD, ["loop.csv", "symbolic links"], "step", self.a, self.b, "--csv", "loop.csv")
        os.symlink("gone/x.csv", self.folder / "dangling.csv")
        self.must_fail(BAD, ["dangling.csv", "No such file"], "step", self.a, self.b, "--csv", "dangling.csv")
        self.assertEqual(self.unfinished(), [])

    def test_modes(self):
        old_mask = os.umask(0o027)
        self.addCleanup(os.umask, old_mask)
        self.write("old.csv", OLD)
        for mode in [0o600, 0o664, 0o755, 0o646]:
            (self.folder / "old.csv").chmod(mode)
            self.succeed("step", self.a, self.b, "--csv", "old.csv")
            self.assertEqual(stat.S_IMODE((self.folder / "old.csv").stat().st_mode), mode)
        self.succeed("step", self.a, self.b, "--csv", "new.csv")
        self.assertEqual(stat.S_IMODE((self.folder / "new.csv").stat().st_mode), 0o640)
        if os.geteuid() == 0:
            os.chown(self.folder / "old.csv", 1234, 5678)
            self.succeed("step", self.a, self.b, "--csv", "old.csv")
            status = (self.folder / "old.csv").stat()
            self.assertEqual((status.st_uid, status.st_gid, stat.S_IMODE(status.st_mode)), (1234, 5678, 0o646))

    def test_long_names(self):
        name = "x" * 251 + ".csv"
        self.succeed("step", self.a, self.b, "--csv", name)
        self.assertTrue((self.folder / name).exists())
        self.must_fail(BAD, ["too long"], "step", self.a, self.b, "--csv", "x" + name)


class Special(OutputTest):
    def shell(self, line):
        done = subprocess.run(["bash", "-c", line, BINARY], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        self.assertEqual(self.unfinished(), [])
        return done.stdout

    def test_pipes_and_devices_are_written_in_place(self):
        expected = self.csv("step", self.a, self.b)
        self.assertIn("outcome", self.shell('"$0" step a.obj b.obj --csv /dev/null'))
        self.assertTrue(self.shell('"$0" step a.obj b.obj --csv /dev/stdout').startswith(expected + "mesh "))
        self.assertEqual(self.shell('"$0" step a.obj b.obj --csv - > out.csv; cat out.csv'), expected)
        self.assertTrue(self.shell('"$0" step a.obj b.obj --csv /dev/stdout > out.csv; cat out.csv').startswith(expected + "mesh "))
        self.assertTrue(self.shell('"$0" step a.obj b.obj --csv out.csv > out.csv; cat out.csv').startswith(expected + "mesh "))
        self.assertEqual(self.shell('echo old > out.csv; "$0" step a.obj b.obj --csv /dev/fd/3 3>> out.csv >/dev/null; cat out.csv'),
                         "old\n" + expected)
        self.assertEqual(self.shell('"$0" step a.obj b.obj --csv >(cat > out.csv) >/dev/null; wait $!; cat out.csv'), expected)
        self.assertEqual(self.shell('mkfifo pipe; cat pipe > out.csv & "$0" step a.obj b.obj --csv pipe >/dev/null; wait; cat out.csv'),
                         expected)
        self.assertEqual(self.shell('"$0" step a.obj b.obj --csv - | head -n 1'), expected.splitlines()[0] + "\n")
        self.assertTrue(self.shell('"$0" demo --output -').startswith("ply\n"))


class Dumps(OutputTest):
    def test_replays_are_the_same_whatever_the_options(self):
        a, b = self.soup()
        ways = itertools.product(["conservative", "certify", "exact"],
                                 [[], ["--min-separation", "0.01"], ["--min-separation", "0.01", "--norm", "maximum"]],
                                 [[], ["--narrow-phase", "inclusion", "--max-checks", "100000"], ["--touching-may-pass-through"],
                                  ["--tolerance", "1e-3", "--max-checks", "7"]])
        queries = 0
        for certainty, separation, more in ways:
            options = ["--certainty", certainty, *separation, *more]
            self.succeed("active-set", a, b, *options, "--dump", "d")
            result = self.json("replay", "d-vf.csv", "d-ee.csv")
            self.assertEqual(result["differing"], 0, options)
            queries += len(result["queries"])
            self.assertEqual(json.loads((self.folder / "d-vf.json").read_text())["options"]["certainty"], certainty)
        self.assertGreater(queries, 500)

    def test_any_tolerance_can_be_replayed(self):
        a, b = self.soup()
        for option, value in itertools.product(["--tolerance", "--relative-tolerance"], ["5e-324", "1e-320", "1e305", "1.7e308"]):
            self.succeed("active-set", a, b, option, value, "--dump", "d")
            self.assertEqual(self.json("replay", "d-vf.csv", "d-ee.csv")["differing"], 0, (option, value))

    def test_budgets_of_the_call_are_not_those_of_a_query(self):
        a, b = self.soup()
        for limit in [["--check-limit", "100"], ["--time-limit", "0"], ["--memory-limit", "512"]]:
            self.succeed("active-set", a, b, *limit, "--dump", "d")
            files = sorted(name for name in os.listdir(self.folder) if name.startswith("d-") and name.endswith(".csv"))
            if files:
                self.assertEqual(self.json("replay", *files)["differing"], 0, limit)


if __name__ == "__main__":
    unittest.main()
