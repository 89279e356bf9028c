"""Builds the kernels ahead of time: `python -m benchdragon.engine`, with `--wasm` for browsers."""
