"""From LLVM's language to machine code: one module, of which only the shims are seen from outside."""

import itertools
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm

# What the code may call: engine/runtime.c, and what every C library has.
RUNTIME = Path(__file__).with_name("runtime.c")
LIBRARY = """
    acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh exp expm1 fabs floor fma fmod
    hypot log log10 log1p log2 memcpy memmove memset pow round sin sinh sqrt tan tanh trunc
"""
OFFERED = re.compile(r"^HIDDEN .*?(\w+)\(", re.MULTILINE)
# An entry in C's convention.
SHIM = """
define i32 @{symbol}(ptr %block) {{
  %found = alloca ptr
  %trouble = alloca ptr
  %address = ptrtoint ptr %block to i64
  %code = call i32 @{inner}(ptr %found, ptr %trouble, i64 %address)
  ret i32 %code
}}
declare i32 @{inner}(ptr, ptr, i64)
"""
TARGET = re.compile(r"^target (?:triple|datalayout) = .*", re.MULTILINE)
ATTRIBUTES = re.compile(r'"(target-cpu|target-features|tune-cpu|probe-stack)"="[^"]*"')
# How numba's code finds the data of a block of memory: by its fourth field, not yet by an offset.
READER = "NRT_MemInfo_data_fast"
MEMORY = re.compile(
    r"getelementptr \{ i64, ptr, ptr, ptr, i64 \}, ptr %[\w.]+, i32 0, i32 3$", re.MULTILINE
)
# An address of the process that compiled would be a number turned into a pointer, or one of these.
ADDRESSES = re.compile(r"inttoptr \(i\d+ -?\d+ to|numba\.dynamic\.globals")
# Modules that are linked by themselves before all groups are: for each, LLVM looks through all of the
# module to which it links.
GROUP = 32


class BuildError(Exception):
    """The library could not be built."""


def prepare() -> None:
    """Let LLVM know all kinds of processors."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()


def linked(modules: Iterable[Any], head: str) -> Any:
    """One module of several."""
    whole = llvm.parse_assembly(head)
    for module in modules:
        whole.link_in(module)
    return whole


def joined(texts: Sequence[str], machine: Any, symbols: set[str]) -> Any:
    """One module of many, for a machine; only the functions named in `symbols` are seen from outside.

    Raises:
        BuildError: if the code looks for arrays elsewhere than engine/runtime.c puts them.
    """
    head = f'target triple = "{machine.triple}"\ntarget datalayout = "{machine.target_data}"\n'
    modules = (llvm.parse_assembly(head + ATTRIBUTES.sub("", TARGET.sub("", text))) for text in texts)
    groups = range(0, len(texts), GROUP)
    whole = linked([linked(itertools.islice(modules, GROUP), head) for _first in groups], head)
    whole.name = "kernels"
    for value in (*whole.functions, *whole.global_variables):
        if value.name == READER and not MEMORY.search(str(value)):
            raise BuildError("numba's blocks of memory are no longer those of engine/runtime.c")
        if not value.is_declaration and value.name not in symbols:
            value.linkage = "internal"
    return whole


def target_machine(processor: str) -> Any:
    """Code for this machine's system and a level of its processor."""
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=processor if processor.startswith("x86-64") else "", opt=3, reloc="pic", codemodel="default"
    )


def optimise(module: Any, machine: Any) -> None:
    """Two rounds: once calls are inlined, counts of references are dropped, and loops become SIMD."""
    for last in (False, True):
        tuning = llvm.create_pipeline_tuning_options(3)
        tuning.loop_vectorization, tuning.slp_vectorization = last, False
        builder = llvm.create_pass_builder(machine, tuning)
        builder.getModulePassManager().run(module, builder)
        if not last:
            passes = llvm.create_new_module_pass_manager()
            passes.add_refprune_pass()
            passes.run(module, builder)
    module.verify()


def check(module: Any) -> None:
    """Refuse code that works in this process alone.

    Raises:
        BuildError: if it holds an address of this process, or calls what no C library has.
    """
    found = ADDRESSES.search(str(module))
    if found:
        raise BuildError(f"the code holds an address of the process that compiled it: {found[0]}")
    names = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    own = set(OFFERED.findall(RUNTIME.read_text("utf-8")))
    strange = sorted(names - own - set(LIBRARY.split()))
    if strange:
        raise BuildError(f"the code calls what no C library has: {', '.join(strange)}")
