"""The site: the same pages in two languages, whose numbers lead to formulas, code and tests."""

import ast
import importlib
import json
import re
import runpy
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from html import unescape
from operator import attrgetter
from pathlib import Path

import pytest
from bs4 import BeautifulSoup, Tag
from playwright.sync_api import sync_playwright

import benchdragon
from benchdragon.inlining import chinese
from benchdragon.planner.page import PAGE, WORKER
from tests.browser.pages import FLAGS, browser_path
from tests.test_examples import shell_lines

ROOT = Path(__file__).parent.parent
LANGUAGES = {"en": "en", "zh": "zh_CN"}
PAGES = sorted(path.name for path in (ROOT / "docs" / "en").glob("*.md"))
MODULES = tomllib.loads((ROOT / "docs" / "modules.toml").read_text("utf-8"))
FENCE = re.compile(r"^```(\S+)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
# What makes a browser fetch something by itself.
LOADS = {
    "script": "src",
    "img": "src",
    "link": "href",
    "iframe": "src",
    "source": "src",
    "object": "data",
}


def source(language: str, page: str) -> str:
    return (ROOT / "docs" / language / page).read_text("utf-8")


def blocks(text: str, kind: str) -> list[str]:
    """Bodies of fenced blocks of a kind, without their options."""
    bodies = [body for found, body in FENCE.findall(text) if found == kind]
    bodies = [re.sub(r"\A---\n.*?^---\n", "", body, flags=re.DOTALL | re.MULTILINE) for body in bodies]
    return [re.sub(r"\A(:.*\n)*", "", body) for body in bodies]


def commands(text: str) -> list[str]:
    lines = [line for block in blocks(text, "sh") for line in block.splitlines()]
    return [line.split("#")[0].strip() for line in lines]


def test_both_languages_have_the_same_pages() -> None:
    chinese = sorted(path.name for path in (ROOT / "docs" / "zh").glob("*.md"))
    assert chinese == PAGES
    assert {"index.md", "established.md", "evidence.md", "question-3.md"} < set(PAGES)


def parsed(cell: str) -> list[ast.AST]:
    """All nodes of a cell, in order, without the text between the values of its f-strings."""
    tree = ast.parse(re.sub(r"^%.*$", "", cell, flags=re.MULTILINE))
    formats = [node.format_spec for node in ast.walk(tree) if isinstance(node, ast.FormattedValue)]
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr) and node not in formats:
            node.values = [value for value in node.values if isinstance(value, ast.FormattedValue)]
    return list(ast.walk(tree))


def same_but_for_words(english: str, chinese: str) -> bool:
    """Whether cells do the same, but for texts that a page in Chinese says in Chinese."""
    if english == chinese:
        return True
    one, other = parsed(english), parsed(chinese)
    for a, b in zip(one, other, strict=False):
        if isinstance(a, ast.Constant) and isinstance(b, ast.Constant) and isinstance(b.value, str):
            a.value = a.value if b.value.isascii() else b.value
    return ast.dump(one[0]) == ast.dump(other[0])


def test_words_may_differ_between_languages_and_nothing_else() -> None:
    assert same_but_for_words('print(f"length {a:.2f} m")', 'print(f"长度 {a:.2f} m")')
    assert not same_but_for_words('print(f"length {a:.2f} m")', 'print(f"长度 {b:.2f} m")')
    assert not same_but_for_words('print(f"length {a:.2f} m")', 'print(f"长度 {a:.3f} m")')
    assert not same_but_for_words('read("spiral-in")', 'read("turn")')
    assert not same_but_for_words("f(1)", "f(2)")


