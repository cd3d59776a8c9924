"""Which kernels a processor has."""

import pathlib


def kernels():
    flags = pathlib.Path("/proc/cpuinfo").read_text()
    return ["scalar", *(["avx2"] if "avx2" in flags else []), *(["avx512"] if "avx512vbmi2" in flags else [])]
