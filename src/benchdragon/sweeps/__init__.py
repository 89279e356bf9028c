"""Sweeps: questions about one plan at many points, their answers, and refinement."""
