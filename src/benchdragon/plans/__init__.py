"""Plan files: their keys, how they are read and checked, and the built-in ones."""
