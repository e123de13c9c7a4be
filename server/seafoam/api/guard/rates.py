"""Rates of requests by client: a token bucket each, as the generic cell rate algorithm, which keeps one number of each.

The library ``limits`` (5.8) has windows but no bucket, keeps as many clients as there are, and runs a thread to forget
them; here the least recent go first.
"""

import math
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from ipaddress import IPv6Address, ip_address

CLIENTS_KEPT = 65_536
"""Clients whose buckets are remembered, 16 MB; one that is forgotten has a full bucket again."""
IPV6_PREFIX = 64
"""Leading bits of an IPv6 address that count: what one subscriber has at least."""
POLICY = "api"


@dataclass(frozen=True, slots=True)
class Standing:
    """A client's bucket after a request: whether it is allowed, requests left, and seconds until the next or all."""

    allowed: bool
    left: int
    seconds: int


class TokenBuckets:
    """Buckets of ``burst`` tokens that refill with ``rate`` tokens a second; a request takes one.

    clients: number of buckets kept. clock: seconds that never go back.
    """

    def __init__(
        self, rate: float, burst: int, *, clients: int = CLIENTS_KEPT, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.rate = rate
        self.burst = burst
        self._clients = clients
        self._clock = clock
        self._full_at: OrderedDict[str, float] = OrderedDict()

    @property
    def policy(self) -> str:
        """Value of ``RateLimit-Policy``: the tokens of a bucket, and the seconds in which it refills."""
        return f'"{POLICY}";q={self.burst};w={math.ceil(self.burst / self.rate)}'

    def take(self, client: str) -> Standing:
        """Take a token of a client."""
        now = self._clock()
        full_at = max(self._full_at.get(client, now), now)
        tokens = self.burst - (full_at - now) * self.rate
        # The sums of many requests round.
        if tokens < 1.0 - 1e-6:
            return Standing(False, 0, math.ceil((1.0 - tokens) / self.rate))
        self._full_at[client] = full_at + 1.0 / self.rate
        self._full_at.move_to_end(client)
        if len(self._full_at) > self._clients:
            self._full_at.popitem(last=False)
        return Standing(True, int(tokens - 1.0 + 1e-6), math.ceil(full_at + 1.0 / self.rate - now))


def limit_of(standing: Standing) -> str:
    """Return the value of ``RateLimit`` (draft-ietf-httpapi-ratelimit-headers-10)."""
    return f'"{POLICY}";r={standing.left};t={standing.seconds}'


def bucket_of(address: str) -> str:
    """Return the name of an address's bucket: the address, or the network of an IPv6 address."""
    try:
        parsed = ip_address(address)
    except ValueError:
        return address
    if isinstance(parsed, IPv6Address):
        if parsed.ipv4_mapped is not None:
            return str(parsed.ipv4_mapped)
        return str(IPv6Address(int(parsed) >> (128 - IPV6_PREFIX) << (128 - IPV6_PREFIX)))
    return str(parsed)