def called(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == name


@pytest.mark.parametrize("page", PAGES)
def test_what_cells_print_on_chinese_pages_is_chinese(page: str) -> None:
    """No English words in what is printed, but for what the catalogue translates."""
    for cell in blocks(source("zh", page), "{code-cell}"):
        nodes = list(ast.walk(ast.parse(re.sub(r"^%.*$", "", cell, flags=re.MULTILINE))))
        translated = {
            id(argument) for node in nodes if called(node, "_") for argument in ast.walk(node)
        }
        for printed in (node for node in nodes if called(node, "print")):
            texts = [part for part in ast.walk(printed) if id(part) not in translated]
            said = [part.value for part in texts if isinstance(part, ast.Constant)]
            words = " ".join(text for text in said if isinstance(text, str) and " " in text)
            assert set(re.findall(r"[A-Za-z]{3,}", words)) <= {"theta"}, words


@pytest.mark.parametrize("page", PAGES)
def test_both_languages_run_the_same_code_and_lead_to_the_same_places(page: str) -> None:
    english, chinese = source("en", page), source("zh", page)
    cells = blocks(english, "{code-cell}"), blocks(chinese, "{code-cell}")
    assert len(cells[0]) == len(cells[1])
    for one, other in zip(*cells, strict=True):
        assert same_but_for_words(one, other), (one, other)
    assert blocks(english, "{eval-rst}") == blocks(chinese, "{eval-rst}")
    assert commands(english) == commands(chinese)
    for pattern in (r"{view}`(.*?)`", r"\]\((#.*?)\)", r"^\((.*?)\)=$", r"^```{literalinclude} (.*)$"):
        found = [sorted(re.findall(pattern, text, re.MULTILINE)) for text in (english, chinese)]
        assert found[0] == found[1], pattern


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_listing_that_a_page_leads_to_is_made(language: str) -> None:
    described = {name for page in MODULES.values() for name in page["modules"]}
    for name in benchdragon.__all__:
        assert getattr(benchdragon, name).__module__.removeprefix("benchdragon.") in described, name
    for page in PAGES:
        for room, name in re.findall(r"{view}`(.*?):(.*?)`", source(language, page)):
            assert room in described, page
            found = attrgetter(name)(importlib.import_module(f"benchdragon.{room}"))
            # A name is listed in the module that defines it, not where it is imported.
            assert getattr(found, "__module__", f"benchdragon.{room}") == f"benchdragon.{room}", name


def own_modules(node: ast.AST) -> list[str]:
    """The modules of the package that a statement imports."""
    named = [node.module] if isinstance(node, ast.ImportFrom) else []
    named += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
    return [str(name) for name in named if str(name).startswith("benchdragon")]


@pytest.mark.parametrize("page", PAGES)
def test_what_the_cells_of_a_page_name_is_there(page: str) -> None:
    """Without running them, as the site's own test does."""
    cells = "\n".join(blocks(source("en", page), "{code-cell}"))
    code = re.sub(r"^%.*$", "", cells, flags=re.MULTILINE)  # IPython's own lines
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ImportFrom):
            module = importlib.import_module(str(node.module))
            assert [alias.name for alias in node.names if not hasattr(module, alias.name)] == []
        for name in own_modules(node):
            assert name == "benchdragon", f"{name}: cells use public names alone"
        if (
            isinstance(node, ast.Attribute)
            and isinstance(node.value, ast.Name)
            and node.value.id == "bd"
        ):
            assert node.attr in {*benchdragon.__all__, "__version__"}
    done = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "--isolated", "--quiet", "--select=F821", "-"],
        input=code, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "")


def test_what_the_village_page_quotes_are_words_of_the_planner() -> None:
    """In both languages the same ones, so that whoever reads finds the buttons."""
    words = chinese(PAGE, WORKER)
    quoted = [
        [" ".join(name.split()) for name in re.findall(pattern, source(language, "village.md"))]
        for language, pattern in (("en", r'"([^"]+)"'), ("zh", "“([^”]+)”"))
    ]
    assert len(quoted[0]) > 30
    assert [name for name in quoted[0] if name not in words] == []
    assert {words[name] for name in quoted[0]} == set(quoted[1])


