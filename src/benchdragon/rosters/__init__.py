"""Who carries which bench: lists of names as villages keep them."""
