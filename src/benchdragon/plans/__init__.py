"""A dance as a file: its keys, how it is read, what is wrong with it, the built-in ones."""
