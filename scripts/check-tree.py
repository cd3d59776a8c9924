#!/usr/bin/env python3
"""Whether the tree is as docs/architecture.md says: prints what is not, one line each, and ends with 1 if there is any.

    scripts/check-tree.py [ROOT]

- Every folder with sources has its sentence in the table of folders, and every folder of that table is there. So is every file that a page
  names by its path from the root.
- No folder holds more than 18 files, beside its CMakeLists.txt; include/onset/, with a header a public call, 30, and scripts/, with a
  script a command, 24. No C++ file is longer than 400 lines.
- Every include goes down or stays in its room, as the table of who may include whom says. TBB and intrinsics have one place each.
- Words that have been replaced do not come back.
"""

import pathlib
import re
import sys

TOPS = ["include", "base", "scene", "broadphase", "narrowphase", "src", "mpi", "apps", "python", "tests", "cmake", "packaging", "scripts", "docs"]
CPP = {".cpp", ".hpp", ".inl"}
SOURCES = CPP | {".py", ".sh", ".cmake", ".txt", ".in"}
LIBRARY = ("include/", "base/", "scene/", "broadphase/", "narrowphase/", "src/")
MOST_FILES, MOST_LINES = 18, 400
# A header a public call, a script a command.
MORE_FILES = {"include/onset/": 30, "scripts/": 24}

# What only one place of the library may include.
ONE_PLACE = {r"<tbb/": ("base/threads/parallel_tbb.cpp",), r"<\w*intrin\.h>": ("base/simd/",)}

# Old words, and what to write. They are patterns of the old use: a step, a pass over something, or to settle may still be said in English.
WORDS = {
    r"\brun_pass\b|\bPassBounds\b|\bPassResult\b|\bclass Pass\b|\bPass::": "traverse_pairs, PairTraversal",
    r"\bBoxTest::(passing|motion)\b": "BoxTest::moving, BoxTest::both_ends",
    r"\bboxes_pass\b|\bnever_together\b|\blook_closer\b": "moving_boxes_apart",
    r"\bHeldPairs\b|\bHeldStep\b|\bheld_(step|pairs)\b|\bHolder\b": "PairList, cull_into, step_of_pairs",
    r"\bsettles?\b": "decide_exactly",
    r"\bKeep\b|\bkeep_reduced\b|\b(double|float) keep\b": "gap_share, gap_share_reduced, Collect",
    r"\bcensus\b|\b[Tt]ake_census\b|\bPairCensus\b|\bAlike\b": "filter counts",
    r"\bPairPlan\b|[.>]plan\(\)|::plan\b": "FilterCounts, filter_counts()",
    r"\b\w*horizon\b": "t_max",
    r"\bSpares\b|\bspares_\b|\bmesh\.spares\b": "BufferPool",
    r"\b[Ff]ixed_?([Cc]ache|[Tt]rees|[Mm]otion)\b": "StaticCache, StaticTrees, StaticMotion",
    r"\blook_(at|up|in_\w+)\b": "closest_direction, gather",
    r"\bcontact_frames?\b|\bContactFrame\b": "contact_geometry",
    r"\benum class Kernel\b|\bKernel::(scalar|avx2|avx512)\b|\bOptions::kernel\b": "InstructionSet",
    r"#\s*(define|undef|ifdef|ifndef)\s+ONSET_KERNEL\b": "ONSET_ISA",
    r"\b(Pair)?Outcome::budget\b|\bStats::budget\b|\bstats\.budget\b": "max_checks, gave_up",
    r"\bCertaintyLevel\b|\bOptions::certainty\b|\boptions\.certainty\b": "Exactness, Options::exactness",
    r"\bonset/(ipc|pipeline|plan)\.hpp\b": "onset/compat/ipc.hpp, step_size.hpp and its neighbours, filter_counts.hpp",
}


def sources(root):
    """Paths from the root, of files that are part of the source."""
    for top in TOPS:
        for path in sorted((root / top).rglob("*")):
            relative = path.relative_to(root)
            hidden = any(part.startswith(".") or part == "__pycache__" for part in relative.parts)
            if path.is_file() and not hidden and path.suffix in SOURCES:
                yield relative.as_posix()


