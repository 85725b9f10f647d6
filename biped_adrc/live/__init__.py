"""A walk under one's own hand: moved on sample by sample, pushed and changed on the way, and repeated."""
