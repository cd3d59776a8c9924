"""Pictures of a step, of an active set and of a start, in a window or, on a machine without a display, as a file.

    from onset_ccd.show import draw_active_set, png

    image = png(lambda plotter: draw_active_set(plotter, mesh, x_t0, x_t1, found))
"""

import ctypes
import io
import os
import sys

import numpy as np

import onset_ccd

from .files.errors import InputError, UsageError, missing

WINDOW = (1280, 960)
MESH, OTHER, WIRE, LIMIT, CROSSING, CROSSED, TOUCHING = "#c9ced6", "#7fa8d6", "#4a5568", "#d62728", "#d62728", "#e0a100", "#1f6feb"
MESH_WORDS, OTHER_WORDS = "#6b7482", "#4b7fb8"  # the same for words, which must be read on white
TIMES = "viridis_r"
TOWARDS_EYE = (-0.75, -1.5, 0.65)
MOST_EDGES = 20000  # beyond which the edges of faces would make the picture black
MOST_LINES = 100  # contacts, beyond which lines between their points would hide the rest

PACKAGES = ("drawing needs OpenGL: on Debian or Ubuntu apt-get install libegl1 libgl1-mesa-dri draws without a display, libgl1 and a display "
            "shows windows")


def check_picture_name(path):
    if not path.lower().endswith(".png"):
        raise UsageError(f"--screenshot {path}: a name that ends in .png expected")


def load(library):
    try:
        return ctypes.CDLL(library)
    except OSError:
        return None


def egl_displays(egl):
    """What may be drawn on: the devices that EGL knows, of which software is one."""
    handle = ctypes.c_void_p
    egl.eglGetProcAddress.restype, egl.eglGetProcAddress.argtypes = handle, [ctypes.c_char_p]
    query, get = (egl.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglGetPlatformDisplayEXT"))
    if not query or not get:
        return
    devices, count = (handle * 16)(), ctypes.c_int(0)
    ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, ctypes.POINTER(handle), ctypes.POINTER(ctypes.c_int))(query)(16, devices, ctypes.byref(count))
    display_of = ctypes.CFUNCTYPE(handle, ctypes.c_uint, handle, handle)(get)
    for device in devices[: count.value]:
        yield display_of(0x313F, device, None)  # EGL_PLATFORM_DEVICE_EXT


def egl_works():
    """Whether EGL is there, and has a driver: without one VTK would end the process."""
    egl = load("libEGL.so.1")
    if egl is None:
        return False
    os.environ.setdefault("EGL_LOG_LEVEL", "fatal")
    egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
    egl.eglTerminate.argtypes = [ctypes.c_void_p]
    for display in egl_displays(egl):
        if display and egl.eglInitialize(display, None, None):
            egl.eglTerminate(display)
            return True
    return False


def choose_window(off_screen):
    """Which of VTK's windows: on Linux it would try the display first, and complain where there is none. Raises InputError where nothing is
    there that can draw."""
    if not sys.platform.startswith("linux"):
        return
    if not off_screen:
        if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            raise InputError("--show needs a display (DISPLAY is not set): --screenshot FILE.png draws without one")
        if load("libGL.so.1") is None:
            raise InputError(PACKAGES)
    elif egl_works():
        os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = "vtkEGLRenderWindow"
    elif load("libOSMesa.so.8") or load("libOSMesa.so.6"):
        os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = "vtkOSOpenGLRenderWindow"
    else:
        raise InputError(PACKAGES)


def make_plotter(off_screen):
    choose_window(off_screen)
    try:
        import pyvista
    except ImportError as error:
        if error.name in (None, "pyvista", "vtk", "vtkmodules"):
            raise missing("pyvista", "show", "a picture") from None
        raise InputError(f"pyvista cannot be imported: {error}; {PACKAGES}") from None
    plotter = pyvista.Plotter(off_screen=off_screen, window_size=WINDOW, lighting="light kit")
    plotter.set_background("white")
    return plotter


def png(draw):
    """The bytes of a picture; draw(plotter) makes it."""
    plotter = make_plotter(True)
    try:
        draw(plotter)
        image = io.BytesIO()
        plotter.screenshot(image)
        return image.getvalue()
    finally:
        plotter.close()


def window(draw):
    """Opens a window and waits until it is closed."""
    plotter = make_plotter(False)
    draw(plotter)
    plotter.disable_anti_aliasing()  # it does not go with what follows
    plotter.enable_depth_peeling(8)  # the order of faces changes as the camera moves
    plotter.show()


