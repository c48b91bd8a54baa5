"""Pictures of models and the sheets that they stand on."""
