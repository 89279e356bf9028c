"""Entries by hand, as C and as WebAssembly, which the tests of both hosts call."""

import ctypes
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import wasmtime

from benchdragon.engine.build import c_compiler
from benchdragon.hosts import native
from benchdragon.hosts.wasm import Host
from benchdragon.kernels.arrays import IntVector, Table, Vector
from benchdragon.kernels.status import Status

# Makes the function to call of an entry's own.
Binder = Callable[[Any], Any]

# The slots of `scale`: table 0..2, factor 3, limit 4, which 5..6, out 7..8, and the three results.
C = """
#include <stdint.h>
int32_t bd_modules_scale(int64_t *b) {
    double *table = (double *)b[0], factor = *(double *)(b + 3), *out = (double *)b[7], sum = 0.0;
    int64_t count = b[4], *which = (int64_t *)b[5];
    if (count < 0) return 3;
    for (int64_t n = 0; n < b[6]; n++) {
        out[n] = factor * table[which[n] * b[2]];
        sum += out[n];
    }
    *(double *)(b + 9) = sum;
    b[10] = count;
    b[11] = b[6] == b[8];
    return 0;
}
int32_t bd_modules_follow(int64_t *b) {
    for (int64_t n = 0; n < b[1]; n++) ((double *)b[0])[n] = ((double *)b[2])[n] + 1.0;
    return 0;
}
int32_t bd_modules_half(int64_t *b) {
    *(double *)(b + 1) = 0.5 * *(double *)b;
    return 0;
}
int32_t bd_modules_named(int64_t *b) {
    return bd_modules_half(b);
}
"""
# The same; memory is given out in turn, and `live` says how much of it was not given back. `spin`
# counts down from a number, `wreck` breaks off.
WASM = """
(module
  (memory (export "memory") 1)
  (global $top (mut i32) (i32.const 64))
  (global $live (export "live") (mut i32) (i32.const 0))
  (func (export "_initialize"))
  (func (export "malloc") (param $size i32) (result i32)
    (local $at i32)
    (local.set $at (global.get $top))
    (global.set $top (i32.and (i32.add (i32.add (local.get $at) (local.get $size)) (i32.const 15))
      (i32.const -16)))
    (if (i32.eq (i32.const -1) (memory.grow (i32.shr_u (local.get $size) (i32.const 16))))
      (then (global.set $top (local.get $at)) (return (i32.const 0))))
    (drop (memory.grow (i32.const 1)))
    (global.set $live (i32.add (global.get $live) (i32.const 1)))
    (local.get $at))
  (func (export "free") (param i32) (global.set $live (i32.sub (global.get $live) (i32.const 1))))
  (func $place (param $b i32) (param $slot i32) (param $n i32) (result i32)
    (i32.add
      (i32.wrap_i64 (i64.load (i32.add (local.get $b) (i32.mul (i32.const 8) (local.get $slot)))))
      (i32.mul (i32.const 8) (local.get $n))))
  (func (export "bd_modules_scale") (param $b i32) (result i32)
    (local $n i32) (local $row i64) (local $value f64) (local $sum f64)
    (if (i64.lt_s (i64.load offset=32 (local.get $b)) (i64.const 0)) (then (return (i32.const 3))))
    (block $done (loop $next
      (br_if $done (i64.ge_s (i64.extend_i32_u (local.get $n)) (i64.load offset=48 (local.get $b))))
      (local.set $row (i64.load (call $place (local.get $b) (i32.const 5) (local.get $n))))
      (local.set $value (f64.mul (f64.load offset=24 (local.get $b)) (f64.load (call $place
        (local.get $b) (i32.const 0)
        (i32.wrap_i64 (i64.mul (local.get $row) (i64.load offset=16 (local.get $b))))))))
      (f64.store (call $place (local.get $b) (i32.const 7) (local.get $n)) (local.get $value))
      (local.set $sum (f64.add (local.get $sum) (local.get $value)))
      (local.set $n (i32.add (local.get $n) (i32.const 1)))
      (br $next)))
    (f64.store offset=72 (local.get $b) (local.get $sum))
    (i64.store offset=80 (local.get $b) (i64.load offset=32 (local.get $b)))
    (i64.store offset=88 (local.get $b) (i64.extend_i32_u (i64.eq
      (i64.load offset=48 (local.get $b)) (i64.load offset=64 (local.get $b)))))
    (i32.const 0))
  (func (export "bd_modules_follow") (param $b i32) (result i32)
    (local $n i32)
    (block $done (loop $next
      (br_if $done (i64.ge_s (i64.extend_i32_u (local.get $n)) (i64.load offset=8 (local.get $b))))
      (f64.store (call $place (local.get $b) (i32.const 0) (local.get $n)) (f64.add (f64.const 1)
        (f64.load (call $place (local.get $b) (i32.const 2) (local.get $n)))))
      (local.set $n (i32.add (local.get $n) (i32.const 1)))
      (br $next)))
    (i32.const 0))
  (func $half (export "bd_modules_half") (param $b i32) (result i32)
    (f64.store offset=8 (local.get $b) (f64.mul (f64.const 0.5) (f64.load (local.get $b))))
    (i32.const 0))
  (func (export "bd_modules_named") (param $b i32) (result i32) (call $half (local.get $b)))
  (func (export "bd_modules_wreck") (param $b i32) (result i32) (unreachable))
  (func (export "bd_modules_spin") (param $b i32) (result i32)
    (local $n i64)
    (local.set $n (i64.load (local.get $b)))
    (loop $next
      (local.set $n (i64.sub (local.get $n) (i64.const 1)))
      (br_if $next (i64.gt_s (local.get $n) (i64.const 0))))
    (i32.const 0)))
"""


class Choice(NamedTuple):
    """Arguments that belong together."""

    limit: int
    which: IntVector


class Halves(NamedTuple):
    """A result that has a name for each of its numbers."""

    half: float


def scale(table: Table, factor: float, choice: Choice, out: Vector) -> tuple[float, Status, bool]:
    raise AssertionError("another serves")


def follow(out: Vector, before: Vector) -> None:
    raise AssertionError("another serves")


def half(x: float) -> float:
    raise AssertionError("another serves")


def named(x: float) -> Halves:
    raise AssertionError("another serves")


def wreck(x: float) -> None:
    raise AssertionError("another serves")


def spin(count: int) -> None:
    raise AssertionError("another serves")


def library(folder: Path) -> Binder:
    """Binds the entries of a library that is made in a folder."""
    (folder / "test.c").write_text(C, encoding="utf-8")
    made = str(folder / "test.so")
    subprocess.run([c_compiler(), "-shared", "-fPIC", "-o", made, str(folder / "test.c")], check=True)
    loaded = ctypes.CDLL(made)
    return lambda function: native.bound(function, loaded)


def code() -> bytes:
    """The module."""
    return bytes(wasmtime.wat2wasm(WASM))


def host() -> Host:
    """The module's host."""
    return Host(code())
