"""The former place of ``bezier.input.task``."""

from bezier.input.task import Axis, Task, task

__all__ = ["Axis", "Task", "task"]
