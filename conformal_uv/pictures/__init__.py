"""Pictures of maps: three panels by matplotlib, thumbnails by numpy."""
