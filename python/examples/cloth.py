"""A cloth falls on a ball: implicit Euler, springs, and a barrier from onset_ccd.close_pairs, with steps from onset_ccd.LineSearch.

    python cloth.py [--vertices 30] [--steps 40] [--picture cloth.png]

Each time step minimises  |x - (x_n + h v_n + h^2 g)|_M^2 / 2 h^2 + springs + kappa sum of b(distance)  by Newton's method, as in Li et al.,
"Incremental Potential Contact", ACM Transactions on Graphics 39(4), 2020. No frame has an intersection; the example checks that, too.
"""

import argparse
import time

import numpy as np
import onset_ccd
import scipy.sparse as sparse
import scipy.sparse.linalg

H, GRAVITY, MASS, STIFFNESS, BENDING = 0.02, np.array([0, 0, -9.81]), 0.2, 60.0, 1.0  # s, m/s^2, kg, N/m of each spring
D_HAT, KAPPA, GAP_SHARE = 8e-3, 20.0, 0.1  # m, N/m, the share of each gap that a step leaves


def cloth(n):
    """n x n vertices, their triangles, and the pairs of vertices with a spring: edges, and next neighbours against bending."""
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, n), np.linspace(-0.5, 0.5, n), indexing="ij")
    ids = np.arange(n * n).reshape(n, n)
    a, b, c, d = ids[:-1, :-1].ravel(), ids[1:, :-1].ravel(), ids[1:, 1:].ravel(), ids[:-1, 1:].ravel()
    faces = np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    bending = np.vstack([np.column_stack([ids[:-2].ravel(), ids[2:].ravel()]), np.column_stack([ids[:, :-2].ravel(), ids[:, 2:].ravel()])])
    return np.column_stack([u.ravel(), v.ravel(), np.full(n * n, 0.33)]), faces, onset_ccd.edges(faces), bending


def ball(radius, rounds=3):
    """An octahedron, refined and blown up."""
    x = np.vstack([np.eye(3), -np.eye(3)])
    faces = np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
    for _ in range(rounds):
        edges = onset_ccd.edges(faces)
        middle = {tuple(edge): len(x) + i for i, edge in enumerate(np.sort(edges, axis=1).tolist())}
        x = np.vstack([x, x[edges].mean(axis=1)])
        m = np.array([[middle[tuple(sorted((f[i], f[(i + 1) % 3])))] for i in range(3)] for f in faces.tolist()])
        faces = np.vstack([np.column_stack([faces[:, i], m[:, i], m[:, i - 1]]) for i in range(3)] + [m])
    return radius * x / np.linalg.norm(x, axis=1)[:, None], faces


class Energy:
    """Value, gradient and a positive definite Hessian at x, the close pairs there being known."""

    def __init__(self, x, springs, bending, mass):
        self.ends = np.vstack([springs, bending])
        self.k = np.concatenate([np.full(len(springs), STIFFNESS), np.full(len(bending), BENDING)])
        self.length = np.linalg.norm(x[self.ends[:, 0]] - x[self.ends[:, 1]], axis=1)
        self.mass, self.aim = mass, None  # aim: where vertices would go without forces but gravity

    def value(self, x, close):
        stretch = np.linalg.norm(x[self.ends[:, 0]] - x[self.ends[:, 1]], axis=1) - self.length
        d = close.pairs["distance"]
        barrier = -((d - D_HAT) ** 2) * np.log(d / D_HAT)
        inertia = (self.mass[:, None] * (x - self.aim) ** 2).sum() / (2 * H * H)
        return inertia + (self.k * stretch**2).sum() / 2 + KAPPA * barrier[d < D_HAT].sum()

    def derivatives(self, x, close):
        gradient = self.mass[:, None] * (x - self.aim) / (H * H)
        terms = []  # (vertices, matrices): each row's block of the Hessian
        edge = x[self.ends[:, 0]] - x[self.ends[:, 1]]
        length = np.linalg.norm(edge, axis=1)
        n = edge / length[:, None]
        force = self.k * (length - self.length)
        np.add.at(gradient, self.ends, np.stack([force[:, None] * n, -force[:, None] * n], axis=1))
        nn = n[:, :, None] * n[:, None]
        across = np.maximum(force / length, 0)[:, None, None]  # a pressed spring gives way to the side
        terms.append((self.ends, np.array([[1, -1], [-1, 1]])[None, :, :, None, None] *
                      (self.k[:, None, None] * nn + across * (np.eye(3) - nn))[:, None, None]))
        pairs = close.pairs[close.pairs["distance"] < D_HAT]
        d, w, v = pairs["distance"], pairs["weights"], pairs["vertices"]
        n = np.einsum("pk,pkc->pc", w, x[v]) / d[:, None]  # from the second closest point to the first
        slope = KAPPA * (-2 * (d - D_HAT) * np.log(d / D_HAT) - (d - D_HAT) ** 2 / d)
        curvature = KAPPA * (-2 * np.log(d / D_HAT) - 4 * (d - D_HAT) / d + (d - D_HAT) ** 2 / d**2)
        np.add.at(gradient, v, slope[:, None, None] * w[:, :, None] * n[:, None, :])
        wn = w[:, :, None] * n[:, None, :]
        terms.append((v, curvature[:, None, None, None, None] * wn[:, :, None, :, None] * wn[:, None, :, None, :]))
        return gradient, self.hessian(terms, len(x))

    def hessian(self, terms, count):
        rows, columns, values = [np.arange(3 * count)], [np.arange(3 * count)], [np.repeat(self.mass / (H * H), 3)]
        for v, blocks in terms:
            dofs = 3 * v[:, :, None] + np.arange(3)
            shape = (len(v), v.shape[1], v.shape[1], 3, 3)
            rows.append(np.broadcast_to(dofs[:, :, None, :, None], shape).ravel())
            columns.append(np.broadcast_to(dofs[:, None, :, None, :], shape).ravel())
            values.append(np.broadcast_to(blocks, shape).ravel())
        return sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))))


