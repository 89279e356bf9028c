"""How to cite: a valid CITATION.cff that names the paper and the contest, as both readmes do."""

from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

import benchdragon
from benchdragon.paper import claims

ROOT = Path(__file__).parent.parent
# Of the schema of the Citation File Format 1.2.0, what the file uses.
TEXT = {"type": "string", "minLength": 1}
PERSON = {
    "type": "object",
    "properties": {"family-names": TEXT, "given-names": TEXT, "affiliation": TEXT},
    "required": ["family-names"],
    "additionalProperties": False,
}
ENTITY = {
    "type": "object", "properties": {"name": TEXT}, "required": ["name"], "additionalProperties": False,
}  # fmt: skip
AUTHORS = {"type": "array", "minItems": 1, "items": {"anyOf": [PERSON, ENTITY]}}
REFERENCE = {
    "type": "object",
    "properties": {
        "type": {"enum": ["article", "generic"]},
        "title": TEXT,
        "authors": AUTHORS,
        "notes": TEXT,
        "year": {"type": "integer"},
    },
    "required": ["authors", "title", "type"],
    "additionalProperties": False,
}
SCHEMA = {
    "type": "object",
    "properties": {
        "cff-version": {"const": "1.2.0"},
        "message": TEXT,
        "title": TEXT,
        "abstract": TEXT,
        "type": {"enum": ["software", "dataset"]},
        "authors": AUTHORS,
        "version": TEXT,
        "license": TEXT,
        "references": {"type": "array", "minItems": 1, "items": REFERENCE},
    },
    "required": ["authors", "cff-version", "message", "title"],
    "additionalProperties": False,
}


@pytest.fixture
def citation() -> dict[str, Any]:
    """What CITATION.cff holds."""
    found: dict[str, Any] = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    return found


def test_the_file_is_valid_and_of_this_version(citation: dict[str, Any]) -> None:
    jsonschema.validate(citation, SCHEMA)
    assert citation["version"] == benchdragon.__version__


def test_paper_and_contest_are_named_there_and_in_both_readmes(citation: dict[str, Any]) -> None:
    paper, contest = citation["references"]
    names = [author["family-names"] for author in paper["authors"]]
    assert names == ["Nie", "Zhao"]
    assert paper["title"] in " ".join((claims.__doc__ or "").split())
    assert contest["title"].startswith("CUMCM 2024")
    for name in ("README.md", "README.zh-CN.md"):
        readme = " ".join((ROOT / name).read_text("utf-8").split())
        assert paper["title"] in readme
        assert "CUMCM 2024" in readme
        assert (
            f"{citation['authors'][0]['name']}: benchdragon, version {citation['version']}." in readme
        )
