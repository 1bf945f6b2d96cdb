"""Finds and starts the command `tlab`."""

import errno
import os
import pathlib
import shutil
import signal
import subprocess

from tlab.errors import OF_EXIT_CODE, BadInput, Error, NotFound

INTERRUPTED = 130  # exit code after an interrupt


def find():
    """The program's path: from $TLAB, else in the same build tree or installation, else on PATH."""
    given = os.environ.get("TLAB")  # takes precedence over an installed program
    if given:
        found = shutil.which(given)
        if not found:
            raise NotFound(f"TLAB is {given}, expected the path of the program tlab")
        return pathlib.Path(found)
    package = pathlib.Path(__file__).parent
    # where the program is, relative to this package, in a build tree and in an installation
    beside = (package / "../../tlab", package / "../../../../bin/tlab")
    found = next(filter(None, map(shutil.which, (*beside, "tlab"))), None)
    if not found:
        raise NotFound("found no program tlab, neither beside this package nor on PATH; set TLAB to its path")
    return pathlib.Path(os.path.normpath(found))


class Done:
    """The end of a command: exit_code, its standard output (output) and standard error (errors)."""

    def __init__(self, exit_code, output, errors):
        self.exit_code, self.output, self.errors = exit_code, output, errors

    def failure(self, result=None):
        """The exception for the exit code, with tlab's own message; None on success."""
        if self.exit_code == 0:
            return None
        message = "\n".join(line.removeprefix("tlab: ") for line in self.errors.strip().splitlines())
        kind = OF_EXIT_CODE.get(self.exit_code, Error)
        return kind(message or f"tlab ended with exit code {self.exit_code}", self.exit_code, result)


# True if the system can pass the text to a program.
def _is_argument(text):
    try:
        return b"\0" not in os.fsencode(text)
    except UnicodeEncodeError:
        return False


def start(arguments):
    """Starts tlab with arguments and waits for its end.

    An interrupt of Python (Ctrl-C, or a notebook's stop) interrupts tlab, which then writes its results so far.
    """
    words = [find(), *map(os.fspath, arguments)]
    try:
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, encoding="utf-8", errors="replace", start_new_session=True)
    except ValueError:  # a zero byte or a surrogate
        unfit = next(word for word in map(str, words) if not _is_argument(word))
        raise BadInput(f"found {unfit!r}, expected a text without zero bytes and surrogates") from None
    except OSError as error:
        if error.errno != errno.E2BIG:
            raise
        longest = max(map(str, words), key=len)
        raise BadInput(f"{longest[:40]}...: found {len(longest)} bytes, more than the host allows in an argument; "
                       "expected the value in the experiment's file or dict") from None
    try:
        output, errors = process.communicate()
    except BaseException:
        process.send_signal(signal.SIGINT)
        try:
            process.communicate()
        finally:
            process.kill()  # a second interrupt has ended the wait for tlab
        raise
    if process.returncode == INTERRUPTED:
        raise KeyboardInterrupt
    return Done(process.returncode, output, errors)


def ask(*arguments):
    """The output of tlab; raises an Error if it fails."""
    done = start(arguments)
    if failure := done.failure():
        raise failure
    return done.output
