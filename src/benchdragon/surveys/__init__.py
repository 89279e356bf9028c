"""Drawn or surveyed lines: read from files, moved near the dance, made into routes."""
