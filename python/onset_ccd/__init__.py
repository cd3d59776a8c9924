"""Onset: conservative continuous collision detection for simulators.

    import onset_ccd

    mesh = onset_ccd.Mesh(x_t0, faces)
    step = onset_ccd.compute_collision_free_stepsize(mesh, x_t0, x_t1)
    x = x_t0 + step.step * (x_t1 - x_t0)

Positions are arrays of #V x 3 float64 (#V x 2 in the plane), in any order of memory, which the calls read without a copy. Results
hold arrays that are views of the library's memory, contacts and close pairs as structured arrays with named fields (compare
fields: what lies between them in memory says nothing). What the library has outcomes for is a result; bad input is a ValueError with the library's text. Calls on the pairs of a mesh release
the interpreter's lock and may run at once in several threads.
"""

from . import _onset
from ._onset import *  # noqa: F403
from ._options import LineSearchOptions, Options, TruncateOptions

__version__ = _onset.__version__
__all__ = [name for name in dir(_onset) if not name.startswith("_")]
__all__ += ["LineSearchOptions", "Options", "TruncateOptions"]
