"""Request ids, and the log as text or as lines of JSON."""

import json
import logging
import re
from contextvars import ContextVar
from datetime import UTC, datetime
from http import HTTPStatus
from typing import Any, Literal

from seafoam.api.frames.streams import is_frame

REQUEST_ID = "X-Request-ID"
PROBES = ("/healthz", "/readyz", "/metrics")
"""Paths of requests that arrive every few seconds, and are not logged; neither are frames of streams, if answered."""
SANE = re.compile(r"[A-Za-z0-9][A-Za-z0-9._:-]{0,127}")
"""An id that can stand in a header, a log and a shell."""

request_id: ContextVar[str | None] = ContextVar("request_id", default=None)
"""Id of the request that is being answered."""

log = logging.getLogger(__name__)


class JsonLines(logging.Formatter):
    """A log record as one line of JSON: time (ISO 8601, UTC), level, logger, message, request_id, and its fields."""

    def format(self, record: logging.LogRecord) -> str:
        line: dict[str, Any] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if identity := request_id.get():
            line["request_id"] = identity
        line |= getattr(record, "fields", {})
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False)


def configure(form: Literal["text", "json"]) -> dict[str, Any]:
    """Set up the process's log, on stderr, and return the options with which uvicorn joins in."""
    if form == "text":
        logging.basicConfig(level=logging.INFO, format="%(levelname)s: %(message)s")
        logging.getLogger("uvicorn.access").addFilter(not_a_probe)
        return {}
    handler = logging.StreamHandler()
    handler.setFormatter(JsonLines())
    logging.basicConfig(level=logging.INFO, handlers=[handler])
    return {"log_config": None, "access_log": False}


def not_a_probe(record: logging.LogRecord) -> bool:
    """Keep probes and frames of streams out of uvicorn's access log."""
    match record.args:
        case (_, _, str(path), _, int(status)):
            return not too_many(path, status)
    return True


def too_many(path: str, status: int) -> bool:
    return path.startswith(PROBES) or (is_frame(path) and status < HTTPStatus.BAD_REQUEST)
