"""Exceptions: one for each exit code of the command, with the command's own message."""

import re

# Control characters except line ends, characters that change the direction of text, and surrogates.
_UNREADABLE = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")


def _escape(match):
    code = ord(match[0])
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"


class Error(Exception):
    """The message of tlab, and its results if there are any. Control characters in the message become escapes.

    exit_code: the exit code of the command.
    result: a Result, or None. There are results after a failed check, and after a deadlock.
    """

    exit_code = None

    def __init__(self, message, exit_code=None, result=None):
        super().__init__(_UNREADABLE.sub(_escape, str(message)))
        if exit_code is not None:
            self.exit_code = exit_code
        self.result = result


class CheckFailed(Error):
    """A check did not hold, two machines gave different images, or a point's process was killed."""

    exit_code = 1


class BadInput(Error, ValueError):
    """Bad input, or a failure of the host: a full disk, a drawing that fails."""

    exit_code = 2


class SimulatedFault(Error):
    """The simulated program deadlocked, ran out of memory or did something that the machine refuses."""

    exit_code = 3


class NotFound(Error):
    """The program `tlab` was not found."""


# The exception for each exit code of the command. Any other exit code means a defect of tlab.
OF_EXIT_CODE = {kind.exit_code: kind for kind in (CheckFailed, BadInput, SimulatedFault)}
