"""Files of models and skeletons, one format a file."""
