// Nothing: a home for the precompiled headers.
