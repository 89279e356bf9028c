"""Hosts of the kernels' entries: a native library, engine.wasm by Wasmtime, or plain Python."""
