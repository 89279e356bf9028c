"""Tables, pictures, films and documents as files."""
