"""Time, memory and quality of disk and sphere maps, side by side with their limit and with other programs."""
