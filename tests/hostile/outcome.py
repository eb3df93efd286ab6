"""Runs a command as if it could hurt the machine, and says what it took."""

import collections
import os
import re
import resource
import signal
import time

Outcome = collections.namedtuple("Outcome", "seconds busy megabytes status codes said")


def run(command, seconds, address_space=None):
    """The command's outcome. It is ended after that many seconds; `address_space`, in bytes, is
    what it can have at most, so that a fault does not take the machine."""
    reader, writer = os.pipe()
    start = time.monotonic()
    child = os.fork()
    if child == 0:
        os.dup2(writer, 2)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.close(reader)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if address_space:
            resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))
        signal.alarm(int(seconds))
        try:
            os.execv(command[0], [str(word) for word in command])
        finally:
            os._exit(127)
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        said = stream.read().decode("utf-8", "replace")
    _, status, usage = os.wait4(child, 0)
    codes = set(re.findall(r" \[([a-z0-9-]+)\]", said))
    return Outcome(time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024,
                   os.waitstatus_to_exitcode(status), codes, said)
