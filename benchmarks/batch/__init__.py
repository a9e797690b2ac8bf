"""Batches of thousands of meshes: the same maps as one after the other, how much sooner, and in what memory."""
