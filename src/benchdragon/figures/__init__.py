"""Pictures of walks and of what was found about them."""
