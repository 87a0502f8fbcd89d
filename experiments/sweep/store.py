"""The file of a sweep: one line of JSON per problem as it comes, and the same as a Parquet table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from experiments.results import Appender, BadLine, read_records
from experiments.sweep.solve import Outcome


class Store:
    """``outcomes`` holds what the file holds; a problem is written once."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.path = folder, folder / "sweep.jsonl"
        self.outcomes: dict[str, Outcome] = {}
        self.bad: list[BadLine] = read_records(self.path, self._remember)
        self._file = Appender(self.path)

    def _remember(self, record: Mapping[str, Any]) -> None:
        row = Outcome(**record)
        self.outcomes[row.key] = row

    def add(self, record: Mapping[str, Any]) -> Outcome:
        """Write an outcome, unless the file has one for its problem."""
        if record["key"] not in self.outcomes:
            self._file.write(record)
            self._remember(record)
        return self.outcomes[record["key"]]

    def write_parquet(self) -> Path:
        """``sweep.parquet`` with everything so far."""
        from pyarrow import Table, parquet

        path = self.folder / "sweep.parquet"
        parquet.write_table(Table.from_pylist([asdict(row) for row in self.outcomes.values()]), path)
        return path
