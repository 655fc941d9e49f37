"""systemd units that start a system with the machine.

One unit for the supervisor, not one per service: the supervisor knows when a service is ready (its
first SERVICE_STATUS), starts in that order and brings back what crashed; systemd would see
processes only, and `deixis status`, `log` and `restart` would find nothing. What the services write
goes to the journal as well. There is no WatchdogSec: nothing here would feed it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from deixis_frontend.lcm_url import GROUP, RECEIVE_BUFFER_BYTES, LcmUrl
from deixis_frontend.supervision.system_file import System

MARK = "# Written by `deixis install-units`, which replaces it. Your changes: systemctl edit"
_EXTRA_S = 30.0  # on top of the time limits of the services

_HARDENED = """\
# Cameras are devices of the group video; PrivateDevices would hide them.
SupplementaryGroups=video
# PrivateTmp would hide the socket that `deixis status` speaks to, ProtectHome a checkout in a home.
ProtectSystem=full
ProtectKernelModules=yes
ProtectKernelTunables=yes
ProtectControlGroups=yes
RestrictNamespaces=yes
RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6 AF_NETLINK
"""


@dataclass(frozen=True)
class Installation:
    """What the units are about."""

    system: System
    names: tuple[str, ...]  # groups and services to start; none = those of the system file
    launcher: Path  # `deixis`
    url: LcmUrl
    environment: dict[str, str]  # besides the bus
    environment_file: Path
    run_as: str | None  # the user; None = units of the user's own systemd

    @property
    def unit(self) -> str:
        """Name of the unit of the supervisor."""
        name = self.system.name
        return "deixis.service" if name == "deixis" else f"deixis-{name}.service"

    @property
    def bus_unit(self) -> str:
        """Name of the unit that sets up the kernel."""
        return "deixis-bus-setup.service"

    @property
    def leaves_host(self) -> bool:
        """Whether messages go to other hosts, too."""
        return self.url.provider != "udpm" or dict(self.url.parameters).get("ttl", "0") != "0"


def supervisor_unit(installation: Installation) -> str:
    """The unit that runs `deixis start --foreground`."""
    return f"""\
{MARK} {installation.unit}
[Unit]
Description=Deixis people perception, system {installation.system.name}
{_ordering(installation)}\
StartLimitIntervalSec=0

[Service]
Type=notify
EnvironmentFile=-{_escaped(str(installation.environment_file))}
ExecStart={" ".join(map(_word, _start_command(installation)))}
Restart=on-failure
RestartSec=5
# The supervisor ends its services itself; what is left after that is killed.
KillMode=mixed
{_time_limits(installation.system)}\
NoNewPrivileges=yes
LockPersonality=yes
RestrictSUIDSGID=yes
{_rights(installation)}
[Install]
WantedBy={"multi-user.target" if installation.run_as else "default.target"}
"""


def bus_unit(installation: Installation) -> str:
    """The unit that lets messages loop back and pictures fit into receive buffers."""
    lines = "\n".join(f"ExecStart=/bin/sh -c '{command}'"
                      for command in _bus_commands(installation))
    return f"""\
{MARK} {installation.bus_unit}
[Unit]
Description=Receive buffers and multicast route for LCM (Deixis)
# Behind the network: where there is a default route, none is added.
After=network.target network-online.target

[Service]
Type=oneshot
RemainAfterExit=yes
{lines}
NoNewPrivileges=yes
ProtectHome=yes
PrivateTmp=yes

[Install]
WantedBy=multi-user.target
"""


def environment_text(installation: Installation) -> str:
    """The EnvironmentFile: yours to change."""
    lines = ["# Environment of Deixis below systemd; `deixis install-units` leaves it as it is.",
             "# The bus; see README.md, \"A bus needs a route and a buffer\".",
             _assignment("LCM_DEFAULT_URL", str(installation.url))]
    lines += [_assignment(name, value) for name, value in installation.environment.items()]
    return "\n".join(lines) + "\n"


def _start_command(installation: Installation) -> list[str]:
    return [str(installation.launcher), "start", "--foreground", "--system",
            str(installation.system.path.resolve()), *installation.names]


def _time_limits(system: System) -> str:
    entries = system.services.values()
    start_s = sum(e.ready_within_s * e.give_up_after for e in entries) + _EXTRA_S
    stop_s = max(e.stop_within_s for e in entries) + _EXTRA_S
    return f"TimeoutStartSec={start_s:.0f}\nTimeoutStopSec={stop_s:.0f}\n"


def _bus_commands(installation: Installation) -> list[str]:
    """Shell commands of root; `$$` is what systemd makes a `$` of."""
    limit = "/proc/sys/net/core/rmem_max"
    size = RECEIVE_BUFFER_BYTES
    buffer = f"[ $$(cat {limit}) -ge {size} ] || echo {size} >{limit}"
    if installation.leaves_host:
        return [buffer]
    group = installation.url.group if installation.url.provider == "udpm" else GROUP
    return [buffer, f"ip route get {group} >/dev/null 2>&1 ||"
                    " (ip link set lo up && ip route add 224.0.0.0/4 dev lo)"]


def _ordering(installation: Installation) -> str:
    if installation.run_as is None:
        return ""
    lines = f"Wants={installation.bus_unit}\nAfter={installation.bus_unit} network.target\n"
    if installation.leaves_host:
        lines += "Wants=network-online.target\nAfter=network-online.target\n"
    return lines


def _rights(installation: Installation) -> str:
    return f"User={installation.run_as}\n{_HARDENED}" if installation.run_as else ""


def _word(text: str) -> str:
    """One word of ExecStart."""
    escaped = _escaped(text).replace("$", "$$").replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"' if escaped != text or " " in text or "'" in text else text


def _escaped(text: str) -> str:
    return text.replace("%", "%%")


def _assignment(name: str, value: str) -> str:
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return f'{name}="{escaped}"'
