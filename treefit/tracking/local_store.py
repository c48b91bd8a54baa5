"""LocalStore: an mlflow database on this machine, at a place that does not depend on the current folder."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class LocalStore:
    """Database file (absolute); its lock and mlartifacts/ lie beside it."""

    database: Path

    @property
    def uri(self) -> str:
        """Address of the database for mlflow."""
        return f"sqlite:///{self.database.as_posix()}"

    @property
    def artifacts(self) -> str:
        """Address under which files are kept."""
        return (self.database.parent / "mlartifacts").as_uri()

    @property
    def lock(self) -> Path:
        """File that processes lock while the database is made: mlflow fails when several make it at once."""
        return self.database.with_name(f"{self.database.name}.lock")

    @property
    def command(self) -> str:
        """Shell command that serves the pages of this store."""
        return f"mlflow ui --workers 1 --backend-store-uri {shlex.quote(self.uri)}"


def find_store(uri: str | None) -> LocalStore | str:
    """Return the local store that `uri` means, None being outputs/mlflow.db, or `uri` itself when it is a server's."""
    if uri is None:
        return LocalStore(Path("outputs", "mlflow.db").resolve())
    if uri.startswith("sqlite:///"):
        return LocalStore(Path(uri.removeprefix("sqlite:///")).resolve())
    if uri.startswith(("http://", "https://")):
        return uri
    raise ValueError(f"tracking.uri: must be like http://host:5000 or sqlite:////folder/mlflow.db, got {uri!r}")
