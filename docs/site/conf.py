"""The site: Sphinx reads docs/, with this folder as its configuration (scripts/build-site.sh).

ONSET_SITE_WORK is the folder that build-site.sh has put doxygen's XML and the Python package into.
"""

import os
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
DOCS, ROOT = HERE.parent, HERE.parent.parent
WORK = pathlib.Path(os.environ["ONSET_SITE_WORK"])
sys.path[:0] = [str(HERE), str(WORK / "python")]

project = "Onset"
version = release = re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(", 1)[1])[1]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "pages", "cpp_reference", "python_reference"]
exclude_patterns = ["site", "images"]
suppress_warnings = ["myst.header"]  # theory.md has a heading of the third level below its title
nitpicky = True
# What signatures name and no page has: in C++ types of the standard library, Eigen, templates and private members, in Python numpy's.
nitpick_ignore_regex = [
    (r"cpp:identifier", r".*"),
    (r"py:.*", r"(numpy|typing|typing_extensions|collections|enum|pathlib|os|meshio|pyvista|matplotlib)\..*"),
    (r"py:.*", r"(onset_ccd\._onset\.)?(ArrayLike|NDArray|float64|int32|Callable|Iterable|Any|optional|TruncateOptions|LineSearchOptions|Options)"),
]

myst_heading_anchors = 4
myst_enable_extensions = []
highlight_language = "none"
pygments_style = "friendly"
pygments_dark_style = "native"

breathe_projects = {"onset": str(WORK / "doxygen" / "xml")}
breathe_default_project = "onset"
breathe_show_include = False  # the section of the header says it
breathe_default_members = ("members", "undoc-members")
cpp_maximum_signature_line_length = python_maximum_signature_line_length = 84
cpp_index_common_prefix = ["onset::ipc::", "onset::"]

autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_mock_imports = ["meshio", "pyvista", "matplotlib", "scipy"]
add_module_names = False
default_role = "code"
smartquotes_action = "D"

html_theme = "furo"
html_title = f"Onset {version}"
html_static_path = ["static"]
html_css_files = ["onset.css"]
html_show_copyright = html_copy_source = html_show_sourcelink = html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True, "top_of_page_buttons": []}
