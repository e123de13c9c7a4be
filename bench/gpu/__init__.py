"""What a GPU draws, how right and how fast, in five minutes: ``python -m bench.gpu``, or ``make gpu``."""
