"""python -m onset_ccd: the command line, on every mesh that meshio reads."""

import sys

from . import __version__
from .files.errors import InputError, UsageError, one_line
from .files.outputs import print_out

EXIT_OK, EXIT_BAD_INPUT, EXIT_USAGE, EXIT_INTERRUPTED = 0, 1, 2, 130


def fail(code, message):
    """One line on stderr, whatever the cause."""
    sys.stderr.write(f"onset_ccd: {one_line(message)}\n")
    return code


def run(words):
    from .command_line.arguments import parse
    from .command_line.commands import COMMANDS

    arguments = parse(sys.argv[1:] if words is None else words)
    if arguments.version:
        print_out(f"onset_ccd {__version__}\n")
        return EXIT_OK
    return COMMANDS[arguments.command](arguments)


def main(words=None):
    try:
        return run(words)
    except UsageError as error:
        return fail(EXIT_USAGE, error)
    except InputError as error:
        return fail(EXIT_BAD_INPUT, error)
    except MemoryError:
        return fail(EXIT_BAD_INPUT, "not enough memory")
    except KeyboardInterrupt:
        return fail(EXIT_INTERRUPTED, "interrupted; nothing is written")


if __name__ == "__main__":
    sys.exit(main())
