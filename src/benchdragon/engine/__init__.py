"""Builds the kernels ahead of time into one native library: `python -m benchdragon.engine`."""
