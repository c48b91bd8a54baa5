"""Task adapt: the ranges of a foreign generator are proposed, tried and told; one idea a file."""
