"""What stands on the toolkit and nothing of it needs: each part imports what is below, and no other part."""