def test_the_commands_of_each_page_are_run() -> None:
    """By test_examples.py, which takes them from the page of all commands."""
    run = shell_lines(source("en", "commands.md"))
    for page in PAGES:
        if page == "terminal.md":  # a walk-through: tests/test_examples.py runs its commands
            continue
        assert set(shell_lines(source("en", page))) <= set(run), page


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_folder_of_a_sweep_holds_one_sweep(language: str) -> None:
    """A folder that holds another sweep is refused: whoever types all commands would stop there."""
    told: dict[str, set[str]] = {}
    for page in PAGES:
        text = source(language, page)
        for name, folder in re.findall(r'print\(bd.sweep_command\((\w+), "([^"]+)"\)\)', text):
            told.setdefault(folder, set()).add(f"{page}: {name}")
        for line in commands(text):
            if found := re.fullmatch(r"(benchdragon sweep .*) -o (\S+)", line):
                told.setdefault(found[2], set()).add(found[1])
    make = (ROOT / "Makefile").read_text("utf-8")
    for line, folder in re.findall(r"\$\(SWEEP\) (.*) -o \$\(ATLAS\)/(\S+)", make):
        told.setdefault(f"out/atlas/{folder}", set()).add(line)
    assert len(told) > 15
    assert {folder: lines for folder, lines in told.items() if len(lines) > 1} == {}


@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_of_design_and_tests_that_the_manual_names_are_there(language: str) -> None:
    names = [re.findall(r"`((?:design|tests)/[\w/.-]+)`", source(language, page)) for page in PAGES]
    assert sum(map(len, names)) > 20
    assert [name for found in names for name in found if not (ROOT / name).exists()] == []


@pytest.mark.parametrize("page", ["CONTRIBUTING.md", "docs/en/extend.md", "docs/zh/extend.md"])
def test_files_and_tests_that_the_steps_of_an_extension_name_are_there(page: str) -> None:
    names = set(re.findall(r"`([\w/.-]+)`", (ROOT / page).read_text("utf-8")))
    files = [name for name in names if "/" in name or name.endswith((".py", ".pyi"))]
    assert len(files) > 10
    for name in files:
        assert (ROOT / name).exists() or (ROOT / "src" / "benchdragon" / name).exists(), name
    tests = "".join(path.read_text("utf-8") for path in (ROOT / "tests").rglob("*.py"))
    for name in names:
        assert not name.startswith("test_") or f"def {name}(" in tests, name


@pytest.mark.parametrize("page", PAGES)
def test_joining_lines_of_chinese_leaves_code_as_it_is(page: str) -> None:
    """A comment that ends with a Chinese mark would take the next line of code up."""
    text = source("zh", page)
    joined = runpy.run_path(str(ROOT / "docs" / "conf.py"))["SEAMLESS"].sub("", text)
    assert blocks(joined, "{code-cell}") == blocks(text, "{code-cell}")


def test_a_notebook_names_pages_and_listings_and_says_each_output_once() -> None:
    conf = runpy.run_path(str(ROOT / "docs" / "conf.py"))
    text = "(turn)=\n## Turn\n\n[](model.md), [so](#turn), [](#turn): {view}`model.turns:two_arcs`."
    titles = {"model.md": "The model", "#turn": "The turn"}
    said = "## Turn\n\nThe model, so, The turn: `model.turns.two_arcs`."
    assert conf["plain"](text, titles) == said
    assert conf["plain"](text + "\n\n---\n\n{nb-download}`Here <turn.ipynb>`\n", titles) == said
    whole = {"output_type": "stream", "name": "stdout", "text": ["1\n", "2\n"]}
    left = {"output_type": "stream", "name": "stdout", "text": ["2\n"]}
    shown: dict[str, object] = {"output_type": "display_data", "data": {}}
    assert conf["once"]([whole, shown, left, shown]) == [whole, shown, shown]


def test_pictures_of_the_reference_are_of_public_names() -> None:
    reference = runpy.run_path(str(ROOT / "docs" / "reference.py"))
    pictures, same = reference["PICTURES"], reference["SAME"]
    assert {*pictures, *same} <= {*benchdragon.__all__}
    assert set(same.values()) <= set(pictures)
    for code in pictures.values():
        assert isinstance(ast.parse(code).body[-1], ast.Expr), code


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_public_name_stands_in_a_table_of_the_api(language: str) -> None:
    rows = "".join(re.findall(r"^\| `.*? \|", source(language, "api.md"), re.MULTILINE))
    assert set(re.findall(r"`(\w+)`", rows)) == {*benchdragon.__all__}