def in_space(x):
    """#V x 3, also of a mesh in the plane; what is not finite is drawn at 0."""
    x = np.asarray(x, float)
    return np.nan_to_num(np.pad(x, ((0, 0), (0, 3 - x.shape[1]))), posinf=0, neginf=0)


def triangles(x, faces):
    import pyvista

    if len(faces) == 0:
        return None
    return pyvista.PolyData(x, faces=np.column_stack([np.full(len(faces), 3), faces]).ravel())


def segments(x, edges):
    import pyvista

    return pyvista.PolyData(x, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel()) if len(edges) else None


class Glass:
    """Faces that one can see through. They are drawn as one shape, those farthest from the eye first: what graphics hardware has for it
    (depth peeling) is not to be had everywhere without a display."""

    def __init__(self):
        self.corners, self.colours = [np.empty((0, 3, 3))], [np.empty((0, 4), np.uint8)]

    def add(self, x, faces, colour, opacity):
        import pyvista

        rgb = pyvista.Color(colour).int_rgb
        self.corners.append(x[faces].reshape(-1, 3, 3))
        self.colours.append(np.tile(np.array([*rgb, round(255 * opacity)], np.uint8), (len(faces), 1)))

    def draw(self, plotter, towards_eye):
        corners, colours = np.concatenate(self.corners), np.concatenate(self.colours)
        if len(corners) == 0:
            return
        order = np.argsort(corners.mean(axis=1) @ np.asarray(towards_eye), kind="stable")
        shape = triangles(corners[order].reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
        shape.cell_data["colour"] = colours[order]
        add(plotter, shape, scalars="colour", rgba=True, ambient=0.25)


def add(plotter, shape, **look):
    if shape is not None and shape.n_points:
        plotter.add_mesh(shape, show_scalar_bar=False, **look)


def wires_of(mesh):
    """Edges of no face."""
    if mesh.num_faces == 0:
        return mesh.edges[: mesh.num_edges - mesh.num_points]
    of_faces = len(onset_ccd.edges(mesh.faces))
    return mesh.edges[of_faces : mesh.num_edges - mesh.num_points]


def points_of(mesh):
    return mesh.edges[mesh.num_edges - mesh.num_points :, 0]


def add_scene(plotter, glass, mesh, x, colour, opacity, edges=True, without=()):
    """`without`: faces that are drawn by others."""
    glass.add(x, np.delete(mesh.faces, without, axis=0), colour, opacity)
    if edges and mesh.num_faces and mesh.num_edges <= MOST_EDGES:
        add(plotter, segments(x, onset_ccd.edges(mesh.faces)), color="#8a93a0", opacity=0.35, line_width=1.5, lighting=False)
    add(plotter, segments(x, wires_of(mesh)), color=WIRE, opacity=max(opacity, 0.3), line_width=5, lighting=False)
    lone = points_of(mesh)
    if len(lone):
        import pyvista

        add(plotter, pyvista.PolyData(x[lone]), color=WIRE, opacity=max(opacity, 0.3), point_size=16, render_points_as_spheres=True)


def size_of(*positions):
    x = np.vstack(positions)
    return float(np.linalg.norm(x.max(axis=0) - x.min(axis=0))) or 1.0


def add_pair(plotter, x, pair, colour, size):
    """Both primitives of a pair as thick lines and balls, at positions x."""
    import pyvista

    vf, ee = onset_ccd.PairKind.vertex_face, onset_ccd.PairKind.edge_edge
    v = list(pair.vertices)
    lines = {vf: [(v[1], v[2]), (v[2], v[3]), (v[3], v[1])], ee: [(v[0], v[1]), (v[2], v[3])]}.get(pair.kind, [(v[1], v[2])])
    balls = [v[0]] if pair.kind != ee else []
    for a, b in lines:
        if a >= 0 and b >= 0 and (x[a] != x[b]).any():
            plotter.add_mesh(pyvista.Line(x[a], x[b]).tube(radius=0.003 * size), color=colour, ambient=0.4)
        elif a >= 0:
            balls.append(a)
    for ball in balls:
        plotter.add_mesh(pyvista.Sphere(radius=0.009 * size, center=x[ball]), color=colour, ambient=0.4)


def add_label(plotter, pair, x, words):
    """Beside a pair, through whatever hides it."""
    plotter.add_point_labels([x[[v for v in pair.vertices if v >= 0]].mean(axis=0)], [words], font_size=17, text_color="white", shape_color=LIMIT,
                             shape="rounded_rect", shape_opacity=0.9, margin=5, always_visible=True, point_color=LIMIT, point_size=18,
                             render_points_as_spheres=True)


def add_planes(glass, planes, x):
    size, centre = size_of(x), (x.max(axis=0) + x.min(axis=0)) / 2
    for plane in planes:
        normal = np.array(plane.normal)
        at = centre - normal * (normal @ centre - plane.offset) / (normal @ normal)
        across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        u = 0.35 * size * across / np.linalg.norm(across)
        v = np.cross(normal, u) / np.linalg.norm(normal)
        square = at + np.array([-u - v, u - v, u + v, v - u])
        glass.add(square, np.array([[0, 1, 2], [0, 2, 3]]), "#b7a58a", 0.35)


def frame(plotter, glass, mesh, title, legend):
    """The camera, what the colours mean, and one line of words."""
    plotter.add_text(title, position="upper_left", font_size=13, color="black")
    if legend:
        plotter.add_legend(legend, bcolor=None, border=False, loc="lower left", size=(0.25, 0.032 * len(legend)), face="rectangle")
    glass.draw(plotter, TOWARDS_EYE)
    plotter.enable_anti_aliasing("ssaa")
    if mesh.dimension == 2:
        plotter.view_xy()
    else:
        plotter.view_vector(TOWARDS_EYE, viewup=(0, 0, 1))
        plotter.camera.zoom(1.1)


def scalar_bar(plotter, least, most):
    """A look for what is coloured by time of impact."""
    return {"cmap": TIMES, "clim": (least, most if most > least else least + 1e-9),
            "scalar_bar_args": {"title": "time of impact\n", "color": "black", "vertical": True, "position_x": 0.88, "position_y": 0.2,
                                "height": 0.5, "width": 0.05, "n_labels": 5, "fmt": "%.4f", "title_font_size": 18, "label_font_size": 15}}


def closest_points(contacts, x):
    """p1 and p2 of each contact at positions x (#contacts x 3 each), by the weights of its vertices."""
    weights, vertices = contacts["weights"], np.maximum(contacts["vertices"], 0)
    first = np.maximum(weights, 0)[:, :, None] * x[vertices]
    second = np.maximum(-weights, 0)[:, :, None] * x[vertices]
    return first.sum(axis=1), second.sum(axis=1)


def at_contact(contacts, x_t0, x_t1):
    """Where each contact is, at its own time."""
    t = np.clip(contacts["toi"], 0, 1)[:, None]
    return (1 - t) * closest_points(contacts, x_t0)[0] + t * closest_points(contacts, x_t1)[0]


def touched_faces(mesh, contacts):
    """The earliest time of each face with a contact of its own, of an edge or of a corner: (faces, times)."""
    if mesh.num_faces == 0:
        return np.empty(0, int), np.empty(0)
    kind, toi = contacts["kind"], contacts["toi"]
    is_face, is_edge = kind == int(onset_ccd.PairKind.vertex_face), kind == int(onset_ccd.PairKind.edge_edge)
    of_faces, of_edges, of_vertices = (np.full(n, np.inf) for n in (mesh.num_faces, mesh.num_edges, mesh.num_vertices))
    np.minimum.at(of_faces, contacts["b"][is_face], toi[is_face])
    np.minimum.at(of_vertices, contacts["a"][~is_edge], toi[~is_edge])
    for side in ("a", "b"):
        np.minimum.at(of_edges, contacts[side][is_edge], toi[is_edge])
    faces, edges, count = mesh.faces.astype(np.int64), np.sort(mesh.edges.astype(np.int64), axis=1), mesh.num_vertices
    keys = edges[:, 0] * count + edges[:, 1]
    order = np.argsort(keys)
    sides = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    rows = order[np.searchsorted(keys, sides[:, :, 0] * count + sides[:, :, 1], sorter=order)]
    times = np.minimum.reduce([of_faces, of_edges[rows].min(axis=1), of_vertices[faces].min(axis=1)])
    touched = np.flatnonzero(np.isfinite(times))
    return touched, times[touched]


def add_contacts(plotter, mesh, x_t0, x_t1, contacts, touched_faces):
    import pyvista

    look = scalar_bar(plotter, float(contacts["toi"].min()), float(contacts["toi"].max()))
    bar = look.pop("scalar_bar_args")
    faces, times = touched_faces
    if len(faces):
        touched = triangles(x_t0, mesh.faces[faces])
        touched.cell_data["time of impact"] = times
        add(plotter, touched, scalars="time of impact", ambient=0.5, **look)
    first, second = closest_points(contacts, x_t0)
    between = (contacts["kind"] != int(onset_ccd.PairKind.vertex_plane)) & (len(contacts) <= MOST_LINES)
    lines = segments(np.vstack([first[between], second[between]]),
                     np.arange(between.sum())[:, None] + [0, int(between.sum())])
    if lines is not None:
        lines.cell_data["time of impact"] = contacts["toi"][between]
        add(plotter, lines, scalars="time of impact", line_width=4, lighting=False, **look)
    points = pyvista.PolyData(at_contact(contacts, x_t0, x_t1))
    points.point_data["time of impact"] = contacts["toi"]
    plotter.add_mesh(points, scalars="time of impact", point_size=18 if len(contacts) <= MOST_LINES else 10, ambient=0.6, render_points_as_spheres=True, scalar_bar_args=bar, **look)


def draw_step(plotter, mesh, x_t0, x_t1, result):
    """Start and end of the motion, where the step ends, and the pair that limits it."""
    glass, x_t0, x_t1 = Glass(), in_space(x_t0), in_space(x_t1)
    add_scene(plotter, glass, mesh, x_t0, MESH, 0.15, edges=False)
    add_scene(plotter, glass, mesh, x_t1, OTHER, 0.2, edges=False)
    x = x_t0 + result.step * (x_t1 - x_t0)
    add_scene(plotter, glass, mesh, x, MESH, 0.85)
    add_planes(glass, mesh.rules.planes, np.vstack([x_t0, x_t1]))
    legend = [["where the step ends", MESH_WORDS], ["end of the motion", OTHER_WORDS]]
    if result.limiting is not None:
        add_pair(plotter, x, result.limiting, LIMIT, size_of(x_t0, x_t1))
        add_label(plotter, result.limiting, x, "limiting pair")
    frame(plotter, glass, mesh, f"step {result.step:.6g}, outcome {result.outcome.name}", legend)


def draw_active_set(plotter, mesh, x_t0, x_t1, found):
    """Start and end of the motion; contacts by time of impact: the faces at the start, lines between the points that will meet, and balls
    where they do; the first contact."""
    glass, x_t0, x_t1 = Glass(), in_space(x_t0), in_space(x_t1)
    touched = touched_faces(mesh, found.contacts)
    add_scene(plotter, glass, mesh, x_t0, MESH, 0.5, without=touched[0])
    add_scene(plotter, glass, mesh, x_t1, OTHER, 0.2, edges=False)
    add_planes(glass, found.planes, np.vstack([x_t0, x_t1]))
    legend = [["start of the motion", MESH_WORDS], ["end of the motion", OTHER_WORDS]]
    title = f"{len(found)} contacts, outcome {found.outcome.name}"
    first = found.earliest()
    if first is not None:
        add_contacts(plotter, mesh, x_t0, x_t1, found.contacts, touched)
        add_pair(plotter, x_t0 + first.toi * (x_t1 - x_t0), first, LIMIT, size_of(x_t0, x_t1))
        add_label(plotter, first, x_t0 + first.toi * (x_t1 - x_t0), "first contact")
        title += f", first at t = {first.toi:.6g}"
    frame(plotter, glass, mesh, title, legend)


def draw_start(plotter, mesh, x, report):
    """The edges that intersect faces, these faces, and what touches without that."""
    import pyvista

    glass, x = Glass(), in_space(x)
    size = size_of(x)
    pairs, legend = report.intersections, []
    crossed = np.unique(pairs["face"])
    add_scene(plotter, glass, mesh, x, MESH, 0.5, without=crossed if mesh.dimension == 3 else ())
    add_planes(glass, mesh.rules.planes, x)
    if len(pairs):
        other = segments(x, mesh.edges[crossed]) if mesh.dimension == 2 else triangles(x, mesh.faces[crossed])
        add(plotter, other, color=CROSSED, line_width=8, ambient=0.4)
        add(plotter, segments(x, mesh.edges[np.unique(pairs["edge"])]).tube(radius=0.002 * size), color=CROSSING, ambient=0.4)
        legend = [["intersecting edges", CROSSING], ["the faces (edges) that they meet", CROSSED]]
    touching = [int(v) for row in report.touching for v in row["vertices"] if v >= 0]
    if touching:
        plotter.add_mesh(pyvista.PolyData(x[np.unique(touching)]), color=TOUCHING, point_size=18, render_points_as_spheres=True)
        legend.append(["vertices of touching pairs", TOUCHING])
    near = [int(v) for row in report.within_separation for v in row["vertices"] if v >= 0]
    if near:
        plotter.add_mesh(pyvista.PolyData(x[np.unique(near)]), color="#2ca02c", point_size=14, render_points_as_spheres=True)
        legend.append(["vertices within the separation", "#2ca02c"])
    state = "clean" if report.clean() else "a step may start here" if report.acceptable() else "a step cannot start here"
    frame(plotter, glass, mesh, f"{state}: {len(pairs)} intersections, {len(report.touching)} touching pairs", legend)
