#!/usr/bin/env python3
"""Runs the tests of this folder with pytest: run_pytest.py [ARGUMENTS OF PYTEST]."""

import pathlib
import sys

import pytest

sys.exit(pytest.main(["-q", "-rs", "-p", "no:cacheprovider", str(pathlib.Path(__file__).parent), *sys.argv[1:]]))
