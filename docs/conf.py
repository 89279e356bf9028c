"""Sphinx for both languages: docs/en, and docs/zh with `-D language=zh_CN`.

Pages need no network, neither here nor when they are read: formulas become MathML, and all scripts and
fonts lie beside the pages. Cells run each time, so that every number is today's.
"""

import json
import os
import re
import sys
from pathlib import Path
from typing import Any

import numpy.typing as npt
from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.config import Config
from sphinx.environment import BuildEnvironment
from sphinx.search.zh import SearchChinese
from sphinx.util.docutils import SphinxRole
from sphinx.util.typing import stringify_annotation
from sphinx.writers.html5 import HTML5Translator

import benchdragon
from benchdragon.analysis.check import check
from benchdragon.kernels.curve import FloatArray
from benchdragon.plans.schema import read_plan
from benchdragon.player.page import write_player
from benchdragon.player.scene import judged_dance
from benchdragon.version import __version__

sys.path.insert(0, str(Path(__file__).parent))
from reference import write_modules, write_pages

author = "The benchdragon developers"
project = "benchdragon"
copyright = author
version = release = __version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.viewcode"]
templates_path = ["_templates"]
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False
html_search_scorer = str(Path(__file__).with_name("scorer.js"))
html_show_search_summary = False  # it would be fetched, which browsers forbid to pages on a disk

myst_enable_extensions = ["attrs_block", "dollarmath"]
myst_ref_domains = ["std"]
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 600
nb_merge_streams = True
nb_ipywidgets_js: dict[str, dict[str, str]] = {}

# Ends of lines that leave no gap: between Chinese signs, or after a Chinese mark and before other text.
MARK, SIGN = r"\u3000-\u303f\uff00-\uffef", r"\u4e00-\u9fff"
SEAMLESS = re.compile(rf"(?<=[{MARK}{SIGN}])\n *(?=[{MARK}{SIGN}])|(?<=[{MARK}])\n *(?=[A-Za-z{{\[])")

# What notebooks do not know: links to pages and labels, listings, labels, the link to the notebook.
LINK = re.compile(r"\[([^][]*)\]\(([\w-]+\.md|#[\w-]+)\)")
LISTING = re.compile(r"{view}`(.*?):(.*?)`")
LABEL = re.compile(r"^\([\w-]+\)=\n", re.MULTILINE)
DOWNLOAD = re.compile(r"\s*^---\s+{nb-download}`.*`\s*", re.MULTILINE)

# Arrays as signatures have them, and their names.
ARRAYS = {
    stringify_annotation(npt.ArrayLike, "smart"): "ArrayLike",
    stringify_annotation(FloatArray, "smart"): "ndarray",
}

# The menu of all pages by the folder of the pages that show it.
MENUS: dict[str, str] = {}

default_role = "literal"
autodoc_default_options = {"members": True, "exclude-members": "model_config"}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
autodoc_preserve_defaults = True
napoleon_use_ivar = True
# A method that is a public function has its listing where that is.
# Followed, all of its module would lead to the record.
viewcode_follow_imported_members = False

html_theme = "pydata_sphinx_theme"
html_theme_options: dict[str, Any] = {
    "navbar_center": [],
    "navbar_end": ["language", "theme-switcher"],
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
    "show_toc_level": 2,
}
html_sidebars = {"**": ["pages"]}


class Listing(SphinxRole):
    """`{view}` with room:name: the listing of that name, as viewcode writes it beside the API."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """A link to the listing."""
        room, _colon, name = self.text.partition(":")
        address = f"_modules/benchdragon/{room.replace('.', '/')}.html#{name}"
        text = nodes.literal("", f"{room}.{name}")
        return [nodes.reference(self.rawtext, "", text, refuri=address, internal=True)], []


class Search(SearchChinese):
    """Chinese by single signs, pairs and whole runs of them, so that any word of a page is found."""

    language_name = "English"  # that of the stemmer which Sphinx gives to browsers for Chinese too

    def split(self, text: str) -> list[str]:
        """The words of a text."""
        words = super().split(text)
        for run in re.findall(f"[{SIGN}]+", text):
            words += [run, *run, *(run[n : n + 2] for n in range(len(run) - 1))]
        return words


def visit_math(self: HTML5Translator, node: nodes.math) -> None:
    """A formula in a line."""
    self.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def visit_display(self: HTML5Translator, node: nodes.math_block) -> None:
    """A formula of its own."""
    self.body.append(f'<div class="formula">{tex2mathml(node.astext(), as_block=True)}</div>')
    raise nodes.SkipNode


def escape(*event: Any) -> None:
    """Leave the bars of |x| in a docstring, the last of the event's parts, as they are."""
    lines = event[-1]
    lines[:] = [line.replace("|", r"\|") for line in lines]


def join(_app: Sphinx, _page: str, source: list[str]) -> None:
    """Join lines of Chinese, which browsers would part by a space."""
    source[0] = SEAMLESS.sub("", source[0])


def refer(_app: Sphinx, page: str, source: list[str]) -> None:
    """Have each public name in the tables of the API lead to its page."""
    if page == "api":
        rows = re.compile(r"^\| `.*? \|", re.MULTILINE)
        named = re.compile(r"`(\w+)`")
        source[0] = rows.sub(lambda row: named.sub(r"[`\1`](reference/\1.md)", row[0]), source[0])


