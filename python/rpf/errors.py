"""What rpf raises. Each kind is an exit code of the command (docs/commands.md), and the Python error it is closest to."""


class Error(Exception):
    """One sentence that names the file, channel, pixel or option, says what was expected and what to do next."""

    exit_code = 1


class UsageError(Error, ValueError):
    """An option or a setting that cannot be."""

    exit_code = 2


class InputError(Error, ValueError):
    """A file or samples that cannot be used."""

    exit_code = 3


class OutputError(Error, OSError):
    """A result that could not be written."""

    exit_code = 4


class DeviceError(Error, RuntimeError):
    """A backend or device that is missing or failed."""

    exit_code = 5


class MemoryLimitError(Error, MemoryError):
    """More memory needed than the limit allows."""

    exit_code = 6


class Cancelled(Error):
    """The caller's progress returned False."""

    exit_code = 130


def error_of_kind(exit_code: int) -> type[Error]:
    return next((kind for kind in Error.__subclasses__() if kind.exit_code == exit_code), Error)
