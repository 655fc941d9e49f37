"""The one exception that the command line turns into a line for people."""


class UserError(Exception):
    """Something the user can cure. The text names what is wrong and the cure."""


class Refusal(UserError):
    """A file that is wrong in one or more places: one fault per line."""

    def __init__(self, faults: list[str]) -> None:
        super().__init__("\n".join(faults))
        self.faults = faults
