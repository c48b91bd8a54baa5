"""What bark and leaves look like: colours and textures that the project makes."""
