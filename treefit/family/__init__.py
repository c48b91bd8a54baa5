"""What is known of a generator before a search: statistics of its family of objective functions, and guesses."""