def time_step(mesh, energy, x, velocity, free):
    """The positions after one time step; `free`: how many of the first vertices move. Returns them and the Newton steps it took."""
    energy.aim = x + H * velocity + H * H * GRAVITY * (np.arange(len(x)) < free)[:, None]
    for iteration in range(30):
        close = onset_ccd.close_pairs(mesh, x, D_HAT, threads=1)
        gradient, hessian = energy.derivatives(x, close)
        move = np.zeros_like(x)
        solution = scipy.sparse.linalg.spsolve(hessian[: 3 * free, : 3 * free], -gradient[:free].ravel(), permc_spec="MMD_AT_PLUS_A")
        move[:free] = solution.reshape(-1, 3)
        if np.abs(move).max() < 1e-2 * H:  # m: a hundredth of a metre a second
            break
        search = onset_ccd.LineSearch(mesh, x, move, d_hat=D_HAT, gap_share=GAP_SHARE, threads=1)
        step, now = search.largest_step().step, energy.value(x, close)
        while step > 1e-9 and energy.value(x + step * move, search.close_pairs(step)) > now:
            step /= 2
        x = x + step * move
    return x, iteration


def draw(x, faces, cloth_faces, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    axes = plt.figure(figsize=(8, 7)).add_subplot(projection="3d", computed_zorder=False)
    axes.plot_trisurf(*x.T, triangles=faces[cloth_faces:], color="#7a8594")
    axes.plot_trisurf(*x.T, triangles=faces[:cloth_faces], color="#c96f4a", edgecolor="#7d3f26", linewidth=0.2)
    axes.set_box_aspect(np.ptp(x, axis=0), zoom=1.5)
    axes.view_init(18, -50)
    axes.set_axis_off()
    plt.savefig(path, dpi=110, bbox_inches="tight")


def main():
    options = argparse.ArgumentParser(description="A cloth falls on a ball.")
    options.add_argument("--vertices", type=int, default=30, help="along one side of the cloth")
    options.add_argument("--steps", type=int, default=40)
    options.add_argument("--picture", default="cloth.png")
    options = options.parse_args()
    x, cloth_faces, springs, bending = cloth(options.vertices)
    free, (ball_x, ball_faces) = len(x), ball(0.3)
    x, faces = np.vstack([x, ball_x]), np.vstack([cloth_faces, ball_faces + free])
    mesh = onset_ccd.Mesh(x, faces, rules=onset_ccd.CollisionRules(static_vertices=np.arange(len(x)) >= free))
    energy = Energy(x, springs, bending, np.full(len(x), MASS / free))
    velocity, began = np.zeros_like(x), time.perf_counter()
    for frame in range(options.steps):
        moved, newton_steps = time_step(mesh, energy, x, velocity, free)
        velocity, x = (moved - x) / H, moved
        found = onset_ccd.intersections(mesh, x, threads=1)
        gap = onset_ccd.close_pairs(mesh, x, D_HAT, threads=1).pairs["gap"].min(initial=np.inf)
        print(f"frame {frame + 1}: {newton_steps} Newton steps, {len(found)} intersections, smallest gap {gap:.3g}")
        assert found.empty(), f"frame {frame + 1} intersects itself"
    print(f"{options.steps} frames without an intersection in {time.perf_counter() - began:.1f} s")
    draw(x, faces, len(cloth_faces), options.picture)


if __name__ == "__main__":
    main()
