# The documentation site: docs/build_site.sh gathers the pages, Sphinx makes HTML of them.
project = "Mammotwin"
extensions = ["myst_parser"]
root_doc = "docs/index"
html_theme = "sphinx_rtd_theme"
html_static_path = ["docs/_static"]
html_css_files = ["wide.css"]
html_show_copyright = False
html_show_sourcelink = False
html_theme_options = {"navigation_depth": 3}
myst_heading_anchors = 3
exclude_patterns = ["README.md"]
# Links to sources (.h, .cpp, LICENSE) lead to files that are no pages.
suppress_warnings = ["myst.xref_missing", "myst.header"]