def shorten(*event: Any) -> tuple[str | None, str | None]:
    """Call arrays by their names in signatures, and not by all that they may be."""
    said = [text or "" for text in event[-2:]]
    for kind, name in ARRAYS.items():
        said = [text.replace(kind, name) for text in said]
    return said[0] or None, said[1] or None


def skip(_app: Sphinx, what: str, name: str, member: object, *_more: Any) -> bool | None:
    """Leave public names out of the pages of modules: each has a page of its own."""
    public = what == "module" and name in benchdragon.__all__
    return True if public and getattr(benchdragon, name) is member else None


def locate(app: Sphinx, doctree: nodes.document) -> None:
    """Give what a public name's page describes the listing of its module, which leads back to it."""
    page = app.env.docname
    if page.startswith("reference/"):
        room = getattr(benchdragon, page.removeprefix("reference/")).__module__
        for signature in doctree.findall(addnodes.desc_signature):
            signature["module"] = room
            signature["ids"].append(f"{room}.{signature['fullname']}")


def share(_app: Sphinx, page: str, _template: str, context: dict[str, Any], *_more: Any) -> None:
    """Make the menu, a third of a second, once for all pages of a folder: it leads to none of them."""
    folder, make = page.rpartition("/")[0], context["toctree"]

    def menu(**options: Any) -> str:
        if folder not in MENUS:
            MENUS[folder] = make(**options)
        return MENUS[folder]

    if folder:
        context["toctree"] = menu


def describe(app: Sphinx) -> None:
    """Write the pages of public names and of modules."""
    language = "zh" if app.config.language == "zh_CN" else "en"
    write_pages(Path(app.srcdir) / "reference", language)
    write_modules(Path(app.srcdir) / "modules", language)


def offer(app: Sphinx, page: str, source: list[str]) -> None:
    """End a page whose cells run with a link to it as a notebook, with what the cells gave."""
    if source[0].startswith("---\nfile_format: mystnb"):
        text = "下载本页的 notebook" if app.config.language == "zh_CN" else "This page as a notebook"
        source[0] += f"\n\n---\n\n{{nb-download}}`{text} <{page}.ipynb>`\n"


def plain(text: str, titles: dict[str, str]) -> str:
    """Text of a page for a notebook: titles in place of links, names in place of listings."""
    text = LISTING.sub(r"`\1.\2`", LABEL.sub("", DOWNLOAD.sub("", text)))
    return LINK.sub(lambda link: link[1] or titles[link[2]], text)


def once(outputs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Outputs without those that MyST-NB merged into the first of their stream and left behind."""
    kept: list[dict[str, Any]] = []
    whole: dict[str, str] = {}
    for output in outputs:
        name, text = output.get("name"), "".join(output.get("text", "")).rstrip()
        if name is None or name not in whole or text not in whole[name]:
            kept.append(output)
        if name is not None:
            whole.setdefault(name, text)
    return kept


def part(app: Sphinx, env: BuildEnvironment) -> None:
    """Make the notebooks readable without the pages beside them."""
    titles = {f"{page}.md": title.astext() for page, title in env.titles.items()}
    titles |= {f"#{name}": place[2] for name, place in env.domains.standard_domain.labels.items()}
    for path in (Path(app.outdir).parent / "jupyter_execute").glob("*.ipynb"):
        notebook = json.loads(path.read_text("utf-8"))
        for cell in notebook["cells"]:
            if cell["cell_type"] == "markdown":
                cell["source"] = plain("".join(cell["source"]), titles)
            else:
                cell["outputs"] = once(cell["outputs"])
        path.write_text(json.dumps(notebook, ensure_ascii=False, indent=1) + "\n", "utf-8")


def play(app: Sphinx, failure: Exception | None) -> None:
    """Write the player that the first page shows, as `benchdragon view` does."""
    if failure is None and app.builder.format == "html":
        write_player(
            Path(app.outdir) / "_static" / "player.html", judged_dance(read_plan("turn"), check)
        )


def speak(_app: Sphinx, config: Config) -> None:
    """Set what depends on the language; pictures in cells follow BENCHDRAGON_LANG."""
    chinese = config.language == "zh_CN"
    os.environ["BENCHDRAGON_LANG"] = "zh" if chinese else "en"
    config.html_title = "benchdragon 板凳龙" if chinese else "benchdragon"
    config.copyright = "benchdragon 开发者" if chinese else author
    config.nb_execution_excludepatterns = config.idle_pages.split()
    config.html_theme_options["search_bar_text"] = "搜索" if chinese else "Search"


def setup(app: Sphinx) -> None:
    """Add the role, the formulas, the search, the player and the language."""
    app.add_config_value("idle_pages", "", "env", str, "Pages whose cells do not run.")
    app.add_role("view", Listing())
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_display, None))
    app.add_search_language(Search)
    app.connect("autodoc-process-docstring", escape)
    app.connect("source-read", join)
    app.connect("source-read", offer)
    app.connect("source-read", refer)
    app.connect("builder-inited", describe)
    app.connect("autodoc-process-signature", shorten)
    app.connect("autodoc-skip-member", skip)
    app.connect("doctree-read", locate, priority=400)  # before viewcode's
    app.connect("env-updated", part)
    app.connect("html-page-context", share, priority=400)  # before the theme's, which makes menus
    app.connect("build-finished", play)
    app.connect("config-inited", speak)
