"""onset/compat/ipc_toolkit.hpp against the sources of ipc-toolkit that its Python package ships: the plug-in classes inside
ipc-toolkit's own functions, on random scenes. The tour of tutorial.cpp compiles with these headers, too.

    toolkit_plugin.py WORK COMPILER STAND_INS PLUGIN TOUR LIBRARY... -- OPTION...

What these sources include and the package lacks (spdlog, libigl, Tight Inclusion, the configured header) is in the file STAND_INS.
"""

import concurrent.futures
import hashlib
import importlib.metadata
import importlib.util
import os
import pathlib
import subprocess
import sys

# Of ipc/, without .cpp: the base classes, what they list and ask, and brute force and the default tree to compare with.
SOURCES = """broad_phase/aabb broad_phase/broad_phase broad_phase/brute_force broad_phase/lbvh candidates/candidates
candidates/collision_stencil candidates/edge_edge candidates/edge_face candidates/edge_vertex candidates/face_face candidates/face_vertex
candidates/plane_vertex candidates/vertex_vertex ccd/additive_ccd ccd/default_narrow_phase_ccd ccd/point_static_plane
ccd/tight_inclusion_ccd collision_mesh distance/distance_type distance/edge_edge distance/line_line distance/point_edge distance/point_line
distance/point_plane distance/point_point distance/point_triangle geometry/area geometry/normal ipc tangent/closest_point
utils/unordered_map_and_set
""".split()
LACKING = """ipc/config.hpp ipc/utils/logger.hpp tight_inclusion/ccd.hpp igl/remove_unreferenced.h
igl/predicates/segment_segment_intersect.h""".split()


def main():
    end = sys.argv.index("--")
    work, compiler, stand_ins, plugin, tour, *libraries = sys.argv[1:end]
    options = sys.argv[end + 1 :]
    work = pathlib.Path(work)
    site = pathlib.Path(importlib.util.find_spec("ipctk").origin).parent
    for name in LACKING:
        path = work / "lacking" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f'#include "{stand_ins}"\n')
    # No debugging of theirs: what is compared are answers. Functions that need what is lacking are dropped when linking.
    flags = ["-std=c++17", "-O1", "-ffunction-sections", f"-I{work / 'lacking'}", f"-I{site}", *options]

    # What the package ships is compiled once for each way to compile it.
    way = hashlib.sha256(repr([compiler, flags, importlib.metadata.version("ipctk"), pathlib.Path(stand_ins).read_text()]).encode()).hexdigest()[:12]
    objects = work / f"objects-{way}"
    objects.mkdir(exist_ok=True)

    def compiled(source, name, *more):
        out = objects / f"{name}.o"
        if not out.exists() or source.parent != objects:
            subprocess.run([*os.environ.get("LAUNCHER", "").split(), compiler, *flags, *more, "-c", source, "-o", out.with_suffix(".new")], check=True)
            out.with_suffix(".new").rename(out)
        return out

    def joined(first):
        """Half of the sources as one, since most of their time is other people's headers."""
        source = objects / f"toolkit_{first}.cpp"
        source.write_text("".join(f'#include "{site}/ipc/{name}.cpp"\n' for name in SOURCES[first::2]))
        return source

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(compiled, joined(first), f"toolkit_{first}") for first in (0, 1)]
        ours = pool.submit(compiled, pathlib.Path(plugin), "plugin", "-Wall", "-Wextra", f"-isystem{site}")
        toured = pool.submit(compiled, pathlib.Path(tour), "tour", "-DONSET_TOUR_OF_IPC_TOOLKIT")
        found = [job.result() for job in [*jobs, ours]]
        toured.result()
    program = work / "toolkit_plugin"
    subprocess.run([compiler, *found, "-o", program, "-Wl,--gc-sections", *libraries], check=True)
    subprocess.run([program], check=True)


main()
