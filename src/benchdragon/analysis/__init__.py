"""What a walk does: distances, contact, speeds, and whether it is safe."""
