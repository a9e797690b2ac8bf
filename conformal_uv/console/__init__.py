"""What commands share: progress on a terminal, tables of numbers, plain text, Ctrl-C. The package's own and others'."""
