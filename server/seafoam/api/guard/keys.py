"""Who may use the API: clients with a key, and links that its owner has signed, after imgproxy's scheme.

A key is sent as ``Authorization: Bearer KEY`` (RFC 6750), or as the password of ``Authorization: Basic`` (RFC 7617),
which browsers ask their user for, so the page works with keys too. A signed link is
``/signed/{signature}{path}?{query}``: the signature is the HMAC-SHA256 of salt, path and query as they are sent,
in URL-safe Base64 without padding (https://docs.imgproxy.net/usage/signing_url).
"""

import base64
import binascii
import hashlib
import hmac
import re
from collections.abc import Mapping
from dataclasses import dataclass

from starlette.datastructures import Headers

SHORTEST_KEY = 16
"""Characters of an API key, and bytes of a signing key: 128 bits where they are random bytes."""
SIGNED = "/signed/"
API = "/api/"
CHALLENGE = 'Basic realm="seafoam", charset="UTF-8", Bearer realm="seafoam"'
_NAMED_KEY = re.compile(rf"(?P<name>[A-Za-z0-9_.-]{{1,64}}):(?P<key>[!-+\--~]{{{SHORTEST_KEY},256}})")


def api_keys_of(text: str) -> dict[str, bytes]:
    """Return the SHA-256 of each key by its name. text: ``name:key,name:key``, or empty.

    Raises :class:`ValueError`, which quotes no key, for another form, a short key, or a name or key given twice.
    """
    digests: dict[str, bytes] = {}
    for position, part in enumerate(filter(None, (each.strip() for each in text.split(","))), 1):
        found = _NAMED_KEY.fullmatch(part)
        if found is None:
            raise ValueError(f"key {position} is not name:key with {SHORTEST_KEY} to 256 printable characters")
        digest = _digest(found["key"])
        if found["name"] in digests or digest in digests.values():
            raise ValueError(f"key {position} has the name or the text of an earlier one")
        digests[found["name"]] = digest
    return digests


@dataclass(frozen=True, slots=True)
class Signing:
    """Key and salt of signed links."""

    key: bytes
    salt: bytes

    @classmethod
    def of(cls, key: str, salt: str) -> "Signing | None":
        """Return key and salt from hexadecimal digits, None where both are empty; raises :class:`ValueError`."""
        if not key and not salt:
            return None
        try:
            signing = cls(bytes.fromhex(key), bytes.fromhex(salt))
        except ValueError:
            raise ValueError("signing_key and signing_salt must be hexadecimal digits, two for each byte") from None
        if len(signing.key) < SHORTEST_KEY or not signing.salt:
            raise ValueError(f"signing_key must have {SHORTEST_KEY} bytes or more, and signing_salt one")
        return signing

    def signature(self, address: bytes) -> str:
        """Return the signature of path and query, as they are sent."""
        digest = hmac.digest(self.key, self.salt + address, "sha256")
        return base64.urlsafe_b64encode(digest).rstrip(b"=").decode()

    def link(self, address: str) -> str:
        """Return the signed link of a path of the API with its query; raises :class:`ValueError` for another path."""
        if not address.startswith(API) or not address.isascii() or not address.isprintable() or "#" in address:
            raise ValueError(f"a signed address must begin with {API}, in percent-encoded ASCII, not {address!r}")
        return f"{SIGNED}{self.signature(address.encode())}{address}"

    def holds(self, signature: str, address: bytes) -> bool:
        """Whether a signature is that of path and query, in a time that does not depend on where they differ."""
        return hmac.compare_digest(self.signature(address).encode(), signature.encode("utf-8", "replace"))


@dataclass(frozen=True, slots=True)
class Access:
    """Digests of the API's keys by their names, and key and salt of signed links. Neither: the API is open."""

    keys: Mapping[str, bytes]
    signing: Signing | None

    @property
    def restricted(self) -> bool:
        """Whether requests to the API need a key or a signature."""
        return bool(self.keys) or self.signing is not None

    def name_of(self, headers: Headers) -> str | None:
        """Return the name of the key that a request carries, or None."""
        sent = _sent_key(headers.get("authorization", ""))
        if sent is None:
            return None
        digest = _digest(sent)
        # All of them are compared, so that the time says nothing of which one it is.
        matching = [name for name, known in self.keys.items() if hmac.compare_digest(known, digest)]
        return matching[0] if matching else None


def _sent_key(authorization: str) -> str | None:
    scheme, _, value = authorization.partition(" ")
    match scheme.lower():
        case "bearer":
            return value.strip()
        case "basic":
            try:
                return base64.b64decode(value, validate=True).decode().partition(":")[2]
            except (binascii.Error, UnicodeDecodeError):
                return None
    return None


def _digest(key: str) -> bytes:
    return hashlib.sha256(key.encode("utf-8", "replace")).digest()
