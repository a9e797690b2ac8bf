"""Thousands of mesh files mapped side by side, in processes of this machine or on a cluster."""

from .plan import Plan
from .row import BatchRow, Outcome
from .run import batch, batch_tasks, run_batch

__all__ = ["BatchRow", "Outcome", "Plan", "batch", "batch_tasks", "run_batch"]
