"""More than one publisher on a channel, by all that can be known of it."""

from __future__ import annotations

from deixis_frontend.listening.traffic import Channel
from deixis_frontend.listening.udp_senders import Address, Senders, process_names


class PublisherNames:
    """Names publishers: services by their status, others by the process that sends."""

    def __init__(self, senders: Senders) -> None:
        self._senders = senders
        addresses = {address for heard in senders.by_channel.values() for address in heard}
        self._processes = process_names(sorted(addresses))

    def of(self, channel: Channel) -> list[str]:
        """Services that say so; when none does, the senders."""
        heard = self._senders.by_channel.get(channel.name, {})
        return channel.publishers or [self._name(address) for address in heard]

    def several(self, channel: Channel) -> str:
        """In words, when several publish on a channel that is made for one; else empty."""
        if channel.is_for_all:
            return ""
        at_once = self._senders.at_once(channel.name)
        if len(at_once) > 1:
            return (f"{len(at_once)} publishers at once:"
                    f" {', '.join(self._name(address) for address in at_once)}")
        if len(channel.publishers) > 1:
            return f"{len(channel.publishers)} services publish: {', '.join(channel.publishers)}"
        if channel.is_interleaved:
            return "several publishers: sequence numbers alternate"
        return ""

    def _name(self, address: Address) -> str:
        place = f"{address[0]}:{address[1]}"
        process = self._processes.get(address)
        return f"{process} ({place})" if process else place