def built(language: str, folder: Path) -> dict[str, str]:
    """Build a language without a warning; the text of its pages by their names.

    Cells run in English. In Chinese those of the questions do: all others are the same code, see
    `test_both_languages_run_the_same_code_and_lead_to_the_same_places`, and run in `make docs` alone.
    """
    idle = [page for page in PAGES if language != "en" and not page.startswith("question-")]
    untold = ["-D", "suppress_warnings=myst-nb.lexer"] if idle else []  # of cells that do not run
    done = subprocess.run(
        [
            sys.executable, "-m", "sphinx", "--quiet", "--fail-on-warning", "--keep-going",
            "-D", f"language={LANGUAGES[language]}", "-d", str(folder / "trees"),
            "-D", f"idle_pages={' '.join(idle)}",
            *untold, "-c", "docs", f"docs/{language}", str(folder / "html"),
        ],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    paths = sorted((folder / "html").rglob("*.html"))
    return {
        path.relative_to(folder / "html").as_posix(): path.read_text("utf-8")
        for path in paths
        if "_static" not in path.parts
    }


@pytest.mark.manual
@pytest.mark.xdist_group("docs")  # one build after the other: their kernels would race for ports
@pytest.mark.parametrize("language", LANGUAGES)
def test_a_site_is_built_offline_and_whole(language: str, tmp_path: Path) -> None:
    site = built(language, tmp_path)
    assert {page.replace(".md", ".html") for page in PAGES} < set(site)
    assert_nothing_is_fetched(tmp_path / "html", site)
    assert_links_hold(language, tmp_path / "html", site)
    assert_the_smallest_pitch_leads_to_its_test(site)
    assert_every_public_name_is_described(site)
    assert_every_figure_says_what_it_shows(site)
    assert_words_are_found(language, tmp_path / "html")
    assert_a_search_explains_first(language, tmp_path / "html")
    assert_notebooks_stand_alone(tmp_path / "html")


def attributes(page: str, tag: str) -> Iterator[dict[str, str]]:
    """Those of each such tag. Parsers take minutes for all listings, whose code is escaped."""
    for found in re.finditer(rf"<{tag}\b([^>]*)>", page):
        yield {name: unescape(value) for name, value in re.findall(r'([\w-]+)="([^"]*)"', found[1])}


def identifiers(page: str) -> set[str]:
    """The anchors of a page."""
    return {unescape(found) for found in re.findall(r'<[^>]*\sid="([^"]*)"', page)}


def assert_nothing_is_fetched(folder: Path, site: dict[str, str]) -> None:
    """All that pages load lies beside them."""
    for name, page in site.items():
        for kind, attribute in LOADS.items():
            for tag in attributes(page, kind):
                address = tag.get(attribute, "").split("?")[0].split("#")[0]
                assert "//" not in address, (name, address)
                if address and tag.get("rel") not in ("next", "prev"):
                    assert ((folder / name).parent / address).exists(), (name, address)
    for style in folder.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*['\"]?(https?:)?//", style.read_text("utf-8")), style


def links(page: str | Tag) -> Iterator[str]:
    for tag in attributes(str(page), "a"):
        if "href" in tag:
            yield tag["href"]


def target(name: str, link: str) -> tuple[str, str]:
    """The page and the anchor to which a link leads from a page."""
    path, _hash, anchor = link.partition("#")
    parts = name.split("/")[:-1] if path else name.split("/")
    for step in path.split("/") if path else []:
        if step == "..":
            parts = parts[:-1] if parts and parts[-1] != ".." else [*parts, ".."]
        elif step != ".":
            parts.append(step)
    return "/".join(parts), anchor


def assert_links_hold(language: str, folder: Path, site: dict[str, str]) -> None:
    """Each link leads to a page, and to an anchor in it; each page to its twin."""
    other = "zh" if language == "en" else "en"
    anchors = {name: identifiers(page) for name, page in site.items()}
    for name, page in site.items():
        switched = False
        for link in links(page):
            assert ":" not in link.split("#")[0], (name, link)
            path, anchor = target(name, link)
            if path.startswith(f"../{other}/"):
                assert path == f"../{other}/{name}"
                switched = True
                continue
            assert (folder / path).is_file(), (name, link)
            assert not anchor or anchor in anchors[path], (name, link)
        assert switched, name


def parsed_page(site: dict[str, str], name: str) -> BeautifulSoup:
    return BeautifulSoup(site[name], "html.parser")


def section(site: dict[str, str], name: str, anchor: str) -> Tag:
    """The section of a page to which an anchor belongs."""
    found = parsed_page(site, name).find(id=anchor)
    assert found is not None
    whole = found if found.name == "section" else found.find_parent("section")
    assert whole is not None
    return whole


def assert_the_smallest_pitch_leads_to_its_test(site: dict[str, str]) -> None:
    """From the number to the formulas, to the code and to the test, by links alone."""
    question = parsed_page(site, "question-3.html").find("article")
    assert isinstance(question, Tag)
    assert "0.450337393027" in question.get_text()
    step = ("established.html", "smallest-pitch")
    assert step in {target("question-3.html", link) for link in links(question)}
    method = section(site, *step)
    assert method.find("math") is not None
    steps = {target("established.html", link) for link in links(method)}
    listing, test = (
        ("_modules/benchdragon/solve/size.html", "limit"),
        ("evidence.html", "test-smallest-pitch"),
    )
    assert {listing, test} <= steps
    code = parsed_page(site, listing[0]).find(id=listing[1])
    assert code is not None
    assert "def limit(" in code.get_text()
    evidence = section(site, *test).get_text()
    assert "def test_the_smallest_pitch_is_the_true_one(" in evidence
    assert "SMALLEST_PITCH = 0.450337393027" in evidence


def assert_every_public_name_is_described(site: dict[str, str]) -> None:
    """Each on a page of its own, with its example; kernels apart from them."""
    tables = {target("api.html", link)[0] for link in links(site["api.html"])}
    for name in benchdragon.__all__:
        page = f"reference/{name}.html"
        assert f"benchdragon.{name}" in identifiers(site[page]), name
        assert page in tables, name
        assert "&gt;&gt;&gt;" in site[page] or name == "Status", name
    assert not any("kernels." in name for name in identifiers(site["api.html"]))


def assert_words_are_found(language: str, folder: Path) -> None:
    """The index holds words of the language, and the browser has the stemmer that it is told to use."""
    words = {"en": ("pitch", "clearanc"), "zh": ("螺距", "最小螺距", "pitch")}[language]
    index = (folder / "searchindex.js").read_text("utf-8")
    terms = json.loads(index.removeprefix("Search.setIndex(").removesuffix(")"))["terms"]
    for word in words:
        assert word in terms
    script = (folder / "_static" / "language_data.js").read_text("utf-8")
    stemmer = re.search(r"window\.Stemmer = (\w+);", script)
    assert stemmer is not None
    assert f"{stemmer[1]}=function" in script


def assert_a_search_explains_first(language: str, folder: Path) -> None:
    """The question about pitches comes before the attributes and arguments that are called so."""
    word = {"en": "pitch", "zh": "螺距"}[language]
    path = browser_path()
    assert path is not None, "the manual's tests need a Chromium: apt-get install chromium"
    with (
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=path, args=FLAGS) as browser,
    ):
        page = browser.new_page()
        page.goto(f"{(folder / 'search.html').as_uri()}?q={word}")
        page.wait_for_selector("#search-results li a")
        first = page.locator("#search-results li a").first.get_attribute("href")
    assert str(first).startswith("question-3.html"), first


def assert_notebooks_stand_alone(folder: Path) -> None:
    """No link to a page of the site, which is not beside a notebook that was downloaded."""
    notebooks = sorted((folder / "_downloads").rglob("*.ipynb"))
    assert len(notebooks) > 10
    for path in notebooks:
        cells = json.loads(path.read_text("utf-8"))["cells"]
        text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
        assert not re.search(r"\]\((#|[\w-]+\.md)|{view}|{nb-download}", text), path


def assert_every_figure_says_what_it_shows(site: dict[str, str]) -> None:
    for number in range(1, 6):
        article = parsed_page(site, f"question-{number}.html").find("article")
        assert isinstance(article, Tag)
        figures = article.find_all("img")
        assert figures
        assert all(len(str(figure.get("alt"))) > 5 for figure in figures)
