"""Tables, pictures and films as files."""
