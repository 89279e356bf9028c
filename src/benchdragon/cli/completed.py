"""What a shell completes: names of plans, and keys of plans."""

from pathlib import Path

import click
from click.shell_completion import CompletionItem

from benchdragon.plans.toml import SUFFIX, built_in_names

Items = list[CompletionItem[str]]


def plans(_context: click.Context, _parameter: click.Parameter, begun: str) -> Items:
    """The plans whose names begin so: built-in ones, and files of the folder that is begun."""
    folder = Path(begun) if begun.endswith("/") else Path(begun).parent
    files = [str(path) for path in sorted(folder.glob(f"*{SUFFIX}"))]
    names = [name for name in (*built_in_names(), *files) if name.startswith(begun)]
    return [CompletionItem(name) for name in names] or [CompletionItem(begun, type="file")]


def keys(_context: click.Context, _parameter: click.Parameter, begun: str) -> Items:
    """The keys of plans that begin so, each with the sign before its value."""
    from benchdragon.plans.faults import single_keys
    from benchdragon.plans.schema import Plan

    return [CompletionItem(f"{key}=") for key in single_keys(Plan) if key.startswith(begun)]
