"""The documentation as a site: Sphinx reads what scripts/docs lays out in build/docs/source."""

import os
import sys

project = "Folk"
author = "The Folk authors"
html_title = "Folk"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = "index"
# Everything else of the tree is there only so that links into the sources find their files.
include_patterns = ["index.md", "gallery.md", "cpp/*.md", "py/*.md", "notebooks/*.md", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md"]

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["folk.css"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False

myst_heading_anchors = 4
pygments_style = "friendly"
pygments_dark_style = "monokai"
highlight_language = "none"

autodoc_member_order = "bysource"
add_module_names = False


def setup(app):
    # Terminal output is shown as it is: lexers of shell sessions stumble over tables.
    from pygments.lexers.special import TextLexer

    app.add_lexer("console", TextLexer)

    sys.path.insert(0, os.path.dirname(__file__))
    from python_reference import as_it_stands, without_insides

    app.connect("autodoc-process-docstring", as_it_stands)
    app.connect("autodoc-process-signature", without_insides)
