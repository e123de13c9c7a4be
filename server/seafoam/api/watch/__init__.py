"""What an operator sees: logs, metrics, traces, and the memory of processes."""
