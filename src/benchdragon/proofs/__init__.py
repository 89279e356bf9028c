"""Proofs of answers about a walk in ball arithmetic, cell by cell, by code that no search uses."""

# Of ball arithmetic: some 38 digits, of which chains of 3500 handles keep more than 25.
BITS = 128
# Cells of one proof.
MOST_CELLS = 1_000_000
