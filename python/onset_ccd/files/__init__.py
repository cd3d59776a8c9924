"""Meshes in files, of every format that meshio reads, and the files that results go to."""
