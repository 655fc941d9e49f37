"""How the program of a service is called."""

from __future__ import annotations

from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.supervision.system_file import ServiceEntry, System


def command_line(system: System, entry: ServiceEntry, layout: Layout, url: LcmUrl) -> list[str]:
    """Full path of the program and its arguments; raises UserError when it is not there."""
    command = [str(layout.program(entry.program)), "--lcm-url", str(url)]
    if system.channel_prefix:
        command += ["--channel-prefix", system.channel_prefix]
    if entry.instance:
        command += ["--instance", entry.instance]
    if entry.config:
        command += ["--config", str(layout.config_file(entry.config, system.path.parent))]
    for key, value in entry.settings.items():
        command += ["--set", f"{key}={value}"]
    return [*command, *entry.args]