def table(text, heading):
    """The rows of the first table below a heading, as lists of cells."""
    below = text.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in below.splitlines() if line.startswith("|")]
    return rows[2:]


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def folder_of(path):
    return path.rpartition("/")[0] + "/"


def check_folders(document, files):
    sentences = {name: sentence for folder, sentence, *_ in table(document, "The folders") for name in quoted(folder)}
    counts = {}
    for path in files:
        counts.setdefault(folder_of(path), []).append(path)
    for folder, held in counts.items():
        only_build_list = all(path.endswith("CMakeLists.txt") for path in held)
        if folder not in sentences and not only_build_list:
            yield f"{folder}: no sentence in docs/architecture.md says what may happen in it"
        count = sum(not path.endswith("CMakeLists.txt") for path in held)
        most = MORE_FILES.get(folder, MOST_FILES)
        if count > most:
            yield f"{folder}: {count} files, more than {most}"
    for folder, sentence in sentences.items():
        if folder not in counts:
            yield f"docs/architecture.md: {folder} is not there"
        if not sentence.endswith(".") or len(sentence.split()) < 4:
            yield f"docs/architecture.md: {folder} has no sentence"


def check_paths(root, page):
    lines = (root / page).read_text().splitlines()
    named = {path for line in lines if not line.startswith("```") for path in quoted(line)}
    for path in sorted(named):
        if re.fullmatch(rf"({'|'.join(TOPS)})/[\w./*-]+\.[\w*]+", path) and not any(root.glob(path)):
            yield f"{page}: {path} is not there"


def check_length(path, text):
    lines = text.count("\n")
    if path.endswith(tuple(CPP)) and lines > MOST_LINES:
        yield f"{path}: {lines} lines, more than {MOST_LINES}"


INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+(["<])([^">]+)[">]', re.MULTILINE)


def find(root, path, name):
    """The file of this repository that an include means, if it is one."""
    places = ["include/", "mpi/include/", ""]
    if path.startswith(("apps/", "tests/apps/")):
        places = ["apps/", "include/", ""]
    for place in [*places, folder_of(path)]:
        if (root / (place + name)).is_file():
            return place + name
    return None


def rule_of(rules, path):
    return max((who for who in rules if path == who or (who.endswith("/") and path.startswith(who))), key=len, default=None)


def check_includes(root, rules, path, text):
    who = rule_of(rules, path)
    for bracket, name in INCLUDE.findall(text):
        line = f"{path}: includes {name}"
        for pattern, places in ONE_PLACE.items():
            if path.startswith(LIBRARY) and bracket == "<" and re.match(pattern, f"<{name}>") and not path.startswith(places):
                yield f"{line}, which only {', '.join(places)} may"
        public = ("mpi/include/" if name.startswith("onset/mpi/") else "include/") + name
        to = find(root, path, name) if bracket == '"' else (public if name.startswith("onset/") else None)
        if to is None or not (root / to).is_file():
            if bracket == "<" and name.startswith("onset/"):
                yield f"{line}, which is not there"
            continue
        if who is None:
            yield f"{line}, and docs/architecture.md has no row for {folder_of(path)}"
        elif not to.startswith((who if who.endswith("/") else folder_of(who), *rules[who])):
            yield f"{line}: {who} may not"


def check_words(path, text):
    for number, line in enumerate(text.splitlines(), 1):
        for pattern, better in WORDS.items():
            found = re.search(pattern, line)
            if found:
                yield f"{path}:{number}: '{found.group()}' is an old word; now: {better}"


def complaints(root):
    document = (root / "docs/architecture.md").read_text()
    rules = {who: tuple(quoted(rooms)) for names, rooms, *_ in table(document, "Who may include whom") for who in quoted(names)}
    files = list(sources(root))
    yield from check_folders(document, files)
    for page in ["README.md", "CONTRIBUTING.md", *sorted(path.relative_to(root).as_posix() for path in root.glob("docs/*.md"))]:
        yield from check_paths(root, page)
    for path in files:
        text = (root / path).read_text()
        if path in ("scripts/check-tree.py", "tests/scripts/test_check_tree.py"):
            continue  # they name the old words
        yield from check_words(path, text)
        if path.endswith(tuple(CPP)):
            yield from check_length(path, text)
            yield from check_includes(root, rules, path, text)


def main(root):
    found = list(complaints(root))
    for line in found:
        print(line)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1])
