"""Pages that show trees in a browser, without a network."""
