# Sphinx configuration of the site. The source folder is the checkout, so that links work as they do in the repository.
project = "overturn"
copyright = "The overturn authors"
extensions = ["myst_parser"]
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/*.md", "jobs/**.md", "tests/hard_cases/README.md"]
root_doc = "docs/index"
myst_heading_anchors = 3
html_theme = "furo"
html_title = "overturn"
html_copy_source = False
# Blocks in the syntax of a program's output, and toml, which Pygments of Debian 12 knows but checks differently.
suppress_warnings = ["misc.highlighting_failure"]
