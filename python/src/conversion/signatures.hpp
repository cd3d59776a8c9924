// Signatures, as the stubs of the module show them.
#pragma once

#define ONSET_ARRAY_LIKE "numpy.typing.ArrayLike"
#define ONSET_MOTION "mesh: Mesh, x_t0: " ONSET_ARRAY_LIKE ", x_t1: " ONSET_ARRAY_LIKE
#define ONSET_OPTIONS "**options: Unpack[onset_ccd.Options]"
// nb::sig of a call on a step that takes options.
#define ONSET_STEP_SIG(name, result) \
  nanobind::sig("def " name "(" ONSET_MOTION ", " ONSET_OPTIONS ") -> " result)
