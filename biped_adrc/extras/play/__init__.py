"""A walk in the browser under one's own hand: a page that needs neither server nor network."""
