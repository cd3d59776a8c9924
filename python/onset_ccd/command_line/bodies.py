"""The rules that the options of a command ask for."""

import numpy as np

import onset_ccd

from ..files.errors import InputError, UsageError
from ..files.scene import read_scene


def flags(option, bodies, count):
    marks = np.zeros(count, bool)
    for body in bodies:
        if body >= count:
            raise UsageError(f"{option} {body}: there are {count} bodies, numbered from 0" + (" (see --bodies components)" if count == 1 else ""))
        marks[body] = True
    return marks


def require_in_plane(scene, path, x, when=""):
    away = np.flatnonzero(x[:, 2] != 0)
    if len(away):
        v = int(away[0])
        raise InputError(f"{path} with --dim 2: vertex {scene.vertex(v)} has z = {x[v, 2]:g}{when}, not 0")


def lay_in_plane(scene):
    """The same edges and points, in the plane."""
    mesh = scene.mesh
    if mesh.num_faces:
        raise InputError(f"{scene.path} with --dim 2: there are {mesh.num_faces} faces, and lines alone lie in the plane")
    require_in_plane(scene, scene.path, scene.x_t0)
    require_in_plane(scene, scene.path, scene.x_t1, " at the end")
    scene.mesh = onset_ccd.Mesh(mesh.num_vertices, None, mesh.edges[: mesh.num_edges - mesh.num_points], mesh.rules, 2)


def set_rest(arguments, scene, rules):
    if arguments.rest is None:
        if arguments.rest_share is not None:
            raise UsageError("--rest-share needs --rest")
        return
    rest = read_scene(scene.path, arguments.rest).x_t1
    if arguments.dim == 2:
        require_in_plane(scene, arguments.rest, rest)
    rules.rest_positions = rest[:, : arguments.dim]
    if arguments.rest_share is not None:
        rules.rest_share = arguments.rest_share


def set_bodies(arguments, scene):
    """Raises UsageError for a body that the mesh has not, InputError where a mesh has faces or leaves the plane with --dim 2."""
    if arguments.dim == 2:
        lay_in_plane(scene)
    mesh = scene.mesh
    rules = mesh.rules
    bodies = mesh.components() if arguments.bodies == "components" else np.zeros(mesh.num_vertices, np.int32)
    count = int(bodies.max(initial=0)) + 1
    rules.bodies = bodies
    rules.planes = [onset_ccd.Plane(plane[:3], plane[3]) for plane in arguments.plane]
    static = flags("--static-body", arguments.static_body, count)
    rigid = flags("--rigid-body", arguments.rigid_body, count) | arguments.rigid
    if static.any():
        rules.static_vertices = static[bodies]
    if rigid.any():
        rules.rigid_bodies = rigid
    scene.welded = rules.weld = arguments.weld
    rules.excluded_rings = arguments.rings
    for separation in arguments.body_separation:
        flags("--body-separation", separation[:2], count)
    rules.body_separations = [onset_ccd.BodySeparation(*separation) for separation in arguments.body_separation]
    set_rest(arguments, scene, rules)
    try:
        mesh.rules = rules
    except ValueError as error:
        raise InputError(str(error)) from None
