// Parts of every_call() that have files of their own.
#pragma once

#include "tests/src/support/every_call.hpp"

namespace onset::tests {

// Makes meshes, copies and changes them, and asks them all they know.
void ask_mesh(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
// The calls of a mesh in the plane: the scene without z and with the edges alone.
void ask_plane_step(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
void ask_plane_set(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
void ask_plane_start(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
void ask_plane_pairs(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
// Functions that are as good as data.
void ask_words(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
// The surfaces of onset/compat/ipc.hpp, and its calls on them.
void ask_surfaces(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
void ask_toolkit(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);
void ask_adapter(const Mesh& mesh, const Subject& subject, const Options& options, Answer& answer);

}  // namespace onset::tests
